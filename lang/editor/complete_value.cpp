#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/complete_builtin.hpp"
#include "lang/editor/completion_builder.hpp"
#include "lang/editor/data_columns.hpp"
#include "lang/resolve/symbol_types.hpp"

namespace sdlc::lang {
namespace {

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

/// The names of a `let … in` around the cursor, which the tokens do not show.
void add_bindings(CompletionBuilder& builder, const ExpectedType& expected) {
  const SymbolTable& table = builder.view().table(builder.file());
  for (const Symbol* symbol : table.visible(builder.place().offset, NameSpace::Values)) {
    const bool is_binding = table.tree()[symbol->node].kind == SyntaxKind::Binding;
    if (!is_binding || !builder.accepts(symbol->name)) continue;
    const SymbolId id = table.id_of(*symbol);
    add_value(builder, id, std::string(symbol->name), expected, type_name_of(builder.view(), id),
              0);
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
                           (symbol.kind == SymbolKind::Let || symbol.kind == SymbolKind::Param ||
                            table_of(builder.view(), table.id_of(symbol)) != nullptr);
    if (!is_global || !builder.accepts(symbol.name) || is_own_name(builder, symbol) ||
        hidden.contains(symbol.name)) {
      continue;
    }
    const SymbolId id = table.id_of(symbol);
    add_value(builder, id, std::string(symbol.name), expected, type_name_of(builder.view(), id),
              kGlobal);
  }
}

void add_declared_functions(CompletionBuilder& builder, const ExpectedType& expected) {
  SceneView& view = builder.view();
  const SymbolTable& table = view.table(builder.file());
  for (const Symbol* function : table.visible(builder.place().offset, NameSpace::Functions)) {
    if (!builder.accepts(function->name)) continue;
    const SymbolId id = table.id_of(*function);
    builder.add(function_item(view, id, std::string(function->name), builder.is_followed_by('(')),
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
  if (callee.builtin != nullptr && positional >= callee.builtin->min_arguments) {
    const auto options = callee.builtin->options;
    for (std::size_t i = 0; i < options.size(); ++i) {
      if (is_given(callee.builtin->max_arguments + i, options[i].name)) continue;
      builder.add(property_item(options[i], true, has_colon), {kArgument, static_cast<int>(i)});
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
  if (is_word) return;
  add_literals(builder, expected);
  add_locals(builder, expected);
  add_bindings(builder, expected);
  add_globals(builder, expected);
  add_declared_functions(builder, expected);
  add_imports(builder, expected);
  add_builtins(builder, expected);
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
