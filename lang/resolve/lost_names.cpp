#include "lang/resolve/lost_names.hpp"

#include <algorithm>

#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

/// Calls `function(begin, end)` for each identifier of the text.
template <typename Function>
void for_each_identifier(std::string_view text, Function function) {
  for (std::uint32_t at = 0; at < text.size();) {
    const std::uint32_t end = end_of_identifier(text, at);
    if (end > at) function(at, end);
    at = std::max(end, at + 1);
  }
}

}  // namespace

LostNames::LostNames(const SyntaxTree& tree) {
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    const ast::Node node(tree, i);
    if (node.is(SyntaxKind::Error)) read_skipped(node.text());
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
  std::string_view rest = import.tree().file().text().substr(file->span().end);
  rest = rest.substr(0, rest.find('\n'));
  for_each_identifier(rest, [&](std::uint32_t begin, std::uint32_t end) {
    merged_.push_back(rest.substr(begin, end - begin));
  });
}

/// A skipped text declares a name that is between a word and `=`, `(` or `:`, or after `as`, or
/// that begins the text and is followed by `=`.
void LostNames::read_skipped(std::string_view text) {
  std::string_view last;
  std::uint32_t last_end = 0;
  for_each_identifier(text, [&](std::uint32_t begin, std::uint32_t end) {
    const std::string_view word = text.substr(begin, end - begin);
    const char next = char_at(text, skip_blanks(text, end));
    const bool follows_word = !last.empty() && skip_blanks(text, last_end) == begin;
    const bool is_declared =
        follows_word && (next == '=' || next == '(' || next == ':' || last == "as");
    const bool is_assigned = begin == 0 && next == '=';
    if (is_declared || is_assigned) names_.insert(word);
    if (is_assigned) merged_.push_back(word);
    last = word;
    last_end = end;
  });
}

bool LostNames::contains(std::string_view name) const {
  if (names_.contains(name)) return true;
  return std::any_of(merged_.begin(), merged_.end(), [&](std::string_view word) {
    return word.starts_with(name) || word.ends_with(name);
  });
}

}  // namespace sdlc::lang
