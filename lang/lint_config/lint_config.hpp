#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/lint_config/code_filter.hpp"
#include "lang/lint_config/glob.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::lang {

inline constexpr const char* kLintConfigName = ".sdlc.toml";

/// The settings of a `.sdlc.toml` for some of its files.
struct LintOverride {
  std::vector<Glob> files;
  CodeFilter filter;
};

/// A `.sdlc.toml`.
struct LintConfig {
  std::filesystem::path folder = {};  ///< its folder, absolute; globs are relative to it
  CodeFilter filter = {};
  std::optional<std::uint64_t> max_warnings = {};
  std::vector<LintOverride> overrides = {};

  /// Whether a diagnostic is wanted in the file, given by its absolute path. Checks the overrides
  /// from the last to the first, then `[lint]`; the first that matches the code decides.
  bool wants(std::string_view code, const std::filesystem::path& file) const;
};

/// Parses a `.sdlc.toml` in `folder`. Mistakes are appended to `errors`, each prefixed with `name`,
/// line and column.
LintConfig parse_lint_config(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder, std::vector<std::string>& errors);

/// The source of configs.
struct LintConfigOptions {
  std::string file;        ///< --config: use this one for all files
  bool is_unused = false;  ///< --no-config
  /// --sandbox: only configs in the folder of the scene and below
  bool is_sandboxed = false;
};

/// Finds the config of each file: the nearest `.sdlc.toml` from its folder upwards, up to the first
/// folder with a `.git`. Each is read once.
class LintConfigs {
 public:
  /// Throws render::IoError if the file of --config cannot be read.
  LintConfigs(const LintConfigOptions& options, const Workspace& workspace);

  /// The config of a file, given as the user named it; an empty one if there is none. `scene`: the
  /// file itself, or the scene that reads it. The reference stays valid. Throws render::IoError for
  /// a config that cannot be read.
  const LintConfig& of(const std::string& file, const std::string& scene);

  /// The mistakes in all configs found so far.
  const std::vector<std::string>& errors() const noexcept { return errors_; }

 private:
  /// `last`: the topmost folder to search; empty for no limit.
  const LintConfig& in_folder(const std::filesystem::path& folder,
                              const std::filesystem::path& last);
  std::optional<LintConfig> read(const std::filesystem::path& path);

  const Workspace& workspace_;
  bool searches_ = true;
  bool is_sandboxed_ = false;
  LintConfig common_;                                // from --config, or empty
  std::map<std::filesystem::path, LintConfig> own_;  // by folder
  /// By the folder of a query and its topmost folder.
  std::map<std::pair<std::filesystem::path, std::filesystem::path>, const LintConfig*> nearest_;
  std::vector<std::string> errors_;
};

}  // namespace sdlc::lang
