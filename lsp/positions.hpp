#pragma once

#include <cstdint>
#include <map>

#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"
#include "lsp/json_rpc.hpp"

/// Positions and ranges of the protocol, which count from 0.
namespace sdlc::lsp {

Json position_json(lang::Position position);
Json position_json(const lang::SourceFile& file, std::uint32_t offset,
                   lang::PositionEncoding encoding);
Json range_json(const lang::SourceFile& file, lang::Span span, lang::PositionEncoding encoding);
/// The range of the beginning of a file.
Json first_range();

/// Ranges of many spans of a text, fast also in very long lines.
class TextRanges {
 public:
  /// `file` must outlive the ranges.
  TextRanges(const lang::SourceFile& file, lang::PositionEncoding encoding)
      : positions_(file, encoding) {}

  Json position(std::uint32_t offset) { return position_json(positions_.at(offset)); }
  Json range(lang::Span span);

 private:
  lang::PositionMap positions_;
};

/// The same for several texts, which must outlive the ranges.
class FileRanges {
 public:
  explicit FileRanges(lang::PositionEncoding encoding) : encoding_(encoding) {}

  Json range(const lang::SourceFile& file, lang::Span span);

 private:
  lang::PositionEncoding encoding_;
  std::map<const lang::SourceFile*, TextRanges> files_;
};

/// The offset of a position; one outside the text is at its end, or at the end of its line. Throws
/// RequestError (InvalidParams) if it is no position.
std::uint32_t offset_of_json(const lang::SourceFile& file, const Json& position,
                             lang::PositionEncoding encoding);
lang::Span span_of_json(const lang::SourceFile& file, const Json& range,
                        lang::PositionEncoding encoding);

/// Line and column from 1 of a position. Throws RequestError (InvalidParams).
lang::Position position_of_json(const Json& position);

}  // namespace sdlc::lsp
