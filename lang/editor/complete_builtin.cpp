#include "lang/editor/complete_builtin.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/editor/snippets.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

/// The names of the arguments in a signature, without options: "clamp(x, low, high)".
std::string placeholders_of(const Builtin& function) {
  if (function.min_arguments != function.max_arguments) return "$0";
  std::string text;
  int next = 1;
  std::string_view rest = function.signature.substr(function.name.size() + 1);
  rest = rest.substr(0, rest.find(')'));
  while (!rest.empty() && next <= static_cast<int>(function.max_arguments)) {
    const std::size_t end = std::min(rest.find(", "), rest.size());
    text += fmt::format("{}${{{}:{}}}", text.empty() ? "" : ", ", next++, rest.substr(0, end));
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  return text;
}

/// Materials and motions are made with named arguments, colours without.
std::string placeholders_of(const Constructor& constructor) {
  const bool is_color = result_of(constructor) == "color";
  std::string text;
  int next = 1;
  for (const Property& p : constructor.parameters) {
    if (p.presence != Presence::Required) continue;
    if (!text.empty()) text += ", ";
    if (!is_color) text += fmt::format("{}: ", p.name);
    text += is_color || p.type == Type::Number ? fmt::format("${{{}:{}}}", next++, p.name)
                                               : placeholder_of(p, next);
  }
  return text;
}

template <typename Function>
CompletionItem call_item(const CompletionBuilder& builder, const Function& function,
                         CompletionKind kind, std::string signature) {
  CompletionItem item{.label = std::string(function.name),
                      .kind = kind,
                      .detail = std::move(signature),
                      .documentation = std::string(function.doc)};
  if (builder.is_followed_by('(')) return item;
  item.text = item.label + "(";
  item.snippet = fmt::format("{}({})", item.label, placeholders_of(function));
  return item;
}

int fit_of_builtin(const ExpectedType& expected, const Builtin& function) {
  if (expected.is_condition) return kConverts;
  if (function.result.empty()) {
    const bool can_be = expected.is_unknown() || expected.type == "number" ||
                        expected.type == "vec3" || expected.type == "color";
    return can_be ? kConverts : kMismatch;
  }
  if (function.result != "=" || expected.is_unknown()) {
    return fit_of_result(expected, function.result);
  }
  const bool is_of_numbers = function.takes == "number";
  const bool can_be = expected.type == "number" || expected.type == "angle" ||
                      (!is_of_numbers && (expected.type == "vec3" || expected.type == "color"));
  return can_be ? kMakes : fit_of_result(expected, "number");
}

void add_builtin_functions(CompletionBuilder& builder, const ExpectedType& expected) {
  const bool is_motion = expected.property != nullptr && expected.property->type == Type::Motion;
  int row = kBuiltIn;
  for (const Constructor& constructor : all_constructors()) {
    const std::string_view result = result_of(constructor);
    const int fit =
        result.empty() ? (is_motion ? kFits : kMismatch) : fit_of_result(expected, result);
    if (fit == kMismatch || fit == kConverts || !builder.accepts(constructor.name)) continue;
    builder.add(
        call_item(builder, constructor, CompletionKind::Constructor, signature_of(constructor)),
        {fit, row++});
  }
  if (is_motion) return;
  for (const Builtin& function : all_builtins()) {
    // Most loops run over a range.
    const bool is_usual = builder.place().inner().word == "for" && function.name == "range";
    const int fit = is_usual ? kArgument : fit_of_builtin(expected, function);
    if (fit == kMismatch || !builder.accepts(function.name)) continue;
    builder.add(
        call_item(builder, function, CompletionKind::Function, std::string(function.signature)),
        {fit, row++});
  }
}

/// The rank of a named colour: the usual ones first.
int distance_of_color(std::string_view name) {
  static constexpr std::array<std::string_view, 16> kUsual{
      "white", "black", "gray", "silver", "red",  "orange", "yellow", "green",
      "lime",  "olive", "teal", "aqua",   "blue", "navy",   "purple", "maroon"};
  const auto found = std::ranges::find(kUsual, name);
  return kBuiltIn + 20 + static_cast<int>(found - kUsual.begin());
}

void add_builtin_values(CompletionBuilder& builder, const ExpectedType& expected) {
  for (const std::string_view name : {"pi", "time"}) {
    const SymbolId id = find_builtin_symbol(SymbolKind::BuiltinValue, name);
    const int fit = expected.is_condition ? kConverts : fit_of(expected, "number");
    if (fit == kMismatch) continue;
    builder.add({.label = std::string(name),
                 .kind = CompletionKind::Variable,
                 .detail = "number",
                 .documentation = std::string(builtin_symbols()[id.index].doc)},
                {fit == kFits ? kMakes : fit, kBuiltIn + 40});
  }
  if (expected.type != "color" && !expected.is_unknown()) return;
  for (const NamedColor& color : named_colors()) {
    builder.add({.label = std::string(color.name),
                 .kind = CompletionKind::Color,
                 .detail = fmt::format("#{:06x}", color.encoded)},
                {expected.is_unknown() ? kColors : kMakes, distance_of_color(color.name)});
  }
}

void add_literal(CompletionBuilder& builder, std::string label, std::string snippet,
                 std::string detail = {}) {
  builder.add({.label = label,
               .kind = CompletionKind::Literal,
               .detail = std::move(detail),
               .text = label,
               .snippet = std::move(snippet)},
              {kFits, kLiteral + static_cast<int>(builder.size())});
}

/// "demo.png" for demo.scene; numbered pictures for a film.
std::string picture_name(const CompletionBuilder& builder) {
  const SceneView& view = builder.view();
  bool is_film = false;
  for (const ast::Node child : ast::Node(view.tree(builder.file()), 0).children()) {
    is_film = is_film || (child.is(SyntaxKind::Object) && child.head() == "animation");
  }
  std::string stem = view.module(builder.file()).path.stem().string();
  if (stem.find_first_of("\"\\") != std::string::npos) stem = "picture";
  return fmt::format("\"{}{}.png\"", stem, is_film ? ".####" : "");
}

/// The names of cameras, for `camera` of render.
/// The names of objects of this kind: "camera" or "sphere".
void add_labels(CompletionBuilder& builder, std::string_view kind) {
  const SymbolTable& table = builder.view().table(builder.file());
  for (const Symbol& symbol : table.symbols()) {
    if (symbol.kind != SymbolKind::Object) continue;
    const ast::Node node(table.tree(), symbol.node);
    if (node.head() != kind) continue;
    builder.add({.label = std::string(symbol.name),
                 .kind = CompletionKind::Variable,
                 .detail = std::string(kind),
                 .documentation = table.documentation_of(symbol)},
                {kFits, 0});
  }
}

void add_value_words(CompletionBuilder& builder, const ExpectedType& expected) {
  builder.add({.label = "if",
               .kind = CompletionKind::Keyword,
               .documentation = "The one value or the other.",
               .text = "if ",
               .snippet = "if ${1:condition} then ${2:a} else ${3:b}"},
              {kWords, 0});
  if (expected.type != "bool" && !expected.is_unknown()) return;
  builder.add({.label = "not", .kind = CompletionKind::Keyword, .text = "not "}, {kWords, 1});
  if (expected.type == "bool" && !expected.is_condition) return;
  const CompletionRank rank =
      builder.prefix().empty() ? CompletionRank{kWords, 2} : CompletionRank{kUnknown, kLiteral};
  for (const std::string_view word : {"true", "false"}) {
    builder.add({.label = std::string(word), .kind = CompletionKind::Word}, rank);
  }
}

}  // namespace

int fit_of(const ExpectedType& expected, std::string_view type) {
  if (expected.is_unknown() || type.empty()) return kUnknown;
  if (expected.type.empty()) return kMismatch;
  const bool is_compared = type == "number" || type == "angle" || type == "string";
  if (expected.is_condition && is_compared) return kMakes;
  if (type == expected.type) return kFits;
  const bool is_factor = type == "number" && (expected.type == "vec3" || expected.type == "angle" ||
                                              expected.type == "color" || expected.type == "bool" ||
                                              expected.type == "interval");
  const bool has_components = (type == "vec3" && expected.type == "number") ||
                              (type == "angles" && expected.type == "angle");
  // Trigonometry takes angles.
  const bool is_argument = type == "angle" && expected.type == "number";
  return is_factor || has_components || is_argument || type == "list" ? kConverts : kMismatch;
}

int fit_of_result(const ExpectedType& expected, std::string_view result) {
  const int fit = fit_of(expected, result);
  return fit == kFits ? kMakes : fit;
}

void add_words(CompletionBuilder& builder, const Property& property) {
  int row = 0;
  const auto add = [&](std::string_view word) {
    builder.add({.label = std::string(word),
                 .kind = CompletionKind::Word,
                 .detail = word == property.default_text ? "default" : "",
                 .documentation = std::string(property.doc)},
                {kFits, row++});
  };
  for (const std::string_view word : property.words) add(word);
  if (property.reads_none) add("none");
  if (property.type == Type::Word && property.words.empty()) add_labels(builder, "camera");
  if (property.type == Type::Focus) add_labels(builder, "sphere");
}

void add_literals(CompletionBuilder& builder, const ExpectedType& expected) {
  const Property* property = expected.property;
  const Property* output = &kind_info(ObjectKind::Render).properties[render_property::kOutput];
  if (property == output) return add_literal(builder, picture_name(builder), {});
  if (expected.type == "bool" && !expected.is_condition) {
    for (const std::string_view word : {"true", "false"}) {
      builder.add({.label = std::string(word), .kind = CompletionKind::Word}, {kFits, kLiteral});
    }
  }
  if (!builder.prefix().empty()) return;
  if (expected.type == "vec3") add_literal(builder, "(0, 0, 0)", "(${1:0}, ${2:0}, ${3:0})");
  if (expected.type == "angles") {
    add_literal(builder, "(0deg, 0deg, 0deg)", "(${1:0}deg, ${2:0}deg, ${3:0}deg)");
  }
  if (expected.type == "angle") {
    add_literal(builder, "45deg", "${1:45}deg");
    add_literal(builder, "0.25turn", "${1:0.25}turn");
    add_literal(builder, "0deg", "${1:0}deg");
  }
  if (expected.type == "number" && expected.units == ExpectedType::Units::Time) {
    add_literal(builder, "20ms", "${1:20}ms");
    add_literal(builder, "1s", "${1:1}s");
  }
  if (property == nullptr) return;
  if (expected.type == "number" && !property->default_text.empty()) {
    add_literal(builder, std::string(property->default_text),
                fmt::format("${{1:{}}}", property->default_text), "default");
  }
  if (property->type == Type::Interval) add_literal(builder, "0s .. 20ms", "${1:0s} .. ${2:20ms}");
  if (property->type == Type::Frames) add_literal(builder, "1 .. 24", "${1:1} .. ${2:24}");
}

void add_builtins(CompletionBuilder& builder, const ExpectedType& expected) {
  add_builtin_functions(builder, expected);
  add_builtin_values(builder, expected);
  add_value_words(builder, expected);
}

}  // namespace sdlc::lang
