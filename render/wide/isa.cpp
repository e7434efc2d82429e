#include "render/wide/isa.hpp"

#include <vector>

namespace sdlc::render {

std::string_view name_of(Isa isa) noexcept {
  switch (isa) {
    case Isa::Sse4: return "sse4";
    case Isa::Avx2: return "avx2";
    default: return "avx512";
  }
}

// Highway can detect them too, but loading its library takes 2 ms in every command.
std::span<const Isa> available_isas() noexcept {
  static const std::vector<Isa> isas = [] {
    std::vector<Isa> found;
#if defined(__x86_64__)
    const auto has_avx2 = [] {
      return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
             __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    };
    const auto has_avx512 = [] {
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
             __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
             __builtin_cpu_supports("avx512cd");
    };
    if (!__builtin_cpu_supports("sse4.2")) return found;
    found.push_back(Isa::Sse4);
    if (!has_avx2()) return found;
    found.push_back(Isa::Avx2);
    if (has_avx512()) found.push_back(Isa::Avx512);
#endif
    return found;
  }();
  return isas;
}

}  // namespace sdlc::render
