#include "lang/format/composer.hpp"

#include <algorithm>

namespace sdlc::lang {

// A comment keeps its place between two tokens and its place in the line: it stays on its own line,
// and it still ends its line.

/// Layouts the next comment.
void Composer::comment() {
  const PlacedComment comment = tokens_.take_comment();
  if (comment.breaks_before > 1) layout_.blank_line();
  if (comment.is_block) {
    layout_.block_comment(comment.span, comment.has_own_line(), comment.ends_line);
  } else {
    layout_.line_comment(comment.span, comment.has_own_line());
  }
}

/// The comments before the next token. A group that begins there does not contain them.
void Composer::leading_comments() {
  const bool has_comments = tokens_.has_comments();
  const bool is_apart = tokens_.peek().breaks_before > 1;
  while (tokens_.has_comments()) comment();
  if (has_comments && is_apart) layout_.blank_line();
}

void Composer::token() {
  leading_comments();
  layout_.token(tokens_.take().span);
}

void Composer::words(int count) {
  token();
  for (int i = 1; i < count; ++i) space_and_token();
}

void Composer::tokens_until(std::uint32_t end) {
  while (tokens_.peek().span.begin < end && !tokens_.is_at_end()) token();
}

/// The comments after the last token on its line, unless the next token is on that line too.
void Composer::trailing_comments() {
  const std::size_t count = tokens_.count_trailing_comments();
  if (count == 0 || !tokens_.comment(count - 1).ends_line) return;
  for (std::size_t i = 0; i < count; ++i) comment();
}

void Composer::line() {
  trailing_comments();
  layout_.line();
}

void Composer::soft_line() {
  trailing_comments();
  layout_.soft_line();
}

/// A line that keeps an empty line before it.
void Composer::row_line() {
  trailing_comments();
  layout_.line();
  if (tokens_.breaks_ahead() > 1) layout_.blank_line();
}

/// A space, or an unindented line if a comment forces one.
void Composer::space_or_line() {
  if (tokens_.ends_with_line_end()) {
    line();
  } else {
    layout_.space();
  }
}

/// Before a closing bracket: the comments belong to the contents.
void Composer::comments_before_closer() {
  const std::size_t trailing = tokens_.count_trailing_comments();
  for (std::size_t i = 0; i < trailing; ++i) comment();
  if (tokens_.has_comments()) layout_.line();
  while (tokens_.has_comments()) comment();
}

/// In a chain of operators, which is broken before them. A comment after an operator at the end of
/// a line moves to the operand before it.
void Composer::operator_and_line() {
  trailing_comments();
  if (tokens_.has_comments()) {
    layout_.line();
    token();
  } else {
    const PlacedToken op = tokens_.lift();
    trailing_comments();
    layout_.line();
    if (tokens_.ends_with_line_end()) {
      while (tokens_.has_comments()) comment();
    }
    layout_.token(op.span);
  }
  layout_.space();
}

/// Replaces the comma that follows, if any, by one of the given kind.
void Composer::comma(Comma comma) {
  while (tokens_.has_comments() && !tokens_.peek_comment().has_own_line() &&
         !tokens_.peek_comment().ends_line) {
    this->comment();
  }
  switch (comma) {
    case Comma::None: break;
    case Comma::Always: layout_.comma(); break;
    case Comma::IfFlat: layout_.flat_comma(); break;
    case Comma::IfBroken: layout_.broken_comma(); break;
  }
  if (tokens_.peek_text() == ",") tokens_.lift();
}

std::uint32_t Composer::skip_spaces(std::uint32_t at) const noexcept {
  const std::size_t found = tree_.file().text().find_first_not_of(" \t\r\n", at);
  return static_cast<std::uint32_t>(std::min(found, tree_.file().text().size()));
}

/// The character after the node and its comma.
char Composer::closer_after(ast::Node node) const noexcept {
  const std::string_view text = tree_.file().text();
  const std::uint32_t closer = skip_spaces(node.span().end);
  return text[text[closer] == ',' ? skip_spaces(closer + 1) : closer];
}

std::string Composer::file() {
  const ast::Node file(tree_, 0);
  printer_.reserve(tree_.file().text().size() + tree_.file().text().size() / 8);
  const auto end = file.children().end();
  for (auto at = file.children().begin(); at != end; ++at) {
    row_line();
    statement(*at);
    separator(*at, next_of(at, end));
    trailing_comments();
    printer_.print(layout_);
  }
  comments_before_closer();
  printer_.print(layout_);
  std::string text = printer_.take_text();
  text += '\n';
  return text;
}

Composer::Run Composer::run(std::span<const ast::Node> statements, std::uint32_t begin,
                            std::optional<ast::Node> next) {
  Run run;
  run.replaced.begin = tokens_.seek_line(begin);
  layout_.line();
  for (std::size_t i = 0; i + 1 < statements.size(); ++i) {
    statement(statements[i]);
    separator(statements[i], statements[i + 1]);
    row_line();
  }
  statement(statements.back());
  run.replaced.end = statements.back().span().end;
  // A comma after comments stays there with them.
  if (!tokens_.has_comments()) {
    if (tokens_.peek_text() == ",") run.replaced.end = tokens_.peek().span.end;
    separator(statements.back(), next);
  }
  for (std::size_t trailing = tokens_.count_trailing_comments(); trailing > 0; --trailing) {
    run.replaced.end = tokens_.peek_comment().span.end;
    comment();
  }
  printer_.print(layout_);
  run.text = printer_.take_text();
  return run;
}

}  // namespace sdlc::lang
