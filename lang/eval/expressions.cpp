#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/eval/arithmetic.hpp"
#include "lang/eval/colors.hpp"
#include "lang/eval/evaluator.hpp"
#include "lang/eval/literals.hpp"
#include "lang/eval/logic.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

/// The operator between two operands: what stands there but blanks.
Location operator_location(ast::Node left, ast::Node right) {
  const SyntaxTree& tree = left.tree();
  Span span{left.span().end, right.span().begin};
  const std::string_view text = tree.text(span);
  const std::size_t first = text.find_first_of("+-*/^");
  if (first == std::string_view::npos) return right.location();
  span.begin += static_cast<std::uint32_t>(first);
  span.end = span.begin + 1;
  return tree.location(span);
}

bool is_name(ast::Node node) {
  return node.is(SyntaxKind::Reference) && node.text().find('.') == std::string_view::npos;
}

std::optional<std::string_view> nearest_function(const Declarations& declarations,
                                                 std::string_view name) {
  std::vector<std::string_view> candidates = declarations.function_names();
  for (const Function& function : all_functions()) candidates.push_back(function.name);
  for (const Builtin& builtin : all_builtins()) candidates.push_back(builtin.name);
  return nearest_name(name, candidates);
}

/// The default of a parameter that is not written.
Value default_of(const Property& parameter) {
  if (const auto* number = std::get_if<double>(&parameter.default_value)) return *number;
  if (const auto* word = std::get_if<std::string_view>(&parameter.default_value))
    return Word{std::string(*word)};
  if (const auto* triple = std::get_if<std::array<double, 3>>(&parameter.default_value)) {
    return render::LinearRgb{(*triple)[0], (*triple)[1], (*triple)[2]};
  }
  return {};
}

}  // namespace

Computed ExpressionEvaluator::evaluate(ast::Node node) {
  if (depth_ >= kMaxEvaluationDepth) {
    sink_.report(diag::too_deep, node.location(), kMaxEvaluationDepth);
    return Failed{};
  }
  ++depth_;
  Computed value = evaluate_inner(node);
  --depth_;
  return value;
}

Computed ExpressionEvaluator::evaluate_inner(ast::Node node) {
  switch (node.kind()) {
    case SyntaxKind::Number: return evaluate_number(node, sink_);
    case SyntaxKind::String: return evaluate_string(node, sink_);
    case SyntaxKind::Color: return decode_hex_color(node.text());
    case SyntaxKind::True: return true;
    case SyntaxKind::False: return false;
    case SyntaxKind::Group: return evaluate(*node.child(0));
    case SyntaxKind::Triple: return evaluate_triple(node);
    case SyntaxKind::Interval: return evaluate_interval(node);
    case SyntaxKind::Sum:
    case SyntaxKind::Product:
    case SyntaxKind::Power: return evaluate_chain(node);
    case SyntaxKind::Negative:
      return evaluate_negative(evaluate(*node.child(0)), node.location(), sink_);
    case SyntaxKind::Reference: return evaluate_reference(node);
    case SyntaxKind::Call: return evaluate_call({node});
    case SyntaxKind::Conditional: return evaluate_conditional(node);
    case SyntaxKind::Or:
    case SyntaxKind::And: return evaluate_logic(node);
    case SyntaxKind::Not: {
      const std::optional<bool> operand = evaluate_condition(*node.child(0), "not");
      return operand ? Computed(!*operand) : Failed{};
    }
    case SyntaxKind::Comparison: {
      const ast::Node left = *node.child(0), right = *node.child(1);
      return evaluate_comparison(evaluate(left), right.op(), evaluate(right), node.location(),
                                 sink_);
    }
    case SyntaxKind::List: return evaluate_list(node);
    case SyntaxKind::Postfix: return evaluate_postfix(node);
    default: return Failed{};  // what could not be read
  }
}

Computed ExpressionEvaluator::not_supported(ast::Node node, std::string_view what) {
  sink_.report(diag::not_supported, node.location(), what);
  return Failed{};
}

std::optional<bool> ExpressionEvaluator::evaluate_condition(ast::Node node, std::string_view word) {
  const Computed value = evaluate(node);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag;
  if (!has_failed(value)) {
    sink_.report(diag::not_a_condition, node.location(), word, describe(value));
  }
  return std::nullopt;
}

Computed ExpressionEvaluator::evaluate_conditional(ast::Node node) {
  std::optional<ast::Node> condition;
  for (const ast::Node child : node.children()) {
    if (!condition) {
      condition = child;
      continue;
    }
    const std::optional<bool> holds = evaluate_condition(*condition, "if");
    if (!holds) return Failed{};
    if (*holds) return evaluate(child);
    condition.reset();
  }
  // The last child has no condition: it is the value behind `else`.
  return condition ? evaluate(*condition) : Failed{};
}

Computed ExpressionEvaluator::evaluate_logic(ast::Node node) {
  const bool is_and = node.is(SyntaxKind::And);
  for (const ast::Node operand : node.children()) {
    const std::optional<bool> value = evaluate_condition(operand, is_and ? "and" : "or");
    if (!value) return Failed{};
    if (*value != is_and) return *value;
  }
  return is_and;
}

Computed ExpressionEvaluator::evaluate_list(ast::Node node) {
  std::vector<Computed> values;
  bool is_broken = false;
  for (const ast::Node element : node.children()) {
    Computed value = evaluate(element);
    if (has_failed(value)) {
      is_broken = true;
    } else if (values.empty() || are_of_one_type(values.front(), value)) {
      values.push_back(std::move(value));
    } else {
      sink_.report(diag::mixed_list, element.location(), describe(values.front()), describe(value));
      is_broken = true;
    }
  }
  if (is_broken) return Failed{};
  return ListValue(std::move(values));
}

Computed ExpressionEvaluator::evaluate_postfix(ast::Node node) {
  std::optional<Computed> value;
  for (const ast::Node part : node.children()) {
    if (!value) {
      value = evaluate(part);
    } else if (part.is(SyntaxKind::Member)) {
      value = evaluate_member(*value, name_behind_dot(part.text()), part.location());
    } else if (part.is(SyntaxKind::Index)) {
      value = evaluate_index(*value, part);
    } else {
      return Failed{};
    }
  }
  return value.value_or(Failed{});
}

Computed ExpressionEvaluator::evaluate_member(const Computed& value, std::string_view name,
                                              Location where) {
  if (has_failed(value)) return Failed{};
  const auto component = [&](render::Vec3 v) -> std::optional<double> {
    return name == "x"   ? std::optional(v.x)
           : name == "y" ? std::optional(v.y)
           : name == "z" ? std::optional(v.z)
                         : std::nullopt;
  };
  if (const auto* triple = std::get_if<Triple>(&value)) {
    if (const auto number = component(triple->value)) return Scalar{*number, triple->unit};
  } else if (const auto* angles = std::get_if<AngleTriple>(&value)) {
    if (const auto degrees = component(angles->degrees)) return Angle{*degrees};
  }
  sink_.report(diag::no_member, where, describe(value), name);
  return Failed{};
}

Computed ExpressionEvaluator::evaluate_index(const Computed& value, ast::Node index) {
  const std::optional<ast::Node> expression = index.child(0);
  const Computed position = expression ? evaluate(*expression) : Failed{};
  if (has_failed(value) || has_failed(position)) return Failed{};
  const auto* list = std::get_if<ListValue>(&value);
  if (list == nullptr) {
    sink_.report(diag::wrong_operand, index.location(), "[ ]", describe(value));
    return Failed{};
  }
  const auto* number = std::get_if<Scalar>(&position);
  if (number == nullptr || number->unit != Unit::None) {
    sink_.report(diag::wrong_argument, expression->location(), "[ ]", "a whole number",
                 describe(position));
    return Failed{};
  }
  if (number->value != std::floor(number->value)) {
    sink_.report(diag::not_whole, expression->location(), "[ ]", to_text(number->value))
        .help("round it with `floor(…)` or `round(…)`");
    return Failed{};
  }
  if (number->value < 0 || number->value >= static_cast<double>(list->size())) {
    sink_
        .report(diag::index_out_of_range, expression->location(), to_text(number->value),
                list->size())
        .help("the first element has index 0");
    return Failed{};
  }
  return (*list)[static_cast<std::size_t>(number->value)];
}

Computed ExpressionEvaluator::evaluate_builtin(const Builtin& builtin, ast::Call call) {
  std::vector<Computed> values;
  std::vector<Location> places;
  bool is_broken = false;
  for (const ast::Node argument : call.arguments()) {
    std::optional<ast::Node> value = argument;
    if (argument.is(SyntaxKind::Argument)) {
      const ast::Labeled labeled{argument};
      sink_.report(diag::unknown_argument, labeled.label_location(), labeled.label(), builtin.name)
          .help(fmt::format("its arguments have no names: `{}`", builtin.signature));
      value = labeled.value();
      is_broken = true;
    }
    values.push_back(value ? evaluate(*value) : Failed{});
    places.push_back(argument.location());
    is_broken = is_broken || has_failed(values.back());
  }
  if (is_broken) return Failed{};
  if (values.size() < builtin.least || values.size() > builtin.most) {
    const std::string_view number = builtin.least == builtin.most ? "" : "at least ";
    sink_
        .report(
            diag::wrong_argument_count, call.callee_location(), builtin.name,
            fmt::format("{}{} argument{}", number, builtin.least, builtin.least == 1 ? "" : "s"),
            values.size())
        .help(fmt::format("write `{}`", builtin.signature));
    return Failed{};
  }
  return builtin.evaluate({.name = builtin.name,
                           .arguments = values,
                           .places = places,
                           .where = call.callee_location(),
                           .sink = sink_});
}

Computed ExpressionEvaluator::evaluate_chain(ast::Node node) {
  std::optional<ast::Node> previous;
  Computed result;
  for (const ast::Node operand : node.children()) {
    if (!previous) {
      result = evaluate(operand);
    } else {
      const Location where = operator_location(*previous, operand);
      const Computed right = evaluate(operand);
      result = node.is(SyntaxKind::Power)
                   ? evaluate_power(result, right, where, sink_)
                   : evaluate_operation(result, operand.op(), right, where, sink_);
    }
    previous = operand;
  }
  return result;
}

Computed ExpressionEvaluator::evaluate_triple(ast::Node node) {
  std::array<double, 3> components{};
  Unit unit = Unit::None;
  std::size_t count = 0, angles = 0;
  bool has_failed_component = false;
  std::optional<ast::Node> first_number;
  for (const ast::Node component : node.children()) {
    const Computed value = evaluate(component);
    if (const auto* scalar = std::get_if<Scalar>(&value)) {
      if (!first_number) first_number = component;
      if (scalar->unit != Unit::None && unit != Unit::None && scalar->unit != unit) {
        sink_.report(diag::mixed_triple, component.location(), describe(Computed(Scalar{0, unit})),
                     describe(value));
        has_failed_component = true;
      }
      if (scalar->unit != Unit::None) unit = scalar->unit;
      components[count++] = scalar->value;
    } else if (const auto* angle = std::get_if<Angle>(&value)) {
      components[count++] = angle->degrees;
      ++angles;
    } else {
      if (!has_failed(value))
        sink_.report(diag::wrong_component, component.location(), describe(value));
      has_failed_component = true;
      ++count;
    }
  }
  if (has_failed_component) return Failed{};

  const render::Vec3 value{components[0], components[1], components[2]};
  if (angles == 3) return AngleTriple{value};
  if (angles == 0) return Triple{value, unit};
  auto report = sink_.report(diag::mixed_triple, first_number->location(), "an angle", "a number");
  if (first_number->is(SyntaxKind::Number)) {
    const std::uint32_t end = first_number->span().end;
    report.fix(node.tree().location({end, end}), "deg");
  }
  return Failed{};
}

Computed ExpressionEvaluator::evaluate_interval(ast::Node node) {
  const Computed from = evaluate(*node.child(0)), to = evaluate(*node.child(1));
  if (has_failed(from) || has_failed(to)) return Failed{};
  const auto* a = std::get_if<Scalar>(&from);
  const auto* b = std::get_if<Scalar>(&to);
  const bool agree =
      a && b && (a->unit == b->unit || a->unit == Unit::None || b->unit == Unit::None);
  if (!agree) {
    sink_.report(diag::wrong_operands, node.location(), "..", describe(from), describe(to));
    return Failed{};
  }
  return Bounds{a->value, b->value, a->unit == Unit::None ? b->unit : a->unit};
}

Computed ExpressionEvaluator::evaluate_call(ast::Call call) {
  const std::string_view callee = call.callee();
  if (names_.values.contains(first_name(callee))) return Failed{};  // reported where it is imported
  if (const auto function = declarations_.function(callee)) return call_declared(*function, call);
  if (const Builtin* builtin = find_builtin(callee)) return evaluate_builtin(*builtin, call);
  const Function* function = find_function(callee);
  if (function == nullptr) {
    if (is_later_function(callee)) {
      sink_.report(diag::not_supported, call.callee_location(), fmt::format("`{}` is", callee));
    } else {
      sink_.report(diag::unknown_function, call.callee_location(), callee)
          .suggest(nearest_function(declarations_, callee));
    }
    return Failed{};
  }

  Arguments arguments;
  std::size_t positional = 0;
  bool has_labels = false, is_broken = false;
  for (const ast::Node argument : call.arguments()) {
    std::optional<ast::Node> value = argument;
    std::size_t index = positional;
    if (argument.is(SyntaxKind::Error)) {
      is_broken = true;
      continue;
    }
    if (argument.is(SyntaxKind::Argument)) {
      has_labels = true;
      const ast::Labeled labeled{argument};
      value = labeled.value();
      const auto found = std::find_if(function->parameters.begin(), function->parameters.end(),
                                      [&](const Property& p) { return p.name == labeled.label(); });
      if (found == function->parameters.end()) {
        std::vector<std::string_view> names;
        for (const Property& parameter : function->parameters) names.push_back(parameter.name);
        sink_.report(diag::unknown_argument, labeled.label_location(), labeled.label(), callee)
            .suggest(nearest_name(labeled.label(), names));
        if (value) evaluate(*value);  // it may have mistakes of its own
        is_broken = true;
        continue;
      }
      index = static_cast<std::size_t>(found - function->parameters.begin());
    } else if (has_labels) {
      sink_.report(diag::positional_behind_named, argument.location());
      is_broken = true;
      continue;
    } else if (++positional > function->parameters.size()) {
      sink_.report(diag::too_many_arguments, argument.location(), callee,
                   function->parameters.size());
      is_broken = true;
      continue;
    }

    Slot& slot = arguments.slots[index];
    if (slot.is_written) {
      const Location where =
          argument.is(SyntaxKind::Argument) ? argument.head_location() : argument.location();
      sink_.report(diag::duplicate, where, "argument", function->parameters[index].name)
          .label(argument.tree().location(slot.span), "first given here");
      is_broken = true;
      continue;
    }
    slot.is_written = true;
    slot.span = value ? value->span() : argument.span();
    if (value) slot.value = evaluate_property(function->parameters[index], *value);
  }

  // What is missing is not reported where something could not be read: it may be that.
  for (std::size_t i = 0; i < function->parameters.size(); ++i) {
    const Property& parameter = function->parameters[i];
    Slot& slot = arguments.slots[i];
    if (!slot.is_written && parameter.presence == Presence::Required) {
      if (!is_broken) {
        sink_.report(diag::missing, call.callee_location(), fmt::format("`{}`", callee),
                     parameter.name);
      }
      is_broken = true;
    } else if (!slot.is_written) {
      slot.value = default_of(parameter);
    } else if (std::holds_alternative<std::monostate>(slot.value)) {
      is_broken = true;
    }
  }
  if (is_broken) return Failed{};
  return call_function(*function, arguments, call, sink_);
}

// Properties

Value ExpressionEvaluator::evaluate_property(const Property& property, ast::Node node) {
  if (property.reads_none && is_name(node) && node.text() == "none") return None{};
  Value value = property.type == Type::Word ? evaluate_word(property, node)
                                            : to_property(property, evaluate(node), node);
  if (std::holds_alternative<std::monostate>(value)) return {};
  return check_property(property, value, node.location(), sink_) ? std::move(value) : Value{};
}

Value ExpressionEvaluator::wrong_type(const Property& property, std::string_view found,
                                      ast::Node node) {
  sink_.report(diag::wrong_type, node.location(), property.name, describe(property.type), found);
  return {};
}

Value ExpressionEvaluator::evaluate_word(const Property& property, ast::Node node) {
  if (is_name(node)) return Word{std::string(node.text())};
  const Computed computed = evaluate(node);
  if (has_failed(computed)) return {};
  auto report = sink_.report(diag::wrong_type, node.location(), property.name,
                             describe(property.type), describe(computed));
  if (const auto* text = std::get_if<std::string>(&computed)) {
    report.help("a word stands without quotes").fix(node.location(), *text);
  }
  return {};
}

Value ExpressionEvaluator::to_property(const Property& property, const Computed& computed,
                                       ast::Node node) {
  const auto wrong = [&] { return wrong_type(property, describe(computed), node); };
  if (const auto* scalar = std::get_if<Scalar>(&computed)) {
    const bool takes_unit = scalar->unit == Unit::None ||
                            (scalar->unit == Unit::Length && property.type == Type::Length);
    if (!takes_unit) return wrong();
    const bool is_literal = node.is(SyntaxKind::Number);
    if (property.type == Type::Angle && !is_literal) {
      sink_
          .report(diag::wrong_type, node.location(), property.name, describe(property.type),
                  describe(computed))
          .help("an angle has a unit: `40deg`, or `(…) * 1deg`");
      return {};
    }
    return scalar->value;
  }
  if (const auto* triple = std::get_if<Triple>(&computed)) {
    if (triple->unit == Unit::Time) return wrong();
    return triple->value;
  }
  if (const auto* bounds = std::get_if<Bounds>(&computed)) {
    if (bounds->unit == Unit::Length) return wrong();
    return render::Interval{bounds->from, bounds->to};
  }
  if (const auto* flag = std::get_if<bool>(&computed)) return *flag;
  if (const auto* text = std::get_if<std::string>(&computed)) return *text;
  if (const auto* angle = std::get_if<Angle>(&computed)) return *angle;
  if (const auto* color = std::get_if<render::LinearRgb>(&computed)) return *color;
  if (const auto* material = std::get_if<MaterialValue>(&computed)) return *material;
  if (const auto* motion = std::get_if<MotionValue>(&computed)) return *motion;
  if (!has_failed(computed)) return wrong();  // three angles, a list
  return {};
}

}  // namespace sdlc::lang
