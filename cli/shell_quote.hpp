#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// The argument as a POSIX shell takes it: as it is where that is safe, else in single quotes.
std::string shell_quoted(std::string_view argument);

}  // namespace sdlc::cli
