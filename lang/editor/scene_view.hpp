#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "lang/resolve/symbol_index.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// A scene with the files that it imports and includes, loaded but not evaluated: what an editor
/// asks about. Its answers are offsets in the texts of `file()`. Used by one thread at a time.
class SceneView {
 public:
  /// Errors of the scene are ignored: every text has a tree and symbols. `options.workspace` must
  /// not be null. Throws StopRequested if `stop`, which may be null, is made.
  SceneView(std::shared_ptr<const Document> root, const ProgramOptions& options,
            const StopRequest* stop = nullptr);
  SceneView(const SceneView&) = delete;
  SceneView& operator=(const SceneView&) = delete;

  const Document& root() const noexcept { return *root_; }
  /// For evaluations of values.
  Program& program();
  const ProgramOptions& options() const noexcept { return options_; }

  const SymbolIndex& index() const noexcept { return index_; }
  std::uint32_t file_count() const { return index_.file_count(); }
  const Module& module(std::uint32_t file) const { return program_.module(file); }
  const SourceFile& file(std::uint32_t file) const { return *module(file).file; }
  const SyntaxTree& tree(std::uint32_t file) const { return module(file).tree; }
  const SymbolTable& table(std::uint32_t file) const { return index_.table(file); }
  /// The index of the scene file at this path; nullopt if the scene does not read it.
  std::optional<std::uint32_t> find(const std::filesystem::path& path) const;

 private:
  std::shared_ptr<const Document> root_;
  ProgramOptions options_;
  DiagnosticSink ignored_;  ///< muted
  Program program_;
  SymbolIndex index_;
};

}  // namespace sdlc::lang
