#include "lsp/sorted_positions.hpp"

#include <algorithm>
#include <string_view>

namespace sdlc::lsp {

lang::Position SortedPositions::next(std::uint32_t offset) {
  const std::string_view text = file_.text();
  offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  // Line numbers of the file count from 1.
  while (last_.line + 1 < file_.line_count() && file_.line_begin(last_.line + 2) <= offset) {
    ++last_.line;
    last_.column = 0;
    offset_ = file_.line_begin(last_.line + 1);
  }
  last_.column += lang::count_columns(text.substr(offset_, offset - offset_), encoding_);
  offset_ = offset;
  return last_;
}

Json SortedPositions::next_json(std::uint32_t offset) {
  const lang::Position position = next(offset);
  return {{"line", position.line}, {"character", position.column}};
}

Json SortedPositions::next_range(lang::Span span) {
  Json start = next_json(span.begin);
  return {{"start", std::move(start)}, {"end", next_json(span.end)}};
}

}  // namespace sdlc::lsp
