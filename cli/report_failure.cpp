#include "cli/report_failure.hpp"

#include <exception>
#include <filesystem>
#include <new>

#include <fmt/format.h>

#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/film_file.hpp"
#include "render/image/io_error.hpp"
#include "render/parallel/threads.hpp"

namespace sdlc::cli {

ExitCode exit_code_of(const render::IoError& error) noexcept {
  return error.may_pass() ? ExitCode::TryAgain : ExitCode::Usage;
}

void warn(const std::exception& failure, Environment& env) {
  env.err << fmt::format("warning: {}\n", lang::printable(failure.what())) << std::flush;
}

ExitCode report_failure(Environment& env, const std::function<ExitCode()>& run) {
  try {
    return run();
  } catch (const UsageError& error) {
    env.err << fmt::format("error: {}\n", error.what());
    return ExitCode::Usage;
  } catch (const render::IoError& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    return exit_code_of(error);
  } catch (const render::FilmError& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    return ExitCode::Findings;
  } catch (const std::filesystem::filesystem_error& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    return ExitCode::Usage;
  } catch (const std::bad_alloc&) {
    env.err << "error: not enough memory for this scene and picture\n";
    return ExitCode::Usage;
  } catch (const std::exception& error) {
    if (render::is_thread_shortage(error)) throw;
    env.err << fmt::format("error: a defect in sdlc: {}\n", error.what());
    return ExitCode::Defect;
  }
}

}  // namespace sdlc::cli
