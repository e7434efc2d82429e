#pragma once

#include <ostream>
#include <span>
#include <string>

#include "lang/workspace/workspace.hpp"

namespace sdlc::cli {

/// The environment of a command, which tests can replace.
struct Environment {
  lang::Workspace& workspace;
  std::ostream& out;  ///< pictures and requested text
  std::ostream& err;  ///< everything else
  bool out_is_terminal = false;
  bool err_is_terminal = false;
  bool no_color = false;                        ///< the user's NO_COLOR
  std::span<const std::string> arguments = {};  ///< of the command line, for commands that repeat
                                                ///< it

  /// The same with other files, and another stream for messages.
  Environment with(lang::Workspace& files, std::ostream& messages) const {
    return {.workspace = files,
            .out = out,
            .err = messages,
            .out_is_terminal = out_is_terminal,
            .err_is_terminal = err_is_terminal,
            .no_color = no_color,
            .arguments = arguments};
  }
  Environment with_workspace(lang::Workspace& other) const { return with(other, err); }
  Environment with_err(std::ostream& other) const { return with(workspace, other); }
};

/// The environment of this process.
Environment process_environment(lang::Workspace& workspace);

/// Resident memory of this process in bytes, current and peak; 0 if unknown.
std::size_t resident_bytes();
std::size_t peak_resident_bytes();
/// Returns freed memory to the system that the C library would keep.
void release_freed_memory();
/// Physical memory of the machine in bytes.
std::size_t physical_memory_bytes();

}  // namespace sdlc::cli
