#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace sdlc::render {

/// The instruction sets that the wide kernel is built for.
enum class Isa : std::uint8_t { Sse4, Avx2, Avx512 };
inline constexpr std::array kIsas{Isa::Sse4, Isa::Avx2, Isa::Avx512};

std::string_view name_of(Isa isa) noexcept;

/// The instruction sets of this machine, in ascending order; empty on a machine without SSE4 or of
/// another architecture.
std::span<const Isa> available_isas() noexcept;

}  // namespace sdlc::render
