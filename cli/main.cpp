#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "cli/exit_code.hpp"
#include "cli/program.hpp"
#include "render/image/atomic_file.hpp"
#include "render/tiles/threads.hpp"

namespace {

/// Of exceptions in threads of libraries too, which nobody can catch.
[[noreturn]] void on_terminate() noexcept {
  sdlc::render::remove_unfinished_files();
  if (const std::exception_ptr thrown = std::current_exception()) {
    try {
      std::rethrow_exception(thrown);
    } catch (const std::exception& error) {
      if (sdlc::render::is_thread_shortage(error)) {
        std::fputs(
            "error: a thread cannot be started: the user or the container has too many "
            "(`ulimit -u`); --threads asks for fewer\n",
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
  // A closed pipe or a limit on file sizes is an error of the write that meets it, not the end of
  // the process.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(on_terminate);
  // Else OpenImageIO starts one for each core, only to end them again. Here there are no others yet
  // that may look into the environment.
  ::setenv("OPENIMAGEIO_THREADS", "1", 0);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const sdlc::lang::DiskFileSystem files;
  sdlc::cli::Environment env = sdlc::cli::process_environment(files);
  return static_cast<int>(sdlc::cli::run_program(arguments, env));
}
