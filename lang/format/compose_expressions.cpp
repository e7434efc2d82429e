#include <vector>

#include "lang/format/composer.hpp"

namespace sdlc::lang {
namespace {

bool is_chain(SyntaxKind kind) {
  switch (kind) {
    case SyntaxKind::Or:
    case SyntaxKind::And:
    case SyntaxKind::Comparison:
    case SyntaxKind::Interval:
    case SyntaxKind::Sum:
    case SyntaxKind::Product: return true;
    default: return false;
  }
}

/// Whether the node has brackets with indented contents.
bool is_bracketed(ast::Node node) {
  return node.is(SyntaxKind::Call) || node.is(SyntaxKind::List) ||
         node.is(SyntaxKind::Comprehension) || node.is(SyntaxKind::Triple);
}

/// Whether several such elements fit well on one line.
bool is_plain(ast::Node node) {
  switch (node.kind()) {
    case SyntaxKind::Number:
    case SyntaxKind::String:
    case SyntaxKind::Color:
    case SyntaxKind::True:
    case SyntaxKind::False:
    case SyntaxKind::Reference: return true;
    case SyntaxKind::Negative: return is_plain(*node.child(0));
    case SyntaxKind::Triple: {
      for (const ast::Node part : node.children()) {
        if (part.is(SyntaxKind::Triple) || !is_plain(part)) return false;
      }
      return true;
    }
    default: return false;
  }
}

bool are_plain(ast::Children nodes) {
  for (const ast::Node node : nodes) {
    if (!is_plain(node)) return false;
  }
  return true;
}

}  // namespace

/// `is_aligned`: the expression begins its line if it is broken, so that the lines of a chain are
/// not indented.
void Composer::expression(ast::Node node, bool is_aligned) {
  switch (node.kind()) {
    case SyntaxKind::Conditional: conditional(node); break;
    case SyntaxKind::LetIn: let_in(node); break;
    case SyntaxKind::Or:
    case SyntaxKind::And:
    case SyntaxKind::Comparison:
    case SyntaxKind::Interval:
    case SyntaxKind::Sum:
    case SyntaxKind::Product: chain(node, is_aligned); break;
    case SyntaxKind::Not:
      token();
      layout_.space();
      expression(*node.child(0));
      break;
    case SyntaxKind::Negative:
      token();
      expression(*node.child(0));
      break;
    case SyntaxKind::Power: power(node); break;
    case SyntaxKind::Postfix:
      for (const ast::Node part : node.children()) expression(part);
      break;
    case SyntaxKind::Index:
    case SyntaxKind::Group: enclosed(*node.child(0)); break;
    case SyntaxKind::Call: call(node); break;
    case SyntaxKind::Triple:
      sequence(node.children(), false, [this](ast::Node part) { expression(part); });
      break;
    case SyntaxKind::List: list(node); break;
    case SyntaxKind::Comprehension: comprehension(node); break;
    default: tokens_until(node.span().end); break;
  }
}

/// The value after `=` or `:`. A chain moves to its own line before it is broken.
void Composer::assigned(ast::Node value) {
  const bool is_long =
      is_chain(value.kind()) || value.is(SyntaxKind::Conditional) || value.is(SyntaxKind::LetIn);
  if (!is_long) {
    layout_.space();
    return expression(value);
  }
  layout_.open_group();
  indented_line(value);
  layout_.close_group();
}

void Composer::indented_line(ast::Node value) {
  layout_.indent();
  line();
  expression(value, true);
  layout_.dedent();
}

void Composer::chain(ast::Node chain, bool is_aligned) {
  leading_comments();
  layout_.open_group();
  bool is_first = true;
  for (const ast::Node operand : chain.children()) {
    if (!is_first) operator_and_line();
    expression(operand);
    if (is_first && !is_aligned) layout_.indent();
    is_first = false;
  }
  if (!is_aligned) layout_.dedent();
  layout_.close_group();
}

void Composer::power(ast::Node power) {
  expression(*power.child(0));
  token();  // ^
  expression(*power.child(1));
}

/// A conditional with a line break before an `else` keeps it, like a table of cases.
void Composer::conditional(ast::Node conditional) {
  leading_comments();
  layout_.open_group();
  const auto parts = conditional.children();
  bool is_first = true;
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    if (!is_first) {
      if (tokens_.is_broken_ahead()) layout_.break_group();
      line();
      token();  // else
      layout_.space();
    }
    is_first = false;
    const ast::Node condition = *part;
    if (!next_of(part, parts.end())) {
      expression(condition);
      break;
    }
    layout_.open_group();
    token();  // if
    layout_.space();
    expression(condition);
    layout_.indent();
    line();
    token();  // then
    layout_.space();
    expression(*++part);
    layout_.dedent();
    layout_.close_group();
  }
  layout_.close_group();
}

/// `let a = 1, b = 2 in a + b` on one line, or a line for each binding and one for the value.
void Composer::let_in(ast::Node let_in) {
  leading_comments();
  layout_.open_group();
  token();  // let
  layout_.space();
  bool is_first = true;
  for (const ast::Node part : let_in.children()) {
    if (!part.is(SyntaxKind::Binding)) {
      line();
      token();  // in
      layout_.space();
      expression(part);
      break;
    }
    if (!is_first) comma(Comma::Always), layout_.indent(), line(), layout_.dedent();
    is_first = false;
    token();            // name
    space_and_token();  // =
    assigned(*part.child(1));
  }
  layout_.close_group();
}

/// Brackets and contents on one line, or the contents indented on lines between the brackets.
template <typename Contents>
void Composer::bracketed(Contents contents) {
  token();
  layout_.open_group();
  layout_.indent();
  contents();
  comments_before_closer();
  layout_.dedent();
  layout_.soft_line();
  token();
  layout_.close_group();
}

/// `(value)` or `[index]`
void Composer::enclosed(ast::Node value) {
  bracketed([&] {
    soft_line();
    expression(value, true);
  });
}

/// `(a, b, c)` on one line, or one element per line. A hugged element is not indented.
template <typename Elements, typename Compose>
void Composer::sequence(const Elements& elements, bool is_hugged, Compose compose) {
  if (is_hugged) {
    token();
    compose(*elements.begin());
    comma(Comma::None);
    return token();
  }
  bool is_first = true;
  bracketed([&] {
    for (const ast::Node element : elements) {
      if (!is_first) comma(Comma::Always);
      is_first ? soft_line() : line();
      compose(element);
      is_first = false;
    }
    if (!is_first) comma(Comma::IfBroken);
  });
}

void Composer::parameters(ast::Node declaration) {
  std::vector<ast::Node> all;
  for (const ast::Node child : declaration.children()) {
    if (child.is(SyntaxKind::Parameter)) all.push_back(child);
  }
  sequence(all, false, [this](ast::Node each) { parameter(each); });
}

void Composer::loop_head(ast::Node loop) {
  token();  // for
  layout_.space();
  bool is_first = true;
  for (const ast::Node part : loop.child(0)->children()) {
    if (!is_first) comma(Comma::Always), layout_.space();
    is_first = false;
    if (part.is(SyntaxKind::Name)) {
      token();
    } else {
      sequence(part.children(), false, [this](ast::Node) { token(); });
    }
  }
  space_and_token();  // in
  layout_.space();
  expression(*loop.child(1));
}

void Composer::call(ast::Node call) {
  tokens_until(call.head_span().end);
  const auto arguments = call.children();
  const bool has_one =
      arguments.begin() != arguments.end() && !next_of(arguments.begin(), arguments.end());
  sequence(arguments, has_one && is_hugged(*arguments.begin(), tokens_.peek().span.end),
           [this](ast::Node each) { argument(each); });
}

/// Whether the only argument of a call has brackets itself, so that one indent is enough:
/// `normalize(cross(`. `inside`: the offset after the call's opening bracket.
bool Composer::is_hugged(ast::Node argument, std::uint32_t inside) const {
  const ast::Node value = argument.is(SyntaxKind::Argument) ? *argument.child(0) : argument;
  return is_bracketed(value) && skip_spaces(inside) == argument.span().begin &&
         closer_after(argument) == ')';
}

void Composer::argument(ast::Node argument) {
  if (!argument.is(SyntaxKind::Argument)) return expression(argument);
  token();  // label
  token();  // :
  assigned(*argument.child(0));
}

/// A list with a line break after its bracket keeps its rows, as long as they fit.
void Composer::list(ast::Node list) {
  bracketed([&] {
    const auto elements = list.children();
    const bool is_empty = elements.begin() == elements.end() && !tokens_.has_comments();
    const bool keeps_rows = !is_empty && tokens_.is_broken_ahead();
    const bool is_filled = keeps_rows || are_plain(elements);
    if (keeps_rows) layout_.break_group();
    bool is_first = true, ends_row = false;
    for (const ast::Node element : elements) {
      if (!is_first) {
        ends_row = tokens_.is_broken_ahead();
        comma(Comma::Always);
        ends_row = keeps_rows && (ends_row || tokens_.is_broken_ahead());
      }
      // A line in a group of its own is broken if the element after it does not fit.
      const bool is_row_filled = is_filled && !is_first && !ends_row;
      if (is_row_filled) layout_.open_group();
      is_first ? soft_line() : ends_row ? row_line() : line();
      expression(element);
      if (is_row_filled) layout_.close_group();
      is_first = false;
    }
    if (!is_first) comma(Comma::IfBroken);
  });
}

/// Value and clauses on one line, or a line for each, as where the bracket ends its line.
void Composer::comprehension(ast::Node list) {
  bracketed([&] {
    if (tokens_.is_broken_ahead()) layout_.break_group();
    soft_line();
    for (const ast::Node part : list.children()) {
      if (part.is(SyntaxKind::ForClause)) {
        line();
        loop_head(part);
      } else if (part.is(SyntaxKind::IfClause)) {
        line();
        token();  // if
        layout_.space();
        expression(*part.child(0));
      } else {
        expression(part);
      }
    }
  });
}

}  // namespace sdlc::lang
