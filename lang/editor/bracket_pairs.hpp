#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// An opening bracket and the one that closes it.
struct BracketPair {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  std::uint32_t open = 0;        ///< offset
  std::uint32_t close = kNone;   ///< offset; kNone: nothing closes it
  std::uint32_t parent = kNone;  ///< index of the pair around it
  bool spans_lines = false;      ///< a line ends between the brackets

  bool is_closed() const noexcept { return close != kNone; }
  Span outside() const noexcept { return {open, close + 1}; }
  Span inside() const noexcept { return {open + 1, close}; }
};

/// The brackets of a text of either format, broken or not, in the order of their opening. A bracket
/// closes the innermost open one of its kind; those opened after it remain open.
std::vector<BracketPair> bracket_pairs(std::string_view text, SourceFormat format);

/// The innermost pair that is closed and contains the span, brackets included; kNone if there is
/// none.
std::uint32_t innermost_pair(const std::vector<BracketPair>& pairs, Span span) noexcept;

}  // namespace sdlc::lang
