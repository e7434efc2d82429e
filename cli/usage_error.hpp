#pragma once

#include <stdexcept>

namespace sdlc::cli {

/// Arguments that are valid individually but not in combination.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sdlc::cli
