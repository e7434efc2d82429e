#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/completion_builder.hpp"
#include "lang/editor/data_columns.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/value/types.hpp"

/// Completions of members, numbers, colours, types and comments.
namespace sdlc::lang {
namespace {

void add_components(CompletionBuilder& builder, std::string_view type) {
  for (const std::string_view name : {"x", "y", "z"}) {
    builder.add({.label = std::string(name),
                 .kind = CompletionKind::Component,
                 .detail = std::string(type == "angles" ? "angle" : "number")},
                {});
  }
}

/// The columns of a data file whose names can follow a dot.
void add_columns(CompletionBuilder& builder, const Table& table) {
  int row = 0;
  for (const Column& column : table.columns()) {
    const bool is_name =
        !column.name.empty() && end_of_identifier(column.name, 0) == column.name.size();
    if (!is_name) continue;
    builder.add({.label = column.name,
                 .kind = CompletionKind::Component,
                 .detail = column.has_numbers() ? "number" : "string"},
                {0, row++});
  }
}

/// The symbol of a local or global value, or a member of an import.
SymbolId find_value(const CompletionBuilder& builder, Span path) {
  const std::string_view text = builder.text().substr(path.begin, path.size());
  const SymbolTable& table = builder.view().table(builder.file());
  for (const VisibleLocal& visible : visible_locals(builder.place())) {
    if (visible.local.name != text) continue;
    const Occurrence* found = table.at(visible.local.where.begin);
    return found == nullptr ? SymbolId() : found->symbol;
  }
  const Occurrence* found = table.at(path.end);
  if (found != nullptr && found->where.end == path.end) return found->symbol;
  const auto& globals = builder.view().module(builder.file()).global_names;
  const auto global = globals.find(text);
  if (global == globals.end()) return {};
  return {builder.file(), builder.view().module(builder.file()).globals[global->second].node};
}

void add_defs_of(CompletionBuilder& builder, SymbolId import) {
  for (const SymbolId member : builder.view().index().members(import)) {
    const Symbol& symbol = *builder.view().index().find(member);
    if (symbol.kind != SymbolKind::Def) continue;
    builder.add(
        def_item(builder.view(), member, std::string(symbol.name), builder.is_followed_by('{')),
        {});
  }
}

/// The units of the type.
std::vector<std::string_view> units_of(const ExpectedType& expected) {
  using Units = ExpectedType::Units;
  const std::vector<std::string_view> angles{"deg", "turn", "rad"}, lengths{"m", "cm", "mm", "km"},
      times{"s", "ms"};
  if (expected.type == "angle") return angles;
  std::vector<std::string_view> units;
  const bool is_any = expected.is_unknown() || expected.units == Units::Any;
  const bool is_number = expected.is_unknown() || expected.type == "number" ||
                         expected.type == "interval" || expected.type == "vec3";
  if (is_number && (is_any || expected.units == Units::Length)) units = lengths;
  if (is_number && (is_any || expected.units == Units::Time)) {
    units.insert(units.end(), times.begin(), times.end());
  }
  if (expected.is_unknown()) units.insert(units.begin(), angles.begin(), angles.end());
  return units;
}

}  // namespace

void complete_member(CompletionBuilder& builder) {
  const Span path = builder.place().inner().path;
  const std::string_view text = builder.text().substr(path.begin, path.size());
  const SymbolId import = find_import(builder.view(), builder.file(), text);
  if (builder.place().is_first_of_statement) {
    if (import.is_known()) add_defs_of(builder, import);
    return;
  }
  if (import.is_known()) {
    const ExpectedType expected = expected_at(builder.view(), builder.file(), builder.place());
    add_members(builder, import, "", expected, false);
    return;
  }
  const SymbolId value = path.size() == 0 ? SymbolId() : find_value(builder, path);
  if (const auto table = table_of_row(builder.view(), value)) return add_columns(builder, *table);
  const std::string_view type =
      value.is_known() ? type_name_of(builder.view(), value) : std::string_view();
  if (type.empty() || type == "vec3" || type == "angles") add_components(builder, type);
}

void complete_number(CompletionBuilder& builder) {
  const Span number = builder.place().token;
  const std::string_view text = builder.text().substr(number.begin, number.size());
  const std::size_t digits = std::min(text.find_first_not_of("0123456789._"), text.size());
  const std::uint32_t unit = number.begin + static_cast<std::uint32_t>(digits);
  if (builder.place().offset < unit || text.substr(0, digits).ends_with('.')) return;
  const ExpectedType expected = expected_at(builder.view(), builder.file(), builder.place());
  // `let x = 2` is complete.
  const bool is_any = expected.units == ExpectedType::Units::Any && expected.type != "angle";
  if (is_any && builder.place().offset == unit) return;
  builder.set_replaced(number);
  int row = 0;
  for (const std::string_view name : units_of(expected)) {
    builder.add(
        {.label = fmt::format("{}{}", text.substr(0, digits), name), .kind = CompletionKind::Unit},
        {0, row++});
  }
}

/// The colours that the file has already, where a colour may be.
void complete_color(CompletionBuilder& builder) {
  constexpr std::size_t kMaxColors = 100;
  const CursorPlace& place = builder.place();
  // Of the whole value: a colour can be a factor.
  const ExpectedType expected =
      expected_in(builder.view(), builder.file(), place, place.brackets.size() - 1);
  if (!expected.is_unknown() && expected.type != "color") return;
  const SyntaxTree& tree = builder.view().tree(builder.file());
  const Span typed = builder.place().token;
  builder.set_replaced(typed);
  std::set<std::string_view> colors;
  for (const SyntaxNode& node : tree.nodes()) {
    const bool is_other = node.kind == SyntaxKind::Color && node.begin != typed.begin;
    if (is_other && colors.size() < kMaxColors) colors.insert(tree.text(node.span()));
  }
  for (const std::string_view color : colors) {
    builder.add(
        {.label = std::string(color), .kind = CompletionKind::Color, .detail = std::string(color)},
        {});
  }
}

void complete_type(CompletionBuilder& builder) {
  int row = 0;
  for (const TypeInfo& type : all_types()) {
    builder.add({.label = std::string(type.name),
                 .kind = CompletionKind::Type,
                 .documentation = std::string(type.doc)},
                {0, row++});
  }
}

/// The codes of warnings in `// sdlc: allow(`.
void complete_comment(CompletionBuilder& builder) {
  const std::uint32_t offset = builder.place().offset;
  if (offset < builder.place().token.begin + 2) return;
  TokenReader tokens(builder.text().substr(0, offset), builder.place().token.begin + 2);
  for (const std::string_view part : {"sdlc", ":", "allow", "("}) {
    if (tokens.text(tokens.next_in_line()) != part) return;
  }
  Token last = tokens.next_in_line();
  std::uint32_t begin = offset;
  for (; last.kind != TokenKind::End; last = tokens.next_in_line()) {
    if (tokens.text(last) == ")") return;
    begin = is_name(last.kind) && last.span.end == offset ? last.span.begin : offset;
  }
  builder.set_replaced({begin, std::max(offset, end_of_identifier(builder.text(), begin))});
  int row = 0;
  for (const DiagnosticInfo* info : all_diagnostics()) {
    if (info->severity != Severity::Warning) continue;
    builder.add(
        {.label = std::string(info->code), .kind = CompletionKind::Code, .detail = title_of(*info)},
        {0, row++});
  }
}

}  // namespace sdlc::lang
