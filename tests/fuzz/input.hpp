#pragma once

#include <string_view>

#include "lang/source/source.hpp"

namespace sdlc::test {

/// Compiles the text, renders the diagnostics in every format, and aborts if an invariant fails,
/// whatever the text is. Files that it names are looked up in examples/. Limits are low, so that
/// each input is quick.
void run_fuzz_input(std::string_view text, lang::SourceFormat format);

}  // namespace sdlc::test
