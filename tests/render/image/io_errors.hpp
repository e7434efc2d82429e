#pragma once

#include <string>

#include "render/image/io_error.hpp"

namespace sdlc::test {

/// The message of the IoError that `act` throws, empty if it throws none.
template <typename Act>
std::string error_of(Act act) {
  try {
    act();
  } catch (const render::IoError& error) {
    return error.what();
  }
  return "";
}

}  // namespace sdlc::test
