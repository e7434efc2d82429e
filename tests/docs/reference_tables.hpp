#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/docs/markdown.hpp"

namespace sdlc::test {

/// What the tables of the code say about the language, as parts of its reference: kinds, materials,
/// functions, types, limits, names of colours.
std::vector<GeneratedPart> reference_parts();

/// The message of a diagnostic with `…` for what is filled in.
std::string shown_message(std::string_view message);

}  // namespace sdlc::test
