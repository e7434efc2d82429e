#pragma once

#include <string>
#include <string_view>

namespace sdlc::cli {

/// Quotes an argument for a POSIX shell: unchanged if that is safe, otherwise in single quotes.
std::string shell_quoted(std::string_view argument);

}  // namespace sdlc::cli
