#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include "cli/exit_code.hpp"
#include "cli/interrupt.hpp"
#include "cli/program.hpp"
#include "cli/stack.hpp"
#include "render/image/atomic_file.hpp"
#include "render/parallel/threads.hpp"

namespace {

/// Opens the standard streams if the process was started without them: otherwise the next opened
/// file would get their number, and receive their output. They are opened in the wrong direction,
/// so that using one is still an error.
void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    const int mode = stream == STDIN_FILENO ? O_WRONLY : O_RDONLY;
    // open() returns the lowest free number, that of the stream. A system without /dev still has a
    // root.
    if (::open("/dev/null", mode) < 0) ::open("/", O_RDONLY | O_DIRECTORY);
  }
}

/// Also called for exceptions in threads of libraries, which nobody can catch.
[[noreturn]] void on_terminate() noexcept {
  sdlc::render::remove_unfinished_files();
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      if (sdlc::render::is_thread_shortage(error)) {
        std::fputs(
            "error: a thread cannot be started: the limit of the user or the container is reached "
            "(`ulimit -u`); use fewer --threads\n",
            stderr);
        std::_Exit(static_cast<int>(sdlc::cli::ExitCode::Usage));
      }
      std::fprintf(stderr, "error: a defect in sdlc: %s\n", error.what());
    } catch (...) {
    }
  }
  std::abort();
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_streams();
  // A closed pipe or a limit on file sizes is an error of the write, not the end of the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  sdlc::cli::handle_signals();
  std::set_terminate(on_terminate);
  // Otherwise OpenImageIO starts a thread per core, only to end them again. No other threads exist
  // yet that may read the environment.
  ::setenv("OPENIMAGEIO_THREADS", "1", 0);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  int status = 0;
  const bool has_stack = sdlc::cli::run_on_large_stack([&] {
    const sdlc::lang::DiskFileSystem disk;
    sdlc::lang::Workspace workspace(disk);
    sdlc::cli::Environment env = sdlc::cli::process_environment(workspace);
    status = static_cast<int>(sdlc::cli::run_program(arguments, env));
  });
  if (has_stack) return status;
  std::cerr << "error: the stack is too small, and no thread can be started: raise `ulimit -s`\n";
  return static_cast<int>(sdlc::cli::ExitCode::Usage);
}
