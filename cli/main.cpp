#include <csignal>
#include <string>
#include <vector>

#include "cli/program.hpp"

int main(int argc, char** argv) {
  // A closed pipe or a limit on file sizes is an error of the write that meets it, not the end of
  // the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const sdlc::lang::DiskFileSystem files;
  sdlc::cli::Environment env = sdlc::cli::process_environment(files);
  return static_cast<int>(sdlc::cli::run_program(arguments, env));
}
