#pragma once

#include <vector>

#include "tests/docs/markdown.hpp"

namespace sdlc::test {

/// What the tables of the code say about the language, as parts of its reference: kinds, materials,
/// functions, types, limits, names of colours.
std::vector<GeneratedPart> reference_parts();

}  // namespace sdlc::test
