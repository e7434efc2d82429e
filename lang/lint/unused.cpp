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

/// The statement's lines, if nothing else is on them.
std::optional<Span> lines_of(std::string_view text, Span statement) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  std::uint32_t begin = statement.begin, end = statement.end;
  while (begin > 0 && is_blank(text[begin - 1])) --begin;
  while (end < text.size() && (is_blank(text[end]) || text[end] == ',')) ++end;
  if (begin > 0 && text[begin - 1] != '\n') return std::nullopt;
  if (end == text.size()) return Span{begin, end};
  if (text[end] != '\n') return std::nullopt;
  return Span{begin, end + 1};
}

}  // namespace

/// A let, param, fn, def or import that nothing in the file uses but itself. Only the root can
/// tell, and only if it places objects: what a library declares is for others. A name that begins
/// with
/// `_` is meant to be unused; so may be loop variables and parameters.
void check_unused(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  if (!has_objects(tree)) return;
  const FileNames names(tree);
  for (const DeclaredName& declared : names.declared()) {
    const std::string_view what = describe(declared);
    if (declared.is_used || declared.name.starts_with('_') || what.empty()) continue;
    Finding& finding =
        context.add(diag::unused, LintPlace::of(declared.where), what, declared.name);
    finding.help.push_back(fmt::format("if it shall stay, call it `_{}`", declared.name));
    if (const auto lines = lines_of(context.file().text(), tree[declared.statement].span())) {
      finding.fixes.push_back({tree.location(*lines), "", false});
    }
  }
}

}  // namespace sdlc::lang
