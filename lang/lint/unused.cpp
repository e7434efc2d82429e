#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/lint/context.hpp"
#include "lang/lint/names.hpp"

namespace sdlc::lang {
namespace {

/// Whether the file places something, so that it is no library.
bool has_objects(const SyntaxTree& tree) {
  for (const ast::Node statement : ast::Node(tree, 0).children()) {
    const bool places = statement.is(SyntaxKind::Object) || statement.is(SyntaxKind::Include) ||
                        statement.is(SyntaxKind::For) || statement.is(SyntaxKind::If);
    if (places) return true;
  }
  return false;
}

/// What a message calls it; empty where it may be unused.
std::string_view describe(const DeclaredName& declared) {
  switch (declared.kind) {
    case DeclaredName::Let: return "value";
    case DeclaredName::Param: return "param";
    case DeclaredName::Import: return "import";
    case DeclaredName::Fn: return "function";
    case DeclaredName::Def: return "kind";
    default: return "";
  }
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::uint32_t line_begin(std::string_view text, std::uint32_t at) {
  while (at > 0 && is_blank(text[at - 1])) --at;
  return at;
}

/// Where the doc comments begin that stand in the lines above; else `line`, the line's own begin.
std::uint32_t docs_begin(const SyntaxTree& tree, std::string_view text, std::uint32_t line) {
  const auto comments = tree.comments();
  auto above = std::ranges::lower_bound(comments, line, {},
                                        [](const Comment& comment) { return comment.span.begin; });
  while (above != comments.begin() && (--above)->kind == CommentKind::Doc) {
    std::uint32_t end = above->span.end;
    while (end < line && is_blank(text[end])) ++end;
    const std::uint32_t begin = line_begin(text, above->span.begin);
    const bool is_line_above = end + 1 == line && text[end] == '\n';
    if (!is_line_above || (begin > 0 && text[begin - 1] != '\n')) break;
    line = begin;
  }
  return line;
}

/// The statement's lines with those of its doc comments, if nothing else is on them.
std::optional<Span> lines_of(const SyntaxTree& tree, std::string_view text, Span statement) {
  const std::uint32_t begin = line_begin(text, statement.begin);
  std::uint32_t end = statement.end;
  while (end < text.size() && (is_blank(text[end]) || text[end] == ',')) ++end;
  if (begin > 0 && text[begin - 1] != '\n') return std::nullopt;
  if (end < text.size() && text[end] != '\n') return std::nullopt;
  const auto behind = static_cast<std::uint32_t>(std::min<std::size_t>(end + 1, text.size()));
  return Span{docs_begin(tree, text, begin), behind};
}

}  // namespace

/// A let, param, fn, def or import that nothing in the file uses but itself. Only the root can
/// tell, and only if it places objects and has a camera: what a library or a part declares is for
/// others. A name that begins with `_` is meant to be unused; so may be loop variables and
/// parameters.
void check_unused(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  if (context.is_part() || !has_objects(tree)) return;
  const std::string_view text = context.file().text();
  const FileNames names(tree);
  for (const DeclaredName& declared : names.declared()) {
    const std::string_view what = describe(declared);
    if (declared.is_used || declared.name.starts_with('_') || what.empty()) continue;
    Finding& finding =
        context.add(diag::unused, LintPlace::of(declared.where), what, declared.name);
    finding.help.push_back(fmt::format("if it shall stay, call it `_{}`", declared.name));
    if (const auto lines = lines_of(tree, text, tree[declared.statement].span())) {
      finding.fixes.push_back({tree.location(*lines), "", false});
    }
  }
}

}  // namespace sdlc::lang
