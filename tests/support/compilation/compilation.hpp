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

/// Programs of one or several files from memory, compiled the way a command compiles them.
namespace sdlc::test {

class MemoryFiles final : public lang::FileSystem {
 public:
  explicit MemoryFiles(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override;

 private:
  std::map<std::string, std::string> texts_;
};

/// A program. Texts that do not begin with a version, a brace or a comment get `scene 1` as a line
/// of their own in front.
struct Sources {
  std::string root;                               ///< test.scene, or test.json
  std::map<std::string, std::string> files = {};  ///< by their paths
  std::vector<lang::SetOption> sets = {};
  lang::Limits limits = {};
  bool is_sandboxed = false;
};

/// A diagnostic in a form that tests compare: `at` is the text that it points to.
struct Told {
  std::string code, message, at;
  std::vector<std::string> labels, help, fixes;
  std::vector<std::string> chain;  ///< "in `f`: f(1)", what is told and where it points to
};

class Compilation {
 public:
  explicit Compilation(Sources sources);

  std::optional<lang::LoweredScene> lower(const lang::Overrides& overrides = {},
                                          std::optional<int> frame = {}) {
    return compiler_->lower(overrides, frame);
  }
  lang::Compiler& compiler() { return *compiler_; }

  /// What has been reported, by place.
  std::vector<Told> told() const;
  std::vector<std::string> codes() const;

 private:
  Sources sources_;
  MemoryFiles files_;
  lang::SourceFile root_;
  lang::DiagnosticSink sink_;
  std::unique_ptr<lang::Compiler> compiler_;
};

/// What is reported about a program when it is compiled.
std::vector<Told> told_about(Sources sources);
std::vector<std::string> codes_of(Sources sources);

/// The scene of a program about which nothing is reported; fails the test otherwise.
lang::LoweredScene scene_of(Sources sources, std::optional<int> frame = {});

/// The objects that a program's root evaluates to. Only evaluation: no camera is missing.
struct Evaluated {
  std::vector<lang::Object> objects;  ///< groups as they are entered
  std::vector<Told> told;

  std::vector<std::string> codes() const;
};
Evaluated evaluated(Sources sources);

/// The root's text with every fix applied that is suggested when it is evaluated.
std::string with_fixes(const std::string& root);

}  // namespace sdlc::test
