#pragma once

#include <ostream>
#include <span>
#include <string>

#include "lang/source/source.hpp"

namespace sdlc::cli {

/// The world of a command, so that a test can give it another one.
struct Environment {
  const lang::FileSystem& files;
  std::ostream& out;  ///< pictures and requested text
  std::ostream& err;  ///< everything else
  bool out_is_terminal = false;
  bool err_is_terminal = false;
  bool no_color = false;                        ///< the user's NO_COLOR
  std::span<const std::string> arguments = {};  ///< of the command line, for those who repeat it
};

/// The environment of this process.
Environment process_environment(const lang::FileSystem& files);

/// Resident memory of this process in bytes, now and at its highest; 0 where it cannot be told.
std::size_t resident_bytes();
std::size_t peak_resident_bytes();
/// Gives back to the system what was freed, where the C library keeps it.
void release_freed_memory();
/// Physical memory of the machine in bytes.
std::size_t physical_memory_bytes();

}  // namespace sdlc::cli
