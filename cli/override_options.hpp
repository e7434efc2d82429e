#pragma once

#include <CLI/CLI.hpp>

#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"

namespace sdlc::cli {

/// The flags that win over the scene's own settings: one for each property of `render` but its
/// output, named and explained by the property's row in its table.
void add_override_options(CLI::App& command, lang::Overrides& overrides);

/// Throws UsageError where the flags ask for what neither they nor the scene say how to reach.
void check_goals(const lang::Overrides& overrides, const lang::LoweredScene& lowered);

}  // namespace sdlc::cli
