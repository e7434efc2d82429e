#include <optional>
#include <string_view>

#include "lang/ast/statements.hpp"
#include "lang/format/composer.hpp"

namespace sdlc::lang {
namespace {

/// A property of this name would continue the statement in front of it, were there no comma.
bool continues_statement(std::string_view label) {
  return label == "and" || label == "or" || label == "else";
}

}  // namespace

void Composer::statement(ast::Node statement) {
  switch (statement.kind()) {
    case SyntaxKind::Version: token(), space_and_token(); break;
    case SyntaxKind::Property: property(statement); break;
    case SyntaxKind::Import: import(); break;
    case SyntaxKind::Include: token(), space_and_token(); break;
    case SyntaxKind::Param:
    case SyntaxKind::Let: param(statement); break;
    case SyntaxKind::Fn: fn(statement); break;
    case SyntaxKind::Def: def(statement); break;
    case SyntaxKind::Assert: assertion(statement); break;
    case SyntaxKind::For: for_loop(statement); break;
    case SyntaxKind::If: condition(statement); break;
    default: object(statement); break;
  }
}

/// Between two statements: properties in one line have a comma, and nothing else has one unless it
/// must.
void Composer::separator(ast::Node statement, std::optional<ast::Node> next) {
  if (!next || statement.is(SyntaxKind::Version)) {
    comma(Comma::None);
  } else if (next->is(SyntaxKind::Property) && continues_statement(next->head())) {
    comma(Comma::Always);
  } else {
    comma(statement.is(SyntaxKind::Property) ? Comma::IfFlat : Comma::None);
  }
}

void Composer::property(ast::Node property) {
  token();  // label
  token();  // :
  assigned(*property.child(0));
}

void Composer::import() {
  token();            // import
  space_and_token();  // file
  space_and_token();  // as
  space_and_token();  // name
}

void Composer::param(ast::Node param) {
  token();            // param, let
  space_and_token();  // name
  if (tokens_.peek_text() == ":") {
    token();
    space_and_token();  // type
  }
  space_and_token();  // =
  assigned(*ast::expression_of(param));
}

void Composer::fn(ast::Node fn) {
  token();            // fn
  space_and_token();  // name
  parameters(fn);
  space_and_token();  // =
  assigned(*ast::expression_of(fn));
}

void Composer::def(ast::Node def) {
  token();            // def
  space_and_token();  // name
  parameters(def);
  const ast::Node body = *def.first(SyntaxKind::Block);
  block(body, body.children().begin());
}

void Composer::assertion(ast::Node assertion) {
  leading_comments();
  layout_.open_group();
  token();  // assert
  layout_.space();
  expression(*assertion.child(0));
  comma(Comma::Always);
  layout_.indent();
  line();
  expression(*assertion.child(1), true);
  layout_.dedent();
  layout_.close_group();
}

void Composer::for_loop(ast::Node loop) {
  token();            // for
  space_and_token();  // name
  space_and_token();  // in
  layout_.space();
  expression(*loop.child(1));
  const ast::Node body = *loop.child(2);
  block(body, body.children().begin());
}

/// All blocks of an `if` stand on one line, or none does.
void Composer::condition(ast::Node condition) {
  leading_comments();
  layout_.open_group();
  bool is_first = true;
  for (const ast::Node child : condition.children()) {
    if (!child.is(SyntaxKind::Block)) {
      if (!is_first) space_or_line(), token(), layout_.space();  // else
      token();                                                   // if
      layout_.space();
      expression(child);
      is_first = false;
      continue;
    }
    if (tokens_.peek_text() == "else") space_or_line(), token();
    space_or_line();
    braces(child, child.children().begin());
  }
  layout_.close_group();
}

void Composer::object(ast::Node object) {
  tokens_until(object.head_span().end);  // kind
  auto first = object.children().begin();
  if (first != object.children().end() && (*first).is(SyntaxKind::Name)) {
    space_and_token();
    ++first;
  }
  block(object, first);
}

void Composer::block(ast::Node block, ast::Children::Iterator first) {
  space_or_line();
  layout_.open_group();
  braces(block, first);
  layout_.close_group();
}

/// A block with one property, a list, whose author wrote both brackets in one line:
///
///     belts saturn { colors: [
///       #6f7468, #87826a,
///     ] }
bool Composer::is_hugged_block(ast::Node block, ast::Children::Iterator first) const {
  const auto end = block.children().end();
  if (first == end || behind(first) != end || !(*first).is(SyntaxKind::Property)) return false;
  const ast::Node property = *first;
  const ast::Node value = *property.child(0);
  if (!value.is(SyntaxKind::List)) return false;
  const std::string_view text = tree_.file().text();
  const auto has_break = [&](std::uint32_t begin) {
    return text.substr(begin, skip_blanks(begin) - begin).find('\n') != std::string_view::npos;
  };
  std::uint32_t closer = skip_blanks(property.span().end);
  if (text[closer] == ',') closer = skip_blanks(closer + 1);
  return !has_break(tokens_.peek().span.end) && has_break(value.span().begin + 1) &&
         skip_blanks(tokens_.peek().span.end) == property.span().begin && text[closer] == '}';
}

void Composer::braces(ast::Node block, ast::Children::Iterator first) {
  const auto end = block.children().end();
  if (is_hugged_block(block, first)) {
    token();  // {
    layout_.space();
    statement(*first);
    comma(Comma::None);
    space_and_token();  // }
    return;
  }
  token();  // {
  if (first == end && !tokens_.has_comments()) return token();
  if (tokens_.is_broken_ahead()) layout_.break_group();
  layout_.indent();
  for (; first != end; ++first) {
    row_line();
    statement(*first);
    separator(*first, behind(first) == end ? std::nullopt : std::optional(*behind(first)));
  }
  comments_before_closer();
  layout_.dedent();
  layout_.line();
  token();  // }
}

void Composer::parameter(ast::Node parameter) {
  token();  // name
  if (tokens_.peek_text() == ":") {
    token();
    space_and_token();  // type
  }
  if (tokens_.peek_text() == "=") {
    space_and_token();
    assigned(*ast::expression_of(parameter));
  }
}

}  // namespace sdlc::lang
