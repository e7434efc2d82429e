#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/wide/path_kernel_double.cpp"
#include <hwy/foreach_target.h>

#if HWY_TARGET != HWY_STATIC_TARGET
#include "render/wide/path_kernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

TraceBlocks<double>* double_kernel(WideFeatures features) noexcept {
  return choose_kernel<double>(features);
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE && HWY_ARCH_X86_64
namespace sdlc::render {

template <>
TraceBlocks<double>* wide_kernel<double>(Isa isa, WideFeatures features) noexcept {
  switch (isa) {
    case Isa::Sse4: return N_SSE4::double_kernel(features);
    case Isa::Avx2: return N_AVX2::double_kernel(features);
    default: return N_AVX3::double_kernel(features);
  }
}

}  // namespace sdlc::render
#elif HWY_ONCE
namespace sdlc::render {

template <>
TraceBlocks<double>* wide_kernel<double>(Isa /*isa*/, WideFeatures /*features*/) noexcept {
  return nullptr;  // no Isa is available
}

}  // namespace sdlc::render
#endif
