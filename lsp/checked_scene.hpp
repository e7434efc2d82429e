#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint_config/lint_config.hpp"
#include "lang/program/program.hpp"
#include "lang/report/findings.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lsp {

/// A scene or config with its findings, those that `.sdlc.toml` does not ignore.
class CheckedScene final : public lang::CheckedText {
 public:
  /// Max errors shown, and as many warnings.
  static constexpr std::size_t kMaxShown = 1000;

  /// Checks the scene with everything that it reads. `options.workspace` must not be null. Throws
  /// lang::StopRequested if `stop`, which may be null, is made.
  CheckedScene(std::shared_ptr<const lang::Document> root, const lang::ProgramOptions& options,
               const lang::StopRequest* stop);
  CheckedScene(const CheckedScene&) = delete;
  CheckedScene& operator=(const CheckedScene&) = delete;

  const lang::Document& root() const noexcept { return *root_; }
  const lang::SourceFile& file() const override { return *root_; }
  std::size_t error_count() const override { return sink_.error_count(); }
  const lang::Findings& findings() const override { return findings_; }
  /// The files that the scene reads, by name, without the root.
  std::vector<std::filesystem::path> dependencies() const { return compiler_.dependencies(); }
  /// The mistakes in the `.sdlc.toml` files, with their places.
  const std::vector<std::string>& config_errors() const noexcept { return config_errors_; }

 private:
  void select(const lang::ProgramOptions& options);

  std::shared_ptr<const lang::Document> root_;
  lang::DiagnosticSink sink_;
  lang::Compiler compiler_;  // holds texts that the sink refers to
  lang::Findings findings_;
  std::vector<std::string> config_errors_;
};

}  // namespace sdlc::lsp
