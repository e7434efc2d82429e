#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/kernel/path_kernel_lights_double.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "render/kernel/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

TraceRuns<double>* kernel_with_lights(double /*type*/, KernelFeatures features) noexcept {
  return choose_kernel<double, Extra::Lights>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
