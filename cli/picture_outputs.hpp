#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/outputs.hpp"
#include "cli/report_failure.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "render/session/render.hpp"

/// Writes the pictures of one render.
namespace sdlc::cli {

/// How pictures are written, beside what the name of each file says.
struct PictureForm {
  render::ToneMapping mapping = {};
  bool ppm_text = false;
  int zoom = 1;  ///< each pixel is written as zoom × zoom
};

inline constexpr std::string_view kStandardOutput = "standard output";

/// The written files, and the status.
struct Written {
  std::vector<std::string> names;  ///< of pictures, as printed
  std::vector<std::string> films;  ///< the same of films
  std::vector<std::string> all() const;
  ExitCode code = ExitCode::Success;
};

/// Runs `write`; an I/O failure is reported, and does not prevent other outputs.
template <typename Write>
void try_to_write(ExitCode& code, Environment& env, Write write) {
  try {
    write();
  } catch (const render::IoError& error) {
    env.err << fmt::format("error: {}\n", lang::printable(error.what()));
    env.out.clear();  // it has been reported
    code = graver(code, exit_code_of(error));
  }
}

/// Writes every picture, but no film; also one that is not complete: then under its partial_name().
/// Failures are reported.
Written write_pictures(const std::vector<Output>& outputs, const PictureForm& form,
                       const render::RenderSettings& settings, const render::RenderResult& result,
                       std::span<const render::Layer> layers, Environment& env);

/// The seconds to write the picture with some more `channels`, as measured with some of its rows:
/// other programs may take most of the processor.
double seconds_to_write(const render::Picture& picture, const std::vector<Output>& outputs,
                        const PictureForm& form, std::size_t channels);

/// Writes lines of JSON to the file, or to standard output. Throws IoError.
void write_stats(const std::string& path, const std::string& lines, Environment& env);

}  // namespace sdlc::cli
