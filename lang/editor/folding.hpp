#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

enum class FoldingKind : std::uint8_t {
  Brackets,  ///< a block, list or call
  Comment,   ///< a block comment, or line comments on successive lines
  Imports,   ///< successive imports and includes
};

/// Text over several lines that an editor can hide.
struct FoldingRange {
  Span hidden;  ///< of Brackets: between them; otherwise all of it
  FoldingKind kind = FoldingKind::Brackets;
};

/// In the order of the text. `tree`: of a scene; null for a config. Of more than `max_count` ranges
/// the largest are kept.
std::vector<FoldingRange> folding_ranges(const SourceFile& file, const SyntaxTree* tree,
                                         std::size_t max_count);

}  // namespace sdlc::lang
