#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/object/object.hpp"
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"

/// Programs of one or several files in memory, compiled in the same way as by a command.
namespace sdlc::test {

class MemoryFiles final : public lang::FileSystem {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override;

 private:
  std::map<std::string, std::string> texts_;
};

/// A program. Texts that do not begin with a version, a brace or a comment get a first line `scene
/// 1`.
struct Sources {
  std::string root;                               ///< test.scene, or test.json
  std::map<std::string, std::string> files = {};  ///< by path
  std::vector<lang::SetOption> sets = {};
  lang::Limits limits = {};
  bool is_sandboxed = false;
};

/// A diagnostic in a form for comparisons: `at` is the text that it points to.
struct Told {
  std::string code, message, at;
  std::vector<std::string> labels, help, fixes;
  std::vector<std::string> chain;  ///< "in `f`: f(1)", the message and the text that it points to
};

class Compilation {
 public:
  explicit Compilation(Sources sources);

  std::optional<lang::LoweredScene> lower(const lang::Overrides& overrides = {},
                                          std::optional<int> frame = {}) {
    return compiler_->lower(overrides, frame);
  }
  lang::Compiler& compiler() { return *compiler_; }

  /// The reported diagnostics, by place.
  std::vector<Told> told() const;
  std::vector<std::string> codes() const;

 private:
  Sources sources_;
  MemoryFiles files_;
  lang::Workspace workspace_;
  lang::Document root_;
  lang::DiagnosticSink sink_;
  std::unique_ptr<lang::Compiler> compiler_;
};

/// The diagnostics of a program when it is compiled.
std::vector<Told> told_about(Sources sources);
std::vector<std::string> codes_of(Sources sources);

/// The scene of a program without diagnostics; fails the test otherwise.
lang::LoweredScene scene_of(Sources sources, std::optional<int> frame = {});

/// The objects that a program's root evaluates to. Only evaluates, so no camera is required.
struct Evaluated {
  std::vector<lang::Object> objects;  ///< groups when they are entered
  std::vector<Told> told;

  std::vector<std::string> codes() const;
};
Evaluated evaluated(Sources sources);

/// The root's text with every fix applied that evaluation suggests.
std::string with_fixes(const std::string& root);

}  // namespace sdlc::test
