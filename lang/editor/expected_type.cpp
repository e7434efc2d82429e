#include "lang/editor/expected_type.hpp"

#include <algorithm>
#include <span>

#include "lang/editor/callee.hpp"

namespace sdlc::lang {
namespace {

using Role = OpenBracket::Role;
using Units = ExpectedType::Units;

constexpr ExpectedType kCondition{.type = "bool", .is_condition = true};

ExpectedType of_property(const Property& property) {
  Units units = Units::None;
  if (property.type == Type::Length || property.type == Type::Vec3) units = Units::Length;
  if (property.type == Type::Interval) units = Units::Time;
  return {.type = type_name_of(property.type), .property = &property, .units = units};
}

ExpectedType of_property_of_block(const SceneView& view, std::uint32_t file, std::string_view kind,
                                  std::string_view label) {
  const BlockKind block = find_block_kind(view, file, kind);
  for (const BlockProperty& property : properties_of(view, block)) {
    if (property.name != label) continue;
    if (property.property != nullptr) return of_property(*property.property);
    return {.type = type_name_of(view, property.parameter)};
  }
  return {};
}

ExpectedType of_statement(const OpenBracket& f) {
  if (f.word == "param") return {.type = f.type};
  if (f.word == "if") return kCondition;
  if (f.word == "for") return {.type = "list"};
  if (f.word == "assert") return f.commas == 0 ? kCondition : ExpectedType{.type = "string"};
  return {};
}

/// The index of an argument among the parameters with these names; their number if it is none.
template <typename Names>
std::size_t index_of_argument(const OpenBracket& call, const Names& names) {
  if (call.label.empty()) return std::min<std::size_t>(call.commas, names.size());
  return static_cast<std::size_t>(std::ranges::find(names, call.label) - names.begin());
}

/// The option that the argument gives; null if it gives none.
const Property* option_at(const OpenBracket& call, const Builtin& function) {
  const auto& options = function.options;
  if (!call.label.empty()) {
    const auto found = std::ranges::find(options, call.label, &Property::name);
    return found == options.end() ? nullptr : &*found;
  }
  const std::size_t index = call.commas - function.max_arguments;
  return call.commas >= function.max_arguments && index < options.size() ? &options[index]
                                                                         : nullptr;
}

ExpectedType of_argument(const SceneView& view, std::uint32_t file, const CursorPlace& place,
                         std::size_t bracket) {
  const OpenBracket& call = place.brackets[bracket];
  const Callee callee = find_callee(view, file, view.file(file).text(call.head));
  std::vector<std::string_view> names;
  if (callee.constructor != nullptr) {
    for (const Property& p : callee.constructor->parameters) names.push_back(p.name);
    const std::size_t index = index_of_argument(call, names);
    return index < names.size() ? of_property(callee.constructor->parameters[index])
                                : ExpectedType();
  }
  if (callee.builtin != nullptr) {
    if (const Property* option = option_at(call, *callee.builtin)) return of_property(*option);
    if (callee.builtin->result == "=") {
      ExpectedType around = expected_in(view, file, place, bracket - 1);
      around.property = nullptr;
      if (callee.builtin->takes.empty() || around.type == "angle") return around;
    }
    return {.type = callee.builtin->takes};
  }
  const std::vector<SymbolId> parameters = parameters_of(view, callee.function);
  for (const SymbolId id : parameters) names.push_back(view.index().find(id)->name);
  const std::size_t index = index_of_argument(call, names);
  return index < names.size() ? ExpectedType{.type = type_name_of(view, parameters[index])}
                              : ExpectedType();
}

/// A component of what is expected around the parentheses, or the same.
ExpectedType of_component(ExpectedType around, const OpenBracket& parenthesis) {
  around.property = nullptr;
  if (around.type == "vec3") return {.type = "number", .units = around.units};
  if (around.type == "angles") return {.type = "angle", .units = Units::None};
  if (parenthesis.commas > 0 || around.is_unknown()) return {.type = "number"};
  return around;
}

}  // namespace

ExpectedType expected_in(const SceneView& view, std::uint32_t file, const CursorPlace& place,
                         std::size_t bracket) {
  const OpenBracket& f = place.brackets[bracket];
  if (!f.conditionals.empty() && f.conditionals.back() == ConditionalPart::Condition) {
    return kCondition;
  }
  switch (f.role) {
    case Role::File: return f.label.empty() ? of_statement(f) : ExpectedType();
    case Role::Block:
      return f.label.empty()
                 ? of_statement(f)
                 : of_property_of_block(view, file, view.file(file).text(f.head), f.label);
    case Role::Arguments: return of_argument(view, file, place, bracket);
    case Role::Parameters:
      return f.locals.empty() ? ExpectedType() : ExpectedType{.type = f.locals.back().type};
    case Role::Parenthesis: return of_component(expected_in(view, file, place, bracket - 1), f);
    case Role::List: return of_statement(f);
    case Role::Index: return {.type = "number", .units = Units::None};
  }
  return {};
}

ExpectedType expected_at(const SceneView& view, std::uint32_t file, const CursorPlace& place) {
  const std::string_view before = place.before;
  if (before == "and" || before == "or" || before == "not") return kCondition;
  const bool is_compared = before == "==" || before == "!=" || before == "<" || before == "<=" ||
                           before == ">" || before == ">=";
  if (is_compared) return {.type = "number"};
  ExpectedType expected = expected_in(view, file, place, place.brackets.size() - 1);
  if (before == "..") return {.type = "number", .units = expected.units};
  if (before == "^") return {.type = "number", .units = Units::None};
  const bool is_operand =
      before == "+" || before == "-" || before == "*" || before == "/" || before == "^";
  if (is_operand) expected.property = nullptr;
  // A sum may also be of strings.
  if (is_operand && before != "+" && expected.is_unknown()) return {.type = "number"};
  return expected;
}

}  // namespace sdlc::lang
