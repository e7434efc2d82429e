#include "lang/editor/links.hpp"

#include <string>
#include <system_error>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

bool file_exists(const FileSystem& files, const fs::path& path) {
  if (files.is_special(path)) return false;
  std::error_code error;
  return files.read(path, 0, error).has_value();
}

}  // namespace

std::optional<fs::path> link_target(const SyntaxTree& tree, NodeIndex statement,
                                    const fs::path& path) {
  const auto name = ast::Node(tree, statement).first(SyntaxKind::String);
  if (!name) return std::nullopt;
  DiagnosticSink ignored;
  const Value value = evaluate_string(*name, ignored);
  const auto* written = get_if<std::string>(&value);
  // A path with a NUL would be cut off by the system.
  const bool is_path =
      written != nullptr && !written->empty() && written->find('\0') == std::string::npos;
  if (!is_path) return std::nullopt;
  return (path.parent_path() / *written).lexically_normal();
}

std::vector<FileLink> file_links(const SyntaxTree& tree, const fs::path& path,
                                 const FileSystem& files) {
  std::vector<FileLink> links;
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    const ast::Node statement(tree, i);
    if (!statement.is(SyntaxKind::Import) && !statement.is(SyntaxKind::Include)) continue;
    auto target = link_target(tree, i, path);
    if (!target) continue;
    const bool exists = file_exists(files, *target);
    links.push_back({.where = statement.first(SyntaxKind::String)->span(),
                     .target = *std::move(target),
                     .exists = exists});
  }
  return links;
}

}  // namespace sdlc::lang
