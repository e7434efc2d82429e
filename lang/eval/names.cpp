#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/eval/colors.hpp"
#include "lang/eval/evaluator.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/nearest_name.hpp"

// What names mean: values, and functions that the file declares.
namespace sdlc::lang {
namespace {

constexpr double kPi = 3.141592653589793;

/// A name of a type as `param` and parameters write it, and the values it stands for.
struct TypeName {
  std::string_view name;
  bool (*holds)(const Computed& value);
};

template <typename T>
bool is(const Computed& value) {
  return std::holds_alternative<T>(value);
}

constexpr auto kTypeNames = std::to_array<TypeName>({
    {"number", is<Scalar>},
    {"bool", is<bool>},
    {"string", is<std::string>},
    {"vec3", is<Triple>},
    {"angles", is<AngleTriple>},
    {"angle", is<Angle>},
    {"color", is<render::LinearRgb>},
    {"interval", is<Bounds>},
    {"list", is<ListValue>},
    {"material", is<MaterialValue>},
});

std::optional<std::string_view> nearest_value(const Scopes& scopes, std::string_view name) {
  // The file's own names first: among equals they are the likelier ones.
  std::vector<std::string_view> candidates = scopes.names();
  for (const NamedColor& color : named_colors()) candidates.push_back(color.name);
  candidates.insert(candidates.end(), {"pi", "time"});
  return nearest_name(name, candidates);
}

/// The expression of a fn statement.
std::optional<ast::Node> body_of(ast::Node function) {
  std::optional<ast::Node> body;
  for (const ast::Node child : function.children()) {
    if (!child.is(SyntaxKind::Name) && !child.is(SyntaxKind::Parameter)) body = child;
  }
  return body;
}

std::vector<ast::Node> parameters_of(ast::Node function) {
  std::vector<ast::Node> parameters;
  for (const ast::Node child : function.children()) {
    if (child.is(SyntaxKind::Parameter)) parameters.push_back(child);
  }
  return parameters;
}

std::optional<ast::Node> default_of(ast::Node parameter) {
  for (const ast::Node child : parameter.children()) {
    if (!child.is(SyntaxKind::TypeName)) return child;
  }
  return std::nullopt;
}

}  // namespace

Computed ExpressionEvaluator::evaluate_reference(ast::Node node) {
  const std::string_view path = node.text();
  const std::string_view name = first_name(path);
  const Location where = node.tree().location(
      {node.span().begin, node.span().begin + static_cast<std::uint32_t>(name.size())});
  if (names_.values.contains(name)) return Failed{};  // reported where it is imported
  if (const Computed* found = scopes_.find(name)) {
    Computed value = *found;
    std::size_t dot = path.find('.');
    while (dot != std::string_view::npos) {
      const std::size_t next = path.find('.', dot + 1);
      value =
          evaluate_member(value, name_behind_dot(path.substr(dot, next - dot)), node.location());
      dot = next;
    }
    return value;
  }

  const bool is_path = name.size() != path.size();
  if (!is_path) {
    if (const auto color = find_named_color(name)) return *color;
    if (name == "pi") return Scalar{kPi};
    if (name == "time") return not_supported(node, "`time` is");
  }
  const bool is_function = declarations_.function(name) || find_function(name) != nullptr ||
                           find_builtin(name) != nullptr || is_later_function(name);
  if (is_function) {
    sink_.report(diag::function_as_value, node.location(), name)
        .help(fmt::format("call it: `{}(…)`", name));
    return Failed{};
  }
  sink_.report(diag::unknown_name, where, name).suggest(nearest_value(scopes_, name));
  return Failed{};
}

bool ExpressionEvaluator::take_step(Location where) {
  if (steps_ < kMaxSteps) {
    ++steps_;
    return true;
  }
  if (steps_ == kMaxSteps) sink_.report(diag::too_many_steps, where, kMaxSteps);
  steps_ = kMaxSteps + 1;
  return false;
}

Computed ExpressionEvaluator::check_declared_type(std::string_view name,
                                                  std::optional<ast::Node> type, Computed value,
                                                  Location where) {
  if (!type) return value;
  const auto found = std::find_if(kTypeNames.begin(), kTypeNames.end(),
                                  [&](const TypeName& t) { return t.name == type->text(); });
  if (found == kTypeNames.end()) {
    std::vector<std::string_view> names;
    for (const TypeName& known : kTypeNames) names.push_back(known.name);
    sink_.report(diag::unknown_type, type->location(), type->text())
        .suggest(nearest_name(type->text(), names));
    return value;
  }
  if (has_failed(value) || found->holds(value)) return value;
  sink_.report(diag::declared_type, where, name, found->name, describe(value))
      .label(type->location(), "declared here");
  return Failed{};
}

Computed ExpressionEvaluator::call_declared(ast::Node function, ast::Call call) {
  const std::vector<ast::Node> parameters = parameters_of(function);
  std::vector<std::optional<Computed>> values(parameters.size());
  std::vector<Location> places(parameters.size(), call.callee_location());
  std::size_t positional = 0;
  bool has_labels = false, is_broken = false;
  for (const ast::Node argument : call.arguments()) {
    std::optional<ast::Node> value = argument;
    std::size_t index = parameters.size();
    if (argument.is(SyntaxKind::Argument)) {
      has_labels = true;
      const ast::Labeled labeled{argument};
      value = labeled.value();
      std::vector<std::string_view> names;
      for (const ast::Node parameter : parameters) names.push_back(parameter.head());
      index = static_cast<std::size_t>(std::find(names.begin(), names.end(), labeled.label()) -
                                       names.begin());
      if (index == parameters.size()) {
        sink_
            .report(diag::unknown_argument, labeled.label_location(), labeled.label(),
                    call.callee())
            .suggest(nearest_name(labeled.label(), names));
      }
    } else if (has_labels) {
      sink_.report(diag::positional_behind_named, argument.location());
    } else if (positional < parameters.size()) {
      index = positional++;
    } else {
      sink_.report(diag::too_many_arguments, argument.location(), call.callee(), parameters.size());
    }
    const Computed computed = value ? evaluate(*value) : Computed(Failed{});
    if (index == parameters.size()) {
      is_broken = true;
    } else if (values[index]) {
      sink_.report(diag::duplicate, argument.location(), "argument", parameters[index].head());
      is_broken = true;
    } else {
      values[index] = computed;
      places[index] = argument.location();
    }
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (values[i] || default_of(parameters[i]) || is_broken) continue;
    sink_.report(diag::missing, call.callee_location(), fmt::format("`{}`", call.callee()),
                 parameters[i].head());
    is_broken = true;
  }
  const std::optional<ast::Node> body = body_of(function);
  if (is_broken || !body || !take_step(call.callee_location())) return Failed{};
  if (calls_ == kMaxCalls) {
    sink_.report(diag::too_deep, call.callee_location(), kMaxCalls);
    return Failed{};
  }

  ++calls_;
  Computed result;
  {
    const CallScope scope(scopes_);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      // A default may use the parameters before it.
      Computed value = values[i] ? std::move(*values[i]) : evaluate(*default_of(parameters[i]));
      scopes_.declare(
          parameters[i].head(),
          check_declared_type(parameters[i].head(), parameters[i].first(SyntaxKind::TypeName),
                              std::move(value), places[i]));
    }
    result = evaluate(*body);
  }
  --calls_;
  return result;
}

}  // namespace sdlc::lang
