#pragma once

#include <cstdint>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The offset of a position; of the end of its line, or of the text's last line, if there is no such
/// position.
std::uint32_t nearest_offset(const SourceFile& file, Position position) noexcept;

}  // namespace sdlc::lang
