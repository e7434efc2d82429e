#include "lang/editor/scene_view.hpp"

#include <utility>

namespace sdlc::lang {
namespace {

DiagnosticSink muted_sink(const StopRequest* stop) {
  DiagnosticSink sink(stop);
  sink.set_muted(true);
  return sink;
}

ProgramOptions resolves_later(ProgramOptions options) {
  options.resolves_later = true;
  return options;
}

}  // namespace

SceneView::SceneView(std::shared_ptr<const Document> root, const ProgramOptions& options,
                     const StopRequest* stop)
    : root_(std::move(root)),
      options_(resolves_later(options)),
      ignored_(muted_sink(stop)),
      program_(*root_, options_, ignored_),
      index_(program_, ignored_) {}

Program& SceneView::program() {
  DiagnosticSink ignored = muted_sink(nullptr);
  program_.resolve_declarations(ignored);
  return program_;
}

std::optional<std::uint32_t> SceneView::find(const std::filesystem::path& path) const {
  const Workspace& workspace = *options_.workspace;
  const std::filesystem::path wanted = workspace.identity(path);
  for (std::uint32_t file = 0; file < file_count(); ++file) {
    if (workspace.identity(module(file).path) == wanted) return file;
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
