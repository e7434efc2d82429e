#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/kernel/path_kernel.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
#include "render/kernel/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

TraceRuns<float>* kernel_with_lights(float type, KernelFeatures features) noexcept;
TraceRuns<double>* kernel_with_lights(double type, KernelFeatures features) noexcept;
TraceRuns<float>* kernel_with_lens(float type, KernelFeatures features) noexcept;
TraceRuns<double>* kernel_with_lens(double type, KernelFeatures features) noexcept;
TraceRuns<float>* kernel_with_caustics(float type, KernelFeatures features) noexcept;
TraceRuns<double>* kernel_with_caustics(double type, KernelFeatures features) noexcept;

// Called here, so that all instantiations are compiled for the instruction set.
TraceRuns<float>* kernel_for(float type, KernelFeatures features) noexcept {
  if (features.caustics) return kernel_with_caustics(type, features);
  if (features.lens) return kernel_with_lens(type, features);
  if (features.lights) return kernel_with_lights(type, features);
  return choose_kernel<float, Extra::None>(features);
}
TraceRuns<double>* kernel_for(double type, KernelFeatures features) noexcept {
  if (features.caustics) return kernel_with_caustics(type, features);
  if (features.lens) return kernel_with_lens(type, features);
  if (features.lights) return kernel_with_lights(type, features);
  return choose_kernel<double, Extra::None>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
