#pragma once

#include <string>
#include <vector>

#include "tests/editors/tree_sitter/scene_tree.hpp"

/// What captures.mjs and captures.lua print, by the library.
namespace sdlc::test {

/// The examples, and scenes with the whole language.
std::vector<std::string> example_files();

/// For each of them its name, then a line `BEGIN END CAPTURE` per capture, then `error` if its tree
/// has one.
std::string captures_in_examples(const Query& query);

}  // namespace sdlc::test
