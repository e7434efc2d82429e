#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/docs/markdown.hpp"

namespace sdlc::test {

/// The tables of the code as parts of the language reference: kinds, materials, functions, types,
/// limits, colour names.
std::vector<GeneratedPart> reference_parts();

/// The message of a diagnostic with `…` for its arguments.
std::string shown_message(std::string_view message);

}  // namespace sdlc::test
