#pragma once

#include "cli/command_line.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"

namespace sdlc::cli {

/// Adds the flags that override settings of the scene, with names and help from the table of
/// properties: one for each property of `render` that is a whole number or a word, and for `error`.
void add_override_options(Command& command, lang::Overrides& overrides);

/// Throws UsageError for --adaptive without a requested error.
void check_goals(const lang::Overrides& overrides, const lang::LoweredScene& lowered);

}  // namespace sdlc::cli
