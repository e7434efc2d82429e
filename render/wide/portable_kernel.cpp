// The kernels with one lane, for every machine.
#define HWY_COMPILE_ONLY_SCALAR
#include "render/wide/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render {
namespace HWY_NAMESPACE {

template <bool kInstances, bool kLights, bool kPilot = false>
TraceRuns<double>* portable(bool has_motion) noexcept {
  return has_motion
             ? &trace_runs<double, Features<true, false, true, kInstances, kLights, kPilot>>
             : &trace_runs<double, Features<false, false, true, kInstances, kLights, kPilot>>;
}

}  // namespace HWY_NAMESPACE

TraceRuns<double>* portable_kernel(KernelFeatures features) noexcept {
  using namespace HWY_NAMESPACE;
  if (features.pilot) return portable<false, true, true>(features.motion);
  if (features.instances) {
    return features.lights ? portable<true, true>(features.motion)
                           : portable<true, false>(features.motion);
  }
  return features.lights ? portable<false, true>(features.motion)
                         : portable<false, false>(features.motion);
}

}  // namespace sdlc::render
HWY_AFTER_NAMESPACE();
