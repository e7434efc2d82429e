#include <algorithm>

#include "lang/ast/ast.hpp"
#include "lang/lint/context.hpp"
#include "lang/resolve/builtin_symbols.hpp"

namespace sdlc::lang {
namespace {

bool is_open(const CheckedCamera& camera) {
  return camera.shutter && camera.shutter->from != camera.shutter->to;
}

bool is_film(const SyntaxTree& tree) {
  for (const ast::Node statement : ast::Node(tree, 0).children()) {
    if (statement.is(SyntaxKind::Object) && ast::Object{statement}.kind() == "animation") {
      return true;
    }
  }
  return false;
}

}  // namespace

/// The root uses `time`, but has no `animation`, and no camera has an open shutter. `time` is the
/// frame number divided by `fps`, which is 0 without an animation, and advances only while a
/// shutter is open, so here it is always 0. Files without cameras are checked where others include
/// them.
void check_time_stands_still(LintContext& context) {
  if (context.tree() == nullptr || context.is_part() || is_film(*context.tree())) return;
  if (std::ranges::any_of(context.lowered().checked_cameras, is_open)) return;
  const auto names = context.names().occurrences();
  const SymbolId time = find_builtin_symbol(SymbolKind::BuiltinValue, "time");
  const auto first = std::ranges::find(names, time, &Occurrence::symbol);
  if (first == names.end()) return;
  Finding& finding =
      context.add(diag::time_stands_still, LintPlace::of(context.tree()->location(first->where)));
  finding.help.push_back(
      "the file has no `animation { frames: …, fps: … }`, and no camera has a `shutter: … .. …`");
}

}  // namespace sdlc::lang
