#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/code_filter.hpp"
#include "cli/environment.hpp"
#include "cli/glob.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

inline constexpr const char* kLintConfigName = ".sdlc.toml";

/// What a `.sdlc.toml` says about some of its files.
struct LintOverride {
  std::vector<Glob> files;
  CodeFilter filter;
};

/// A `.sdlc.toml`.
struct LintConfig {
  std::filesystem::path folder = {};  ///< its own, absolute; globs are relative to it
  CodeFilter filter = {};
  std::optional<std::uint64_t> most_warnings = {};
  std::vector<LintOverride> overrides = {};

  /// Whether it wants a diagnostic in the file, whose absolute path is given. Later overrides
  /// decide first, then earlier ones, then `[lint]`; who says nothing about a code leaves it to the
  /// next.
  bool wants(std::string_view code, const std::filesystem::path& file) const;
};

/// The text of a `.sdlc.toml` in `folder`. What is wrong with it goes to `errors`, one text each
/// with `name`, line and column before it.
LintConfig parse_lint_config(std::string_view text, const std::string& name,
                             const std::filesystem::path& folder, std::vector<std::string>& errors);

/// Where configs come from.
struct LintConfigOptions {
  std::string file;        ///< --config: this one for all files
  bool is_unused = false;  ///< --no-config
  /// --sandbox: only those in the folder of the scene and below.
  bool is_sandboxed = false;
};

/// Finds the config of each file: the nearest `.sdlc.toml` from its folder upwards, as far as the
/// first folder that has a `.git`. Each is read once.
class LintConfigs {
 public:
  /// Throws render::IoError where the file of --config cannot be read.
  LintConfigs(const LintConfigOptions& options, const Environment& env);

  /// That of a file, as the user named it; one that says nothing where there is none. `scene`: the
  /// file itself, or the scene that reads it. The reference stays valid. Throws render::IoError for
  /// a config that cannot be read.
  const LintConfig& of(const std::string& file, const std::string& scene);

  /// What is wrong with those that were found so far.
  const std::vector<std::string>& errors() const noexcept { return errors_; }

 private:
  /// `last`: the folder above which it does not look; empty: none.
  const LintConfig& in_folder(const std::filesystem::path& folder,
                              const std::filesystem::path& last);
  std::optional<LintConfig> read(const std::filesystem::path& path);

  const Environment& env_;
  bool searches_ = true;
  bool is_sandboxed_ = false;
  LintConfig common_;                                // of --config, or one that says nothing
  std::map<std::filesystem::path, LintConfig> own_;  // by their folders
  /// Of each folder that was asked for, and the last one.
  std::map<std::pair<std::filesystem::path, std::filesystem::path>, const LintConfig*> nearest_;
  std::vector<std::string> errors_;
};

}  // namespace sdlc::cli
