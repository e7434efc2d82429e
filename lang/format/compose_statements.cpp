#include <optional>
#include <string_view>

#include "lang/ast/statements.hpp"
#include "lang/format/composer.hpp"

namespace sdlc::lang {
namespace {

/// Whether a property of this name would continue the previous statement if there were no comma.
bool continues_statement(std::string_view label) {
  return label == "and" || label == "or" || label == "else";
}

}  // namespace

void Composer::statement(ast::Node statement) {
  switch (statement.kind()) {
    case SyntaxKind::Version: words(2); break;
    case SyntaxKind::Property: property(statement); break;
    case SyntaxKind::Import: words(4); break;   // import file as name
    case SyntaxKind::Include: words(2); break;  // include file
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

/// Between two statements. Properties on one line have a comma; other statements only if it is
/// required.
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

/// `: type`, if it follows.
void Composer::type() {
  if (tokens_.peek_text() == ":") words(2);
}

void Composer::param(ast::Node param) {
  words(2);  // let name
  type();
  space_and_token();  // =
  assigned(*ast::expression_of(param));
}

void Composer::fn(ast::Node fn) {
  words(2);  // fn name
  parameters(fn);
  space_and_token();  // =
  assigned(*ast::expression_of(fn));
}

void Composer::def(ast::Node def) {
  words(2);  // def name
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
  indented_line(*assertion.child(1));
  layout_.close_group();
}

void Composer::for_loop(ast::Node loop) {
  loop_head(loop);
  const ast::Node body = *loop.child(2);
  block(body, body.children().begin());
}

/// Either all blocks of an `if` are on one line, or none is.
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

/// A block whose only property is a list and which opens and closes both brackets on one line:
///
///     belts saturn { colors: [
///       #6f7468, #87826a,
///     ] }
bool Composer::is_hugged_block(ast::Children::Iterator first, ast::Children::Iterator end) const {
  if (first == end || !(*first).is(SyntaxKind::Property)) return false;
  if (next_of(first, end)) return false;
  const ast::Node property = *first;
  const ast::Node value = *property.child(0);
  if (!value.is(SyntaxKind::List)) return false;
  const std::string_view text = tree_.file().text();
  const auto has_break = [&](std::uint32_t begin) {
    return text.substr(begin, skip_spaces(begin) - begin).find('\n') != std::string_view::npos;
  };
  const std::uint32_t inside = tokens_.peek().span.end;
  return !has_break(inside) && has_break(value.span().begin + 1) &&
         skip_spaces(inside) == property.span().begin && closer_after(property) == '}';
}

void Composer::braces(ast::Node block, ast::Children::Iterator first) {
  const auto end = block.children().end();
  if (is_hugged_block(first, end)) {
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
    separator(*first, next_of(first, end));
  }
  comments_before_closer();
  layout_.dedent();
  layout_.line();
  token();  // }
}

void Composer::parameter(ast::Node parameter) {
  token();  // name
  type();
  if (tokens_.peek_text() == "=") {
    space_and_token();
    assigned(*ast::expression_of(parameter));
  }
}

}  // namespace sdlc::lang
