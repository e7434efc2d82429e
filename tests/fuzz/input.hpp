#pragma once

#include <string_view>

#include "lang/source/source.hpp"

namespace sdlc::test {

/// Compiles the text, renders what is reported in every format, and ends the process if one of the
/// two is not as it must be, whatever the text says. Files that it names are looked for in
/// examples/. Little may be used up, so that each input is quick.
void run_fuzz_input(std::string_view text, lang::SourceFormat format);

}  // namespace sdlc::test
