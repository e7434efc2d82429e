#pragma once

#include <string>

namespace sdlc::cli {

/// 128 random bits, which nobody can guess, in hexadecimal digits. Throws std::system_error.
std::string random_token();

}  // namespace sdlc::cli
