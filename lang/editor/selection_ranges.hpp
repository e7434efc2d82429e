#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// For each offset the spans around it that an editor selects one after the other: the word, the
/// expression, the inside of the brackets, the brackets, the statement and so on up to the file.
/// Each span is larger than the one before and contains it. `tree`: of a scene; null for a config.
std::vector<std::vector<Span>> selection_ranges(const SourceFile& file, const SyntaxTree* tree,
                                                std::span<const std::uint32_t> offsets);

}  // namespace sdlc::lang
