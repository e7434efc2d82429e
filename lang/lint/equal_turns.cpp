#include <algorithm>
#include <cstdint>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/lint/context.hpp"

namespace sdlc::lang {
namespace {

/// The indices of the variables that the head of a loop declares; the body is its Block.
std::vector<std::size_t> variables_of(std::span<const Symbol> symbols, ast::Node loop,
                                      ast::Node body) {
  std::vector<std::size_t> variables;
  const auto first = std::ranges::lower_bound(symbols, loop.index(), {}, &Symbol::node);
  for (auto it = first; it != symbols.end() && it->node < body.index(); ++it) {
    if (it->kind != SymbolKind::LoopVariable || it->owner != loop.index()) continue;
    variables.push_back(static_cast<std::size_t>(it - symbols.begin()));
  }
  return variables;
}

bool has_object(ast::Node body) {
  const SyntaxTree& tree = body.tree();
  const NodeIndex end = body.index() + tree[body.index()].extent;
  for (NodeIndex i = body.index(); i < end; ++i) {
    if (tree[i].kind == SyntaxKind::Object) return true;
  }
  return false;
}

}  // namespace

/// The body of a `for` has objects and uses no variable of its loop. Expressions have no state, and
/// `random` is a function of its arguments, so every iteration makes the same objects at the same
/// place. A variable that begins with `_` is meant to be unused.
void check_equal_turns(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  const std::span<const Symbol> symbols = context.names().symbols();
  const std::vector<std::uint32_t> uses = context.names().count_uses(true, context.stop_request());
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    context.stop_if_requested();
    const ast::Node loop(tree, i);
    const auto body = loop.is(SyntaxKind::For) ? loop.first(SyntaxKind::Block) : std::nullopt;
    if (!body) continue;
    const auto variables = variables_of(symbols, loop, *body);
    if (std::ranges::any_of(variables, [&](std::size_t v) { return uses[v] > 0; })) continue;
    const auto named = std::ranges::find_if(
        variables, [&](std::size_t v) { return !symbols[v].name.starts_with('_'); });
    if (named == variables.end() || !has_object(*body)) continue;
    const Symbol& variable = symbols[*named];
    Finding& finding =
        context.add(diag::equal_turns, LintPlace::of(tree.location(variable.where)), variable.name);
    finding.help.push_back(fmt::format(
        "use `{0}` in the objects, or rename it to `_{0}` to keep them", variable.name));
  }
}

}  // namespace sdlc::lang
