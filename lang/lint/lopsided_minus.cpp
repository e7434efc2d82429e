#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/lint/context.hpp"

namespace sdlc::lang {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Checks the operators of one sum.
void check_sum(LintContext& context, ast::Node sum) {
  const std::string_view text = context.file().text();
  std::uint32_t end = 0;  // of the previous operand
  for (const ast::Node operand : sum.children()) {
    context.stop_if_requested();
    const std::uint32_t begin = operand.span().begin;
    const bool is_lopsided = operand.op() == Operator::Subtract && begin > end + 1 &&
                             text[begin - 1] == '-' && is_blank(text[begin - 2]);
    if (is_lopsided) {
      const Location where = sum.tree().location({begin - 1, begin});
      Finding& finding = context.add(diag::lopsided_minus, LintPlace::of(where));
      finding.help.push_back("for two elements add a comma before it");
      finding.fixes.push_back({sum.tree().location({begin, begin}), " ", true});
    }
    end = operand.span().end;
  }
}

}  // namespace

/// There is a space before a `-` and none after it, as in `[x -1]`: a list of one element, x − 1,
/// that looks like a list of two. The fix makes the spacing match the meaning.
void check_lopsided_minus(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    context.stop_if_requested();
    if (tree[i].kind == SyntaxKind::Sum) check_sum(context, ast::Node(tree, i));
  }
}

}  // namespace sdlc::lang
