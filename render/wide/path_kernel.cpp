#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/wide/path_kernel.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_STATIC_TARGET
#include "render/wide/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

// Called here, so that all instantiations are compiled for the instruction set.
TraceRuns<float>* kernel_for(float /*type*/, WideFeatures features) noexcept {
  return choose_kernel<float, false>(features);
}
TraceRuns<double>* kernel_for(double /*type*/, WideFeatures features) noexcept {
  return choose_kernel<double, false>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace sdlc::render {

template <typename T>
TraceRuns<T>* wide_kernel([[maybe_unused]] Isa isa, WideFeatures features) noexcept {
  if (features.lights) return wide_kernel_with_lights<T>(isa, features);
#if HWY_ARCH_X86_64
  switch (isa) {
    case Isa::Sse4: return N_SSE4::kernel_for(T{}, features);
    case Isa::Avx2: return N_AVX2::kernel_for(T{}, features);
    default: return N_AVX3::kernel_for(T{}, features);
  }
#else
  return nullptr;  // no Isa is available
#endif
}

template TraceRuns<float>* wide_kernel(Isa isa, WideFeatures features) noexcept;
template TraceRuns<double>* wide_kernel(Isa isa, WideFeatures features) noexcept;

}  // namespace sdlc::render
#endif
