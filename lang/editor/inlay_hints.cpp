#include "lang/editor/inlay_hints.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/editor/value_text.hpp"
#include "lang/editor/values.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/resolve/path.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

/// Whether the last name of the path is built in.
bool is_builtin(const SymbolTable& table, Span path) {
  const Occurrence* name = table.at(path.end);
  return name != nullptr && name->where.end == path.end && name->symbol.is_builtin();
}

/// Whether the value says as much as its result: literals, names of the language, and colours and
/// materials made of them.
bool is_plain(const SymbolTable& table, ast::Node value) {
  switch (value.kind()) {
    case SyntaxKind::Number:
    case SyntaxKind::String:
    case SyntaxKind::Color:
    case SyntaxKind::True:
    case SyntaxKind::False: return true;
    case SyntaxKind::Reference: return is_builtin(table, value.span());
    case SyntaxKind::Call:
      if (!is_builtin(table, value.head_span()) || find_constructor(value.head()) == nullptr)
        return false;
      break;
    case SyntaxKind::Negative:
    case SyntaxKind::Triple:
    case SyntaxKind::List:
    case SyntaxKind::Argument: break;
    default: return false;
  }
  for (const ast::Node child : value.children()) {
    if (!is_plain(table, child)) return false;
  }
  return true;
}

class HintReader {
 public:
  HintReader(SceneView& view, std::uint32_t file, Span range)
      : view_(view), file_(file), range_(range), values_(view) {}

  std::vector<InlayHint> read() {
    add_all(ast::Node(view_.tree(file_), 0));
    std::ranges::stable_sort(hints_, {}, &InlayHint::offset);
    return std::move(hints_);
  }

 private:
  bool is_in_range(std::uint32_t offset) const {
    return range_.begin <= offset && offset <= range_.end;
  }

  /// Skips nodes outside the range.
  void add_all(ast::Node parent) {
    for (const ast::Node node : parent.children()) {
      if (node.span().end < range_.begin) continue;
      if (node.span().begin > range_.end) return;
      if (node.is(SyntaxKind::Call)) add_arguments(node);
      if (node.is(SyntaxKind::Let) || node.is(SyntaxKind::Param)) add_value(node);
      add_all(node);
    }
  }

  void add_arguments(ast::Node call);
  std::vector<std::string_view> parameters_of(ast::Node call) const;
  void add_value(ast::Node statement);

  SceneView& view_;
  std::uint32_t file_;
  Span range_;
  Values values_;
  std::size_t expensive_ = 0;  ///< values that took too long
  std::vector<InlayHint> hints_;
};

/// The names of the parameters of the called function; empty if they have none.
std::vector<std::string_view> HintReader::parameters_of(ast::Node call) const {
  std::vector<std::string_view> names;
  // The last name of the path.
  const Occurrence* callee = view_.table(file_).at(call.head_span().end);
  if (callee == nullptr || callee->where.end != call.head_span().end) return names;
  if (callee->symbol.is_builtin()) {
    const BuiltinSymbol& builtin = builtin_symbols()[callee->symbol.index];
    const bool is_function = builtin.kind == SymbolKind::BuiltinFunction;
    const Constructor* constructor = is_function ? find_constructor(builtin.name) : nullptr;
    if (constructor == nullptr) return names;
    for (const Property& parameter : constructor->parameters) names.push_back(parameter.name);
    return names;
  }
  const Symbol* symbol = view_.index().find(callee->symbol);
  if (symbol == nullptr || symbol->kind != SymbolKind::Fn) return names;
  const SymbolTable& table = view_.table(callee->symbol.file);
  for (const Symbol& parameter : table.parameters_of(symbol->node)) {
    if (!parameter.is_duplicate) names.push_back(parameter.name);
  }
  return names;
}

void HintReader::add_arguments(ast::Node call) {
  const std::vector<std::string_view> names = parameters_of(call);
  std::size_t index = 0;
  for (const ast::Node argument : call.children()) {
    const bool is_positional =
        !argument.is(SyntaxKind::Argument) && !argument.is(SyntaxKind::Error);
    if (index >= names.size() || !is_positional) return;
    const std::string_view name = names[index++];
    // `f(radius)` needs no `radius:`.
    if (argument.text() == name || !is_in_range(argument.span().begin)) continue;
    hints_.push_back({.kind = InlayHint::Kind::Argument,
                      .offset = argument.span().begin,
                      .text = fmt::format("{}:", name)});
  }
}

void HintReader::add_value(ast::Node statement) {
  constexpr std::size_t kMaxExpensive = 10;  // each takes about a millisecond
  const auto value = ast::expression_of(statement);
  const auto name = statement.first(SyntaxKind::Name);
  const bool is_computed =
      value && name && is_in_range(value->span().end) && !is_plain(view_.table(file_), *value);
  if (!is_computed || expensive_ == kMaxExpensive) return;
  const ComputedValue computed = values_.of_symbol({file_, statement.index()});
  if (computed.status == ComputedValue::Status::TooExpensive) ++expensive_;
  if (computed.status != ComputedValue::Status::Known) return;
  const std::string text = short_text(computed.value);
  if (text == value->text()) return;
  hints_.push_back(
      {.kind = InlayHint::Kind::Computed,
       .offset = value->span().end,
       .text = fmt::format("= {}{}", text, computed.reads_time ? " at the first frame" : "")});
}

}  // namespace

std::vector<InlayHint> inlay_hints(SceneView& view, std::uint32_t file, std::optional<Span> range) {
  const auto size = static_cast<std::uint32_t>(view.file(file).text().size());
  return HintReader(view, file, range.value_or(Span{0, size})).read();
}

}  // namespace sdlc::lang
