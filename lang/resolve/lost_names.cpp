#include "lang/resolve/lost_names.hpp"

#include <algorithm>
#include <utility>

#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

LostNames::LostNames(const SyntaxTree& tree, const StopRequest* stop) {
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    stop_if_requested(stop);
    const ast::Node node(tree, i);
    if (node.is(SyntaxKind::Error)) read_skipped(node.text(), stop);
    if (node.is(SyntaxKind::Import) && !node.first(SyntaxKind::Name)) read_alias(node);
    const bool declares = node.is(SyntaxKind::Fn) || node.is(SyntaxKind::Def);
    if (!declares) continue;
    const auto name = node.first(SyntaxKind::Name);
    if (!name || name->span().size() > 0) continue;
    // The bracket is missing, so the name and the first parameter may be one word.
    const std::string_view rest = tree.file().text().substr(name->span().begin);
    merged_.push_back(rest.substr(0, end_of_identifier(rest, 0)));
  }
}

/// If the name of an import could not be read, it may be any word after the file in its line.
void LostNames::read_alias(ast::Node import) {
  const auto file = import.first(SyntaxKind::String);
  if (!file) return;
  TokenReader tokens(import.tree().file().text(), file->span().end);
  Token token = tokens.next();
  for (; token.kind != TokenKind::LineEnd && token.kind != TokenKind::End; token = tokens.next()) {
    if (token.kind == TokenKind::Name) merged_.push_back(tokens.text(token));
  }
}

/// A skipped text declares a name that is between a word and `=`, `(` or `:`, or after `as`, or
/// that begins the text and is followed by `=`.
void LostNames::read_skipped(std::string_view text, const StopRequest* stop) {
  TokenReader tokens(text);
  std::string_view last;  // the token before if it is a word of the same line
  Token token = tokens.next_in_line();
  for (; token.kind != TokenKind::End; token = tokens.next_in_line()) {
    stop_if_requested(stop);
    const std::string_view before = std::exchange(last, {});
    if (token.kind != TokenKind::Name) continue;
    const std::string_view word = last = tokens.text(token);
    TokenReader ahead = tokens;
    const char next = char_at(text, ahead.next_in_line().span.begin);
    const bool is_declared =
        !before.empty() && (next == '=' || next == '(' || next == ':' || before == "as");
    const bool is_assigned = token.span.begin == 0 && next == '=';
    if (is_declared || is_assigned) names_.insert(word);
    if (is_assigned) merged_.push_back(word);
  }
}

bool LostNames::contains(std::string_view name) const {
  if (names_.contains(name)) return true;
  return std::any_of(merged_.begin(), merged_.end(), [&](std::string_view word) {
    return word.starts_with(name) || word.ends_with(name);
  });
}

}  // namespace sdlc::lang
