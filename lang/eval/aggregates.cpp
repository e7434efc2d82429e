#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/eval/evaluator.hpp"
#include "lang/eval/type_hints.hpp"
#include "lang/object/table.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/value/element_type.hpp"
#include "lang/value/logic.hpp"

// Triples, intervals, lists and rows, and access to their parts.
namespace sdlc::lang {

Value Evaluator::evaluate_triple(const Code& code, const Expression& e) {
  std::array<double, 3> components{};
  Unit unit = Unit::None;
  std::size_t count = 0, angles = 0;
  bool has_failed = false;
  std::uint32_t first_number = kNothing;
  for (const std::uint32_t operand : code.operands_of(e)) {
    Value value;
    const Scalar scalar = evaluate_number(code, operand, value);
    if (is_number(scalar)) {
      if (first_number == kNothing) first_number = operand;
      if (!are_compatible(unit, scalar.unit)) {
        sink_.report(diag::mixed_triple, place(code, operand), describe(Value(Scalar{0, unit})),
                     describe(Value(scalar)));
        has_failed = true;
      }
      if (scalar.unit != Unit::None) unit = scalar.unit;
      components[count] = scalar.value;
    } else if (const auto* angle = get_if<Angle>(&value)) {
      components[count] = angle->degrees;
      ++angles;
    } else {
      if (!is_nothing(value)) {
        sink_.report(diag::wrong_component, place(code, operand), describe(value));
      }
      has_failed = true;
    }
    ++count;
  }
  if (has_failed || count != components.size()) return Nothing{};

  const render::Vec3 value{components[0], components[1], components[2]};
  if (angles == 3) return AngleTriple{value};
  if (angles == 0) return Triple{value, unit};
  auto report = sink_.report(diag::mixed_triple, place(code, first_number), "an angle", "a number");
  if (node(code, first_number).is(SyntaxKind::Number)) {
    const std::uint32_t end = node(code, first_number).span().end;
    report.unsafe_fix(code.tree->location({end, end}), "deg");
  }
  return Nothing{};
}

Value Evaluator::evaluate_interval(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value from = evaluate(code, operands[0]), to = evaluate(code, operands[1]);
  if (is_nothing(from) || is_nothing(to)) return Nothing{};
  const auto* a = get_if<Scalar>(&from);
  const auto* b = get_if<Scalar>(&to);
  if (a != nullptr && b != nullptr && are_compatible(a->unit, b->unit)) {
    return Bounds{a->value, b->value, common_unit(a->unit, b->unit)};
  }
  sink_.report(diag::wrong_operands, location(code, e.node), "..", describe(from), describe(to));
  return Nothing{};
}

Value Evaluator::evaluate_list(const Code& code, const Expression& e) {
  const std::uint64_t bytes = std::uint64_t{e.count} * sizeof(Value);
  if (!take_steps(code, e.node, work::kList + e.count) || !may_take_memory(code, e.node, bytes))
    return Nothing{};
  std::vector<Value> values;
  values.reserve(e.count);
  ElementType type;
  bool has_failed = false, is_mixed = false, are_lists = true;
  for (const std::uint32_t operand : code.operands_of(e)) {
    Value value = evaluate(code, operand);
    const ListValue* list = elements_of(value);
    are_lists = are_lists && list != nullptr;
    if (!take_steps(code, e.node, steps_to_compare(value))) return Nothing{};
    has_failed = has_failed || is_nothing(value);
    is_mixed = is_mixed || !type.admit(value);
    values.push_back(std::move(value));
  }
  if (has_failed) return Nothing{};
  if (!is_mixed) return ListValue(std::move(values));
  if (!are_lists) return RowValue{ListValue(std::move(values))};
  report_uneven_rows(code, e, ListValue(std::move(values)));
  return Nothing{};
}

/// The place of an element if the list is written there; else that of the list.
Location Evaluator::place_of_element(const Code& code, std::uint32_t list, std::size_t i) const {
  const ast::Node written = node(code, list);
  const auto element = written.is(SyntaxKind::List) ? written.child(i) : std::nullopt;
  return (element ? *element : written).location();
}

void Evaluator::report_uneven_rows(const Code& code, const Expression& e, const ListValue& rows) {
  ElementType type;
  std::size_t other = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (type.admit(rows[i])) continue;
    if (are_of_one_type(rows[other], rows[i])) {
      for (other = 0; are_of_one_type(rows[other], rows[i]);) ++other;
    }
    report_uneven_row(code, e, rows, other, i);
  }
}

void Evaluator::report_uneven_row(const Code& code, const Expression& e, const ListValue& rows,
                                  std::size_t other, std::size_t i) {
  const std::uint32_t written = code.operands_of(e)[i], before = code.operands_of(e)[other];
  const Value value = rows[i], other_value = rows[other];
  const ListValue &row = *elements_of(value), &other_row = *elements_of(other_value);
  const auto count = [](const ListValue& list) {
    return list.size() == 1 ? "1 element" : fmt::format("{} elements", list.size());
  };
  const std::string label = fmt::format("row {}", other + 1);
  if (row.size() != other_row.size()) {
    sink_
        .report(diag::uneven_rows, place(code, written), i + 1, count(row), other + 1,
                count(other_row))
        .label(place(code, before), label);
  } else if (const auto k = first_difference(other_row, row)) {
    const Value element = row[*k], other_element = other_row[*k];
    const bool are_rows =
        holds_alternative<RowValue>(element) && holds_alternative<RowValue>(other_element);
    sink_
        .report(diag::uneven_rows, place_of_element(code, written, *k), i + 1,
                are_rows ? "another row" : describe(element), other + 1, describe(other_element))
        .label(place_of_element(code, before, *k), label);
  } else {  // only one of them is a list of one type
    sink_.report(diag::mixed_list, place(code, written), describe(other_value), describe(value))
        .help("a list of several types is a row; metres and seconds are two types")
        .label(place(code, before), label);
  }
}

Value Evaluator::column_of(const Code& code, const ListValue& row, const ColumnName& column) {
  const Table& table = *row.table_of_row();
  if (const auto index = table.find(column.name)) return row[*index];
  auto report = sink_.report(diag::no_member, code.tree->location(column.where),
                             fmt::format("a row of `{}`", table.file()), column.name);
  if (!report.is_kept()) return Nothing{};
  const std::vector<std::string_view> names = table.names();
  if (const auto nearest = nearest_name(column.name, names)) {
    const bool is_name = end_of_identifier(*nearest, 0) == nearest->size();
    if (column.member.size() > 0 && is_name) {
      report.suggest(nearest);
    } else {
      const std::string text = to_text(Value(std::string(*nearest)));
      const bool is_member = column.member.size() > 0;
      report.help(fmt::format("did you mean `[{}]`?", text))
          .unsafe_fix(code.tree->location(is_member ? column.member : column.where),
                      is_member ? fmt::format("[{}]", text) : text);
    }
  }
  constexpr std::size_t kMaxNames = 20;
  const auto shown = std::span(names).first(std::min(names.size(), kMaxNames));
  report.help(fmt::format("its columns are {}{}", fmt::join(shown, ", "),
                          shown.size() < names.size() ? ", …" : ""));
  return Nothing{};
}

Value Evaluator::evaluate_member(const Code& code, const Expression& e) {
  const Value value = evaluate(code, code.operands_of(e)[0]);
  if (is_nothing(value)) return Nothing{};
  const auto component = [&](render::Vec3 v) {
    return e.detail == 'x' ? v.x : e.detail == 'y' ? v.y : v.z;
  };
  const auto* triple = get_if<Triple>(&value);
  if (triple != nullptr && e.detail != 0) return Scalar{component(triple->value), triple->unit};
  const auto* angles = get_if<AngleTriple>(&value);
  if (angles != nullptr && e.detail != 0) return Angle{component(angles->degrees)};
  const std::string_view name = code.names[code.operands_of(e)[1]];
  const ListValue* list = elements_of(value);
  if (list != nullptr && list->table_of_row() != nullptr) {
    const std::string_view text = code.tree->file().text();
    const auto begin = static_cast<std::uint32_t>(name.data() - text.data());
    const auto end = begin + static_cast<std::uint32_t>(name.size());
    const auto dot = static_cast<std::uint32_t>(text.rfind('.', begin));
    return column_of(code, *list, {.name = name, .where = {begin, end}, .member = {dot, end}});
  }

  auto report = sink_.report(diag::no_member, location(code, e.node), describe(value), name);
  if (triple != nullptr || angles != nullptr) report.help("its components are `.x`, `.y` and `.z`");
  if (holds_alternative<ListValue>(value)) {
    report.help("`len(list)` is the number of elements, `list[0]` the first one");
  } else if (list != nullptr) {
    report.help("its elements have no names: `row[0]` is the first one");
  }
  return Nothing{};
}

Value Evaluator::evaluate_index(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value value = evaluate(code, operands[0]), position = evaluate(code, operands[1]);
  if (is_nothing(value) || is_nothing(position)) return Nothing{};
  const ListValue* list = elements_of(value);
  if (list == nullptr) {
    auto report = sink_.report(diag::wrong_operand, location(code, e.node), "[ ]", describe(value));
    if (holds_alternative<Triple>(value)) report.help("its components are `.x`, `.y` and `.z`");
    return Nothing{};
  }
  const auto* name = get_if<std::string>(&position);
  if (name != nullptr && list->table_of_row() != nullptr) {
    const Span where = node(code, operands[1]).span();
    return column_of(code, *list, {.name = *name, .where = where, .member = {}});
  }
  const auto* positions = get_if<ListValue>(&position);
  if (positions != nullptr) return elements_at(code, e, *list, *positions);
  return element_at(*list, position, node(code, operands[1]));
}

Value Evaluator::elements_at(const Code& code, const Expression& e, const ListValue& list,
                             const ListValue& positions) {
  const ast::Node written = node(code, code.operands_of(e)[1]);
  const bool is_good = take_steps(code, e.node, work::kList + positions.size()) &&
                       may_take_memory(code, e.node, positions.size() * sizeof(Value));
  if (!is_good) return Nothing{};
  std::vector<Value> elements;
  elements.reserve(positions.size());
  ElementType type;
  bool is_mixed = false;  // some elements of a row
  for (std::size_t i = 0; i < positions.size(); ++i) {
    elements.push_back(element_at(list, positions[i], written));
    if (is_nothing(elements.back())) return Nothing{};
    if (!take_steps(code, e.node, steps_to_compare(elements.back()))) return Nothing{};
    is_mixed = is_mixed || !type.admit(elements.back());
  }
  ListValue chosen(std::move(elements));
  return is_mixed ? Value(RowValue{std::move(chosen)}) : Value(std::move(chosen));
}

Value Evaluator::element_at(const ListValue& list, const Value& position, ast::Node written) {
  const Location where = written.location();
  const auto* number = get_if<Scalar>(&position);
  if (number == nullptr || number->unit != Unit::None) {
    auto report =
        sink_.report(diag::wrong_argument, where, "[ ]", "a whole number", describe(position));
    const auto* bounds = get_if<Bounds>(&position);
    if (bounds != nullptr) report.help("the elements from a to b - 1 are `list[range(a, b)]`");
    if (bounds != nullptr && written.is(SyntaxKind::Interval)) {
      report.unsafe_fix(where, as_range(written, *bounds));
    }
    return Nothing{};
  }
  if (number->value != std::floor(number->value)) {
    sink_.report(diag::not_whole, where, "[ ]", to_text(number->value))
        .help("round it with `floor(…)` or `round(…)`");
    return Nothing{};
  }
  if (number->value < 0 || number->value >= static_cast<double>(list.size())) {
    sink_.report(diag::index_out_of_range, where, to_text(number->value), list.size())
        .help("the first element has index 0");
    return Nothing{};
  }
  return list[static_cast<std::size_t>(number->value)];
}

}  // namespace sdlc::lang
