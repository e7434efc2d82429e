#pragma once

#include <memory>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::test {

/// Every scene of the repository: the examples, the blocks of the documentation, the test files and
/// their cases, correct or not.
std::vector<std::shared_ptr<const lang::SourceFile>> all_scene_texts();

/// Those that the program reads without an error of syntax.
std::vector<std::shared_ptr<const lang::SourceFile>> correct_scene_texts();

}  // namespace sdlc::test
