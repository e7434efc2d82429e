#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/logic.hpp"

// Triples, intervals and lists, and access to their parts.
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
  bool has_failed = false;
  for (const std::uint32_t operand : code.operands_of(e)) {
    Value value = evaluate(code, operand);
    if (is_nothing(value)) {
      has_failed = true;
    } else if (values.empty() || are_of_one_type(values.front(), value)) {
      values.push_back(std::move(value));
    } else {
      sink_.report(diag::mixed_list, place(code, operand), describe(values.front()),
                   describe(value));
      has_failed = true;
    }
  }
  if (has_failed) return Nothing{};
  return ListValue(std::move(values));
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

  const ast::Node member(*code.tree, e.node);
  const std::string_view text = member.text();
  const std::string_view name = text.substr(text.rfind('.') + 1);
  auto report = sink_.report(diag::no_member, member.location(), describe(value),
                             name.substr(std::min(name.find_first_not_of(" \t\r\n"), name.size())));
  if (triple != nullptr || angles != nullptr) report.help("its components are `.x`, `.y` and `.z`");
  if (holds_alternative<ListValue>(value)) {
    report.help("`len(list)` is the number of elements, `list[0]` the first one");
  }
  return Nothing{};
}

Value Evaluator::evaluate_index(const Code& code, const Expression& e) {
  const auto operands = code.operands_of(e);
  const Value value = evaluate(code, operands[0]), position = evaluate(code, operands[1]);
  if (is_nothing(value) || is_nothing(position)) return Nothing{};
  const auto* list = get_if<ListValue>(&value);
  if (list == nullptr) {
    auto report = sink_.report(diag::wrong_operand, location(code, e.node), "[ ]", describe(value));
    if (holds_alternative<Triple>(value)) report.help("its components are `.x`, `.y` and `.z`");
    return Nothing{};
  }
  const Location where = place(code, operands[1]);
  const auto* number = get_if<Scalar>(&position);
  if (number == nullptr || number->unit != Unit::None) {
    sink_.report(diag::wrong_argument, where, "[ ]", "a whole number", describe(position));
    return Nothing{};
  }
  if (number->value != std::floor(number->value)) {
    sink_.report(diag::not_whole, where, "[ ]", to_text(number->value))
        .help("round it with `floor(…)` or `round(…)`");
    return Nothing{};
  }
  if (number->value < 0 || number->value >= static_cast<double>(list->size())) {
    sink_.report(diag::index_out_of_range, where, to_text(number->value), list->size())
        .help("the first element has index 0");
    return Nothing{};
  }
  return (*list)[static_cast<std::size_t>(number->value)];
}

}  // namespace sdlc::lang
