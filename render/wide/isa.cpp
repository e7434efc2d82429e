#include "render/wide/isa.hpp"

#include <vector>

#include <hwy/targets.h>

namespace sdlc::render {

std::string_view name_of(Isa isa) noexcept {
  switch (isa) {
    case Isa::Sse4: return "sse4";
    case Isa::Avx2: return "avx2";
    default: return "avx512";
  }
}

std::span<const Isa> available_isas() noexcept {
  static const std::vector<Isa> isas = [] {
    std::vector<Isa> found;
    const auto targets = hwy::SupportedTargets();
    if (targets & HWY_SSE4) found.push_back(Isa::Sse4);
    if (targets & HWY_AVX2) found.push_back(Isa::Avx2);
    if (targets & HWY_AVX3) found.push_back(Isa::Avx512);
    return found;
  }();
  return isas;
}

}  // namespace sdlc::render
