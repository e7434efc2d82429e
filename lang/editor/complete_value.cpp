#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/completion_builder.hpp"
#include "lang/editor/snippets.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/resolve/symbol_types.hpp"
#include "lang/value/colors.hpp"

namespace sdlc::lang {
namespace {

/// The ranks of values, after named arguments. A value that has the type comes before functions
/// that return it.
enum Fit : int { kArgument, kFits, kMakes, kUnknown, kConverts, kWords, kMismatch, kColors };
enum Distance : int { kGlobal = 100, kImport = 200, kLiteral = 250, kBuiltIn = 300 };

/// A name that the declaration around the cursor declares is not visible in its value.
bool is_own_name(const CompletionBuilder& builder, const Symbol& symbol) {
  const OpenBracket& file = builder.place().brackets.front();
  const bool is_value = file.word == "let" || file.word == "param";
  return is_value && file.name.data() == builder.text().data() + symbol.where.begin;
}

/// "number = 2 * pi"
std::string detail_of(const SceneView& view, SymbolId id, std::string_view type) {
  constexpr std::size_t kMaxText = 40;
  const Symbol* symbol = view.index().find(id);
  if (symbol == nullptr || (symbol->kind != SymbolKind::Let && symbol->kind != SymbolKind::Param)) {
    return std::string(type);
  }
  const auto value = ast::expression_of(ast::Node(view.tree(id.file), symbol->node));
  const bool is_short =
      value && value->text().size() <= kMaxText && value->text().find('\n') == std::string::npos;
  if (!is_short) return std::string(type);
  return fmt::format("{}{}= {}", type, type.empty() ? "" : " ", value->text());
}

/// The fit of a value; a list also fits where one of its elements does.
int fit_of_symbol(const SceneView& view, SymbolId id, const ExpectedType& expected,
                  std::string_view type) {
  const int fit = fit_of(expected, type);
  if (type != "list" || fit != kConverts) return fit;
  const TypeInfo* element = element_type_of(view.index(), id);
  return element != nullptr && element->name == expected.type ? kMakes : fit;
}

void add_value(CompletionBuilder& builder, SymbolId id, std::string label,
               const ExpectedType& expected, std::string_view type, int distance) {
  builder.add(
      {.label = std::move(label),
       .kind = CompletionKind::Variable,
       .detail = detail_of(builder.view(), id, type),
       .documentation = builder.view().index().documentation(id)},
      {type.empty() && distance < kGlobal ? kFits
                                          : fit_of_symbol(builder.view(), id, expected, type),
       distance});
}

void add_locals(CompletionBuilder& builder, const ExpectedType& expected) {
  const SymbolTable& table = builder.view().table(builder.file());
  // The latest declaration first; those around the block later.
  int distance = 0;
  for (const auto& [local, depth] : visible_locals(builder.place())) {
    const Occurrence* found = table.at(local.where.begin);
    const bool is_recorded = found != nullptr && found->where == local.where;
    const SymbolId id = is_recorded ? found->symbol : SymbolId();
    std::string_view type = local.type;
    if (type.empty() && is_recorded) type = type_name_of(builder.view(), id);
    add_value(builder, id, std::string(local.name), expected, type, distance++);
  }
}

void add_globals(CompletionBuilder& builder, const ExpectedType& expected) {
  const SymbolTable& table = builder.view().table(builder.file());
  std::unordered_set<std::string_view> hidden;
  for (const VisibleLocal& visible : visible_locals(builder.place())) {
    hidden.insert(visible.local.name);
  }
  for (const Symbol& symbol : table.symbols()) {
    const bool is_global = !symbol.is_local && !symbol.is_duplicate && !symbol.name.empty() &&
                           (symbol.kind == SymbolKind::Let || symbol.kind == SymbolKind::Param);
    if (!is_global || !builder.accepts(symbol.name) || is_own_name(builder, symbol) ||
        hidden.contains(symbol.name)) {
      continue;
    }
    const SymbolId id = table.id_of(symbol);
    add_value(builder, id, std::string(symbol.name), expected, type_name_of(builder.view(), id),
              kGlobal);
  }
}

/// The fit of a function with this result: one step after that of a value.
int fit_of_result(const ExpectedType& expected, std::string_view result) {
  const int fit = fit_of(expected, result);
  return fit == kFits ? kMakes : fit;
}

void add_functions(CompletionBuilder& builder, const ExpectedType& expected) {
  SceneView& view = builder.view();
  for (const Definition& function : view.module(builder.file()).functions) {
    if (function.name.empty() || !builder.accepts(function.name)) continue;
    const SymbolId id{builder.file(), function.node};
    builder.add(function_item(view, id, std::string(function.name), builder.is_followed_by('(')),
                {fit_of_result(expected, type_name_of(view, id)), kGlobal});
  }
}

void add_imports(CompletionBuilder& builder, const ExpectedType& expected) {
  SceneView& view = builder.view();
  for (const auto& [name, import] : view.module(builder.file()).imports) {
    if (import.module >= view.file_count()) continue;
    const bool fits = add_members(builder, {builder.file(), import.node}, std::string(name) + ".",
                                  expected, !expected.is_unknown());
    builder.add({.label = std::string(name),
                 .kind = CompletionKind::Module,
                 .detail = view.file(import.module).name()},
                {fits ? kConverts : kMismatch, kImport});
  }
}

/// The names in a signature: "clamp(x, low, high)".
std::string placeholders_of(const Builtin& function) {
  if (function.min_arguments != function.max_arguments) return "$0";
  std::string text;
  int next = 1;
  std::string_view rest = function.signature.substr(function.name.size() + 1);
  rest = rest.substr(0, rest.find(')'));
  while (!rest.empty()) {
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

void add_builtins(CompletionBuilder& builder, const ExpectedType& expected) {
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

/// The rank of a named colour: white and the names of HTML 4 are the usual ones.
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
  const std::string stem = view.module(builder.file()).path.stem().string();
  return fmt::format("\"{}{}.png\"", stem, is_film ? ".####" : "");
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
}

/// The names of cameras, for `camera` of render.
void add_cameras(CompletionBuilder& builder) {
  const SymbolTable& table = builder.view().table(builder.file());
  for (const Symbol& symbol : table.symbols()) {
    if (symbol.kind != SymbolKind::Object) continue;
    const ast::Node node(table.tree(), symbol.node);
    if (node.head() != "camera") continue;
    builder.add({.label = std::string(symbol.name),
                 .kind = CompletionKind::Variable,
                 .detail = "camera",
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

/// The parameters of the call that have no value yet.
void add_named_arguments(CompletionBuilder& builder, const OpenBracket& call,
                         const Callee& callee) {
  std::vector<std::string_view> given = labels_after(builder.place(), builder.text());
  given.insert(given.end(), call.labels.begin(), call.labels.end());
  const bool has_colon = builder.is_followed_by(':');
  const std::size_t positional =
      call.commas - std::min<std::size_t>(call.commas, call.labels.size());
  const auto is_given = [&](std::size_t i, std::string_view name) {
    return i < positional || std::ranges::find(given, name) != given.end();
  };
  if (callee.constructor != nullptr) {
    const auto parameters = callee.constructor->parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (is_given(i, parameters[i].name)) continue;
      const int later = parameters[i].presence == Presence::Required ? 0 : kGlobal;
      builder.add(property_item(parameters[i], true, has_colon),
                  {kArgument, later + static_cast<int>(i)});
    }
  }
  const std::vector<SymbolId> parameters = parameters_of(builder.view(), callee.function);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (is_given(i, builder.view().index().find(parameters[i])->name)) continue;
    builder.add(parameter_item(builder.view(), parameters[i], true, has_colon),
                {kArgument, static_cast<int>(i)});
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

bool add_members(CompletionBuilder& builder, SymbolId import, std::string_view qualifier,
                 const ExpectedType& expected, bool only_fitting) {
  SceneView& view = builder.view();
  bool has_fitting = false;
  for (const SymbolId member : view.index().members(import)) {
    const Symbol& symbol = *view.index().find(member);
    if (symbol.name.empty() || symbol.kind == SymbolKind::Def) continue;
    const bool is_function = symbol.kind == SymbolKind::Fn;
    const std::string_view type = type_name_of(view, member);
    const int fit = is_function ? fit_of_result(expected, type) : fit_of(expected, type);
    has_fitting = has_fitting || fit != kMismatch;
    if (only_fitting && fit != kFits && fit != kMakes) continue;
    std::string label = std::string(qualifier) + std::string(symbol.name);
    if (is_function) {
      builder.add(function_item(view, member, std::move(label), builder.is_followed_by('(')),
                  {fit, kImport});
    } else {
      add_value(builder, member, std::move(label), expected, type, kImport);
    }
  }
  return has_fitting;
}

void complete_value(CompletionBuilder& builder) {
  const ExpectedType expected = expected_at(builder.view(), builder.file(), builder.place());
  if (expected.property != nullptr) add_words(builder, *expected.property);
  const bool is_word = expected.property != nullptr && expected.property->type == Type::Word;
  if (is_word) {
    if (expected.property->words.empty()) add_cameras(builder);
    return;
  }
  add_literals(builder, expected);
  add_locals(builder, expected);
  add_globals(builder, expected);
  add_functions(builder, expected);
  add_imports(builder, expected);
  add_builtins(builder, expected);
  add_builtin_values(builder, expected);
  add_value_words(builder, expected);
}

void complete_argument(CompletionBuilder& builder) {
  const OpenBracket& call = builder.place().inner();
  const std::string_view name = builder.text().substr(call.head.begin, call.head.size());
  const Callee callee = find_callee(builder.view(), builder.file(), name);
  add_named_arguments(builder, call, callee);
  // Positional arguments come first.
  if (call.labels.empty()) complete_value(builder);
}

}  // namespace sdlc::lang
