#pragma once

#include <stdexcept>

namespace sdlc::cli {

/// Arguments that are each well formed but do not make a command together.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sdlc::cli
