#include "lang/resolve/lost_names.hpp"

#include <algorithm>

#include "lang/ast/ast.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {

LostNames::LostNames(const SyntaxTree& tree) {
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    const ast::Node node(tree, i);
    if (node.is(SyntaxKind::Error)) read_skipped(node.text());
    if (node.is(SyntaxKind::Import) && !node.first(SyntaxKind::Name)) read_alias(node);
    const bool declares = node.is(SyntaxKind::Fn) || node.is(SyntaxKind::Def);
    if (!declares) continue;
    const auto name = node.first(SyntaxKind::Name);
    if (!name || name->span().size() > 0) continue;
    // The bracket is missing: the name and that of the first parameter are one word.
    const std::string_view rest = tree.file().text().substr(name->span().begin);
    merged_.push_back(rest.substr(0, end_of_identifier(rest, 0)));
  }
}

/// The name of an import without an end may be any word of its line.
void LostNames::read_alias(ast::Node import) {
  const auto file = import.first(SyntaxKind::String);
  if (!file) return;
  std::string_view rest = import.tree().file().text().substr(file->span().end);
  rest = rest.substr(0, rest.find('\n'));
  for (std::uint32_t at = 0; at < rest.size();) {
    const std::uint32_t end = is_letter(rest[at]) ? end_of_identifier(rest, at) : at + 1;
    if (is_letter(rest[at])) merged_.push_back(rest.substr(at, end - at));
    at = end;
  }
}

/// A skipped text declares a name that is between a word and `=`, `(` or `:`, or after `as`, or
/// that begins the text and is followed by `=`.
void LostNames::read_skipped(std::string_view text) {
  std::string_view last;
  bool is_beside = false;
  for (std::uint32_t at = 0; at < text.size();) {
    if (!is_letter(text[at])) {
      is_beside = is_beside && (text[at] == ' ' || text[at] == '\t');
      ++at;
      continue;
    }
    const std::uint32_t end = end_of_identifier(text, at);
    const std::string_view word = text.substr(at, end - at);
    const char next = char_at(text, skip_blanks(text, end));
    const bool is_declared =
        is_beside && (next == '=' || next == '(' || next == ':' || last == "as");
    const bool is_assigned = at == 0 && next == '=';
    if (is_declared || is_assigned) names_.insert(word);
    if (is_assigned) merged_.push_back(word);
    last = word;
    is_beside = true;
    at = end;
  }
}

bool LostNames::contains(std::string_view name) const {
  if (names_.contains(name)) return true;
  return std::any_of(merged_.begin(), merged_.end(), [&](std::string_view word) {
    return word.starts_with(name) || word.ends_with(name);
  });
}

}  // namespace sdlc::lang
