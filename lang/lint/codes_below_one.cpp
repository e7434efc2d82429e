#include <algorithm>
#include <string>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/lint/context.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

/// The arguments of a call, if all of them are literal numbers; otherwise empty.
std::vector<double> literal_arguments(ast::Call call) {
  DiagnosticSink sink;
  std::vector<double> numbers;
  for (const ast::Node argument : call.arguments()) {
    const bool is_labeled = argument.is(SyntaxKind::Argument);
    const auto value = is_labeled ? ast::Labeled{argument}.value() : argument;
    if (!value || !value->is(SyntaxKind::Number)) return {};
    const auto number = value_as<double>(evaluate_number(*value, sink));
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

void check_call(LintContext& context, ast::Call call) {
  const std::vector<double> codes = literal_arguments(call);
  if (codes.size() != 3) return;
  const double largest = std::ranges::max(codes);
  if (!(largest > 0 && largest <= 1)) return;
  const Location callee = call.callee_location();
  if (context.names().at(callee.span.begin) != nullptr) return;  // a function of the file
  Finding& finding = context.add(diag::codes_below_one, LintPlace::of(call.node.location()));
  finding.help.push_back(fmt::format("as sRGB values from 0 to 1: `rgb({:.6g}, {:.6g}, {:.6g})`",
                                     255 * codes[0], 255 * codes[1], 255 * codes[2]));
  finding.fixes.push_back({callee, "linear", false});
}

}  // namespace

/// The three arguments of an `rgb` are literal numbers up to 1, but not all 0. They are codes from
/// 0 to 255, so the colour is at most 0.0003 of white, which no picture distinguishes from black.
/// Whether components from 0 to 1 are meant to be linear or sRGB values depends on the program that
/// they come from, so the fix is a guess.
void check_codes_below_one(LintContext& context) {
  const SyntaxTree& tree = *context.tree();
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i) {
    context.stop_if_requested();
    const ast::Call call{ast::Node(tree, i)};
    if (tree[i].kind == SyntaxKind::Call && call.callee() == "rgb") check_call(context, call);
  }
}

}  // namespace sdlc::lang
