#include "cli/scene_names.hpp"

#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

using lang::SyntaxKind;

std::vector<lang::ast::Node> cameras_of(const lang::SyntaxTree& tree) {
  std::vector<lang::ast::Node> cameras;
  for (const lang::ast::Node statement : lang::ast::Node(tree, 0).children()) {
    if (statement.is(SyntaxKind::Object) && statement.head() == "camera") {
      cameras.push_back(statement);
    }
  }
  return cameras;
}

std::string_view name_of(const lang::ast::Node& object) {
  const auto name = object.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

std::vector<std::string> camera_names(const lang::Document& scene) {
  std::vector<std::string> names;
  lang::DiagnosticSink ignored;
  for (const lang::ast::Node& camera : cameras_of(scene.tree(ignored))) {
    if (!name_of(camera).empty()) names.emplace_back(name_of(camera));
  }
  return names;
}

std::vector<std::string> param_names(const lang::Document& scene) {
  std::vector<std::string> names;
  lang::DiagnosticSink ignored;
  for (const lang::ast::Node statement : lang::ast::Node(scene.tree(ignored), 0).children()) {
    if (statement.is(SyntaxKind::Param)) names.emplace_back(name_of(statement));
  }
  return names;
}

}  // namespace sdlc::cli
