#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/wide/path_kernel_float.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_STATIC_TARGET
#include "render/wide/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

TraceBlocks<float>* float_kernel(WideFeatures features) noexcept {
  return choose_kernel<float>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE && HWY_ARCH_X86_64
namespace sdlc::render {

template <>
TraceBlocks<float>* wide_kernel<float>(Isa isa, WideFeatures features) noexcept {
  switch (isa) {
    case Isa::Sse4: return N_SSE4::float_kernel(features);
    case Isa::Avx2: return N_AVX2::float_kernel(features);
    default: return N_AVX3::float_kernel(features);
  }
}

}  // namespace sdlc::render
#elif HWY_ONCE
namespace sdlc::render {

template <>
TraceBlocks<float>* wide_kernel<float>(Isa /*isa*/, WideFeatures /*features*/) noexcept {
  return nullptr;  // no Isa is available
}

}  // namespace sdlc::render
#endif
