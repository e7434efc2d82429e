// The kernels for every machine, with vectors of two numbers.
#define HWY_COMPILE_ONLY_SCALAR
#include "render/kernel/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render {
namespace HWY_NAMESPACE {

/// The kernel of the light pilot.
template <bool kCaustics>
TraceRuns<double>* choose_pilot(bool has_motion) noexcept {
  return has_motion
             ? &trace_runs<double, Features<true, false, true, false, true, true, false, kCaustics>>
             : &trace_runs<double,
                           Features<false, false, true, false, true, true, false, kCaustics>>;
}

}  // namespace HWY_NAMESPACE

TraceRuns<double>* portable_kernel(KernelFeatures features) noexcept {
  using namespace HWY_NAMESPACE;
  if (features.pilot) {
    return features.caustics ? choose_pilot<true>(features.motion)
                             : choose_pilot<false>(features.motion);
  }
  if (features.caustics) return choose_kernel<double, Extra::Caustics>(features);
  if (features.lens) {
    return features.lights ? choose_kernel<double, Extra::LensAndLights>(features)
                           : choose_kernel<double, Extra::Lens>(features);
  }
  return features.lights ? choose_kernel<double, Extra::Lights>(features)
                         : choose_kernel<double, Extra::None>(features);
}

}  // namespace sdlc::render
HWY_AFTER_NAMESPACE();
