#include "lsp/positions.hpp"

#include <algorithm>
#include <cstdint>

namespace sdlc::lsp {
namespace {

/// A whole number from 0, plus 1.
std::uint32_t count_from_one(const Json& position, const char* key) {
  const auto value = position.find(key);
  if (value == position.end() || !value->is_number_unsigned()) {
    throw RequestError(ErrorCode::InvalidParams, "a position needs `line` and `character`");
  }
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(value->get<std::uint64_t>(), UINT32_MAX - 1) + 1);
}

const Json& member(const Json& range, const char* key) {
  if (!range.is_object() || !range.contains(key)) {
    throw RequestError(ErrorCode::InvalidParams, "a range needs `start` and `end`");
  }
  return range.at(key);
}

}  // namespace

Json position_json(lang::Position position) {
  return {{"line", position.line - 1}, {"character", position.column - 1}};
}

Json position_json(const lang::SourceFile& file, std::uint32_t offset,
                   lang::PositionEncoding encoding) {
  return position_json(lang::position_of(file, offset, encoding));
}

Json range_json(const lang::SourceFile& file, lang::Span span, lang::PositionEncoding encoding) {
  return {{"start", position_json(file, span.begin, encoding)},
          {"end", position_json(file, span.end, encoding)}};
}

Json first_range() {
  const Json first{{"line", 0}, {"character", 0}};
  return {{"start", first}, {"end", first}};
}

Json TextRanges::range(lang::Span span) {
  return {{"start", position(span.begin)}, {"end", position(span.end)}};
}

Json FileRanges::range(const lang::SourceFile& file, lang::Span span) {
  return files_.try_emplace(&file, file, encoding_).first->second.range(span);
}

lang::Position position_of_json(const Json& position) {
  if (!position.is_object()) {
    throw RequestError(ErrorCode::InvalidParams, "a position must be an object");
  }
  return {.line = count_from_one(position, "line"),
          .column = count_from_one(position, "character")};
}

std::uint32_t offset_of_json(const lang::SourceFile& file, const Json& position,
                             lang::PositionEncoding encoding) {
  return lang::offset_of(file, position_of_json(position), encoding);
}

lang::Span span_of_json(const lang::SourceFile& file, const Json& range,
                        lang::PositionEncoding encoding) {
  const std::uint32_t begin = offset_of_json(file, member(range, "start"), encoding);
  const std::uint32_t end = offset_of_json(file, member(range, "end"), encoding);
  return {std::min(begin, end), std::max(begin, end)};
}

}  // namespace sdlc::lsp
