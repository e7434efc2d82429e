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

/// What of a scene is written as a config, where it holds more than one of something.
struct ConvertOptions {
  std::optional<int> frame = {};                      ///< of a film
  std::optional<std::string> camera = {}, tone = {};  ///< in place of the scene's own
};

/// A text of one format, to be written in the other one. Of what the text itself is warned about
/// nothing is told: the warnings are about what the other format cannot hold.
class Conversion {
 public:
  /// `file` must outlive the conversion, and the conversion what is done with the sink's
  /// diagnostics.
  Conversion(const Document& file, const ProgramOptions& options, DiagnosticSink& sink);
  ~Conversion();

  /// The text in the other format, which lowers to the same picture; nothing where an error has
  /// been reported. Throws std::logic_error where it would be another picture: a defect.
  std::optional<std::string> run(const ConvertOptions& options);

  /// The files that the text needs, as far as they have been read.
  std::vector<std::filesystem::path> dependencies() const;

  /// How many of the warnings are of keys that every config has: nobody can write one without.
  std::size_t forced_warnings() const noexcept { return forced_warnings_; }

 private:
  std::optional<std::string> to_scene();
  /// The config as a formatted scene; nullopt after reporting that a limit forbids it.
  std::optional<std::string> scene_text(const LoweredScene& lowered);
  std::optional<std::string> to_config(const ConvertOptions& options);
  /// Whether the limits allow for the scene; if not, that is reported.
  bool may_be_read(const SourceFile& scene, const LoweredScene& lowered);

  const Document& file_;
  ProgramOptions options_;
  DiagnosticSink& sink_;
  std::unique_ptr<Program> program_;  ///< null for a config
  std::size_t forced_warnings_ = 0;
};

}  // namespace sdlc::lang
