#pragma once

#include <cstdint>

#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"
#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

/// Positions of many offsets of one text, which must not decrease. The time is that of one pass
/// over the text, however long its lines are.
class SortedPositions {
 public:
  SortedPositions(const lang::SourceFile& file, lang::PositionEncoding encoding)
      : file_(file), encoding_(encoding) {}

  /// Line and column from 0, in `line` and `column` of a Position.
  lang::Position next(std::uint32_t offset);
  Json next_json(std::uint32_t offset);
  /// Precondition: the span begins after the last offset.
  Json next_range(lang::Span span);

 private:
  const lang::SourceFile& file_;
  lang::PositionEncoding encoding_;
  lang::Position last_{0, 0};
  std::uint32_t offset_ = 0;  // of last_
};

}  // namespace sdlc::lsp
