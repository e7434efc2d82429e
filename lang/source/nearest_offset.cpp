#include "lang/source/nearest_offset.hpp"

#include <algorithm>

namespace sdlc::lang {

std::uint32_t nearest_offset(const SourceFile& file, Position position) noexcept {
  const std::uint32_t line = std::clamp(position.line, 1u, file.line_count());
  std::uint32_t offset = file.line_begin(line);
  const auto end = offset + static_cast<std::uint32_t>(file.line(line).size());
  while (offset < end && file.position(offset).column < position.column) ++offset;
  return offset;
}

}  // namespace sdlc::lang
