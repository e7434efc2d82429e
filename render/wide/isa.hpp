#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace sdlc::render {

/// Instruction sets that the wide kernel is built for.
enum class Isa : std::uint8_t { Sse4, Avx2, Avx512 };
inline constexpr std::array kIsas{Isa::Sse4, Isa::Avx2, Isa::Avx512};

std::string_view name_of(Isa isa) noexcept;

/// Those that this machine has, in ascending order; none on a machine without SSE4 or of another
/// family.
std::span<const Isa> available_isas() noexcept;

}  // namespace sdlc::render
