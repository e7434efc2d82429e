#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/kernel/path_kernel_lens_float.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "render/kernel/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

TraceRuns<float>* kernel_with_lens(float /*type*/, KernelFeatures features) noexcept {
  return features.lights ? choose_kernel<float, Extra::LensAndLights>(features)
                         : choose_kernel<float, Extra::Lens>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
