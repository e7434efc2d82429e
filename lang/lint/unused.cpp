#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/lint/context.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

/// Whether the file places something; a library does not.
bool has_objects(const SyntaxTree& tree) {
  for (const ast::Node statement : ast::Node(tree, 0).children()) {
    const bool places = statement.is(SyntaxKind::Object) || statement.is(SyntaxKind::Include) ||
                        statement.is(SyntaxKind::For) || statement.is(SyntaxKind::If);
    if (places) return true;
  }
  return false;
}

bool may_be_unused(const Symbol& symbol) {
  return symbol.kind == SymbolKind::Parameter || symbol.kind == SymbolKind::LoopVariable ||
         symbol.name.starts_with('_');
}

/// The beginning of the doc comments in the lines above; `line`, the begin of the line, without
/// any.
std::uint32_t docs_begin(const SyntaxTree& tree, std::string_view text, std::uint32_t line) {
  const auto comments = tree.comments();
  auto above = std::ranges::lower_bound(comments, line, {},
                                        [](const Comment& comment) { return comment.span.begin; });
  while (above != comments.begin() && (--above)->kind == CommentKind::Doc) {
    const bool is_line_above = skip_blanks(text, above->span.end) + 1 == line;
    if (!is_line_above || !is_first_of_line(text, above->span.begin)) break;
    line = line_begin(text, above->span.begin);
  }
  return line;
}

/// The statement's lines with those of its doc comments, if nothing else is on them.
std::optional<Span> lines_of(const SyntaxTree& tree, std::string_view text, Span statement) {
  if (!is_first_of_line(text, statement.begin)) return std::nullopt;
  std::uint32_t end = skip_blanks(text, statement.end);
  if (char_at(text, end) == ',') end = skip_blanks(text, end + 1);
  if (end < text.size() && text[end] != '\n') return std::nullopt;
  const auto next_line = static_cast<std::uint32_t>(std::min<std::size_t>(end + 1, text.size()));
  return Span{docs_begin(tree, text, line_begin(text, statement.begin)), next_line};
}

}  // namespace

/// A let, param, fn, def or import that nothing in the file uses, except possibly itself. Checks
/// the root only, and only if it places objects and has a camera: declarations of a library or a
/// part are for other files. Loop variables, parameters and names that begin with `_` may be
/// unused.
void check_unused(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  if (context.is_part() || !has_objects(tree)) return;
  const std::string_view text = context.file().text();
  const std::span<const Symbol> symbols = context.names().symbols();
  const std::vector<std::uint32_t> uses = context.names().count_uses(false, context.stop_request());
  for (std::size_t i = 0; i < symbols.size(); ++i) {
    const Symbol& symbol = symbols[i];
    if (uses[i] > 0 || may_be_unused(symbol)) continue;
    Finding& finding = context.add(diag::unused, LintPlace::of(tree.location(symbol.where)),
                                   describe(symbol.kind), symbol.name);
    finding.help.push_back(fmt::format("to keep it, rename it to `_{}`", symbol.name));
    if (tree[symbol.node].kind == SyntaxKind::Binding) continue;  // a comma is removed too
    if (const auto lines = lines_of(tree, text, tree[symbol.node].span())) {
      finding.fixes.push_back({tree.location(*lines), "", false});
    }
  }
}

}  // namespace sdlc::lang
