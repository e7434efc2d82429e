#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// Selects what a config can hold only one of.
struct ConvertOptions {
  std::optional<int> frame = {};                      ///< of a film
  std::optional<std::string> camera = {}, tone = {};  ///< instead of the scene's own
};

/// Converts a text of one format to the other. Reports errors and what the other format cannot
/// represent; warnings about the text itself are dropped.
class Conversion {
 public:
  /// `file` must outlive the conversion, and the conversion the use of the sink's diagnostics.
  Conversion(const Document& file, const ProgramOptions& options, DiagnosticSink& sink);
  ~Conversion();

  /// The text in the other format, which lowers to the same picture; nullopt after an error. Throws
  /// std::logic_error if the picture would differ: a defect.
  std::optional<std::string> run(const ConvertOptions& options);

  /// The files that the text imports or includes, as far as they have been read.
  std::vector<std::filesystem::path> dependencies() const;

  /// The number of warnings about keys that the format requires.
  std::size_t forced_warnings() const noexcept { return forced_warnings_; }

 private:
  std::optional<std::string> to_scene();
  /// The config as a formatted scene; nullopt after reporting that a limit forbids it.
  std::optional<std::string> scene_text(const LoweredScene& lowered);
  std::optional<std::string> to_config(const ConvertOptions& options);
  /// Reports the limits that the scene exceeds; returns whether there are none.
  bool check_limits(const SourceFile& scene, const LoweredScene& lowered);

  const Document& file_;
  ProgramOptions options_;
  DiagnosticSink& sink_;
  std::unique_ptr<Program> program_;  ///< null for a config
  std::size_t forced_warnings_ = 0;
};

}  // namespace sdlc::lang
