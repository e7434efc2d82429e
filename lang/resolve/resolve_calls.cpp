#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/resolve/lookup.hpp"
#include "lang/resolve/path.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

std::string arguments(std::size_t count) {
  return fmt::format("{} argument{}", count, count == 1 ? "" : "s");
}

/// The largest number of arguments, options included.
std::size_t max_positional(const Builtin& builtin) {
  const bool is_any = builtin.max_arguments == kAnyNumber;
  return is_any ? kAnyNumber : builtin.max_arguments + builtin.options.size();
}

std::string accepted_arguments(const Builtin& builtin) {
  const std::size_t min = builtin.min_arguments, max = max_positional(builtin);
  if (min == max) return arguments(min);
  if (max == kAnyNumber) return "at least " + arguments(min);
  return fmt::format("{} to {}", min, arguments(max));
}

// A parameter of a constructor is a Property, that of a function a Parameter.

bool may_be_color(const Property& argument) { return argument.type == Type::Color; }
bool may_be_color(const Parameter& parameter) {
  return parameter.type == nullptr || parameter.type->name == "color";
}
const Property* property_of(const Property& parameter) { return &parameter; }
const Property* property_of(const Parameter& /*parameter*/) { return nullptr; }
bool is_required(const Property& parameter) { return parameter.presence == Presence::Required; }
bool is_required(const Parameter& parameter) { return !parameter.has_default; }

template <typename T>
std::size_t index_of_name(std::span<const T> parameters, std::string_view name) {
  std::size_t index = 0;
  while (index < parameters.size() && parameters[index].name != name) ++index;
  return index;
}

bool has_argument(ast::Call call, std::string_view label) {
  for (const ast::Node argument : call.arguments()) {
    if (argument.is(SyntaxKind::Argument) && argument.head() == label) return true;
  }
  return false;
}

bool is_color(ast::Node value) {
  if (value.is(SyntaxKind::Color)) return true;
  return value.is(SyntaxKind::Reference) && find_named_color(value.text()).has_value();
}

/// Whether a call of a material without labels has its colour and its number in the wrong order.
bool swaps_color(ast::Call call, std::span<const Property> parameters) {
  std::size_t index = 0;
  bool has_number = false, has_color = false;
  for (const ast::Node argument : call.arguments()) {
    if (index == parameters.size() || argument.is(SyntaxKind::Argument)) break;
    const Type type = parameters[index++].type;
    has_number = has_number || (type == Type::Color && argument.is(SyntaxKind::Number));
    has_color = has_color || (type == Type::Number && is_color(argument));
  }
  return has_number && has_color;
}

}  // namespace

std::uint32_t Resolver::call(ast::Call call) {
  const std::string_view callee = call.callee();
  if (callee.find('.') != std::string_view::npos) return imported_call(call);
  if (const Definition* local = find_local(NameSpace::Functions, callee)) {
    if (is_recording()) recorder_->use_own(callee, local->node);
    use_definition(*local);
    const std::span<const Parameter> parameters = local->parameters;
    return call_of(Op::LocalFunction, local_callee(*local), parameters, call, local);
  }
  if (const auto own = find_declaration(module_, NameSpace::Functions, callee)) {
    if (is_recording()) recorder_->use_own(callee, own->node);
    uses_.functions.push_back(own->index);
    return function_call(index_, own->index, call);
  }
  const Constructor* constructor = find_constructor(callee);
  const Builtin* builtin = constructor == nullptr ? find_builtin(callee) : nullptr;
  if (constructor == nullptr && builtin == nullptr) return unknown_function(call);
  if (is_recording()) recorder_->use_builtin(callee, SymbolKind::BuiltinFunction);
  return builtin != nullptr ? builtin_call(*builtin, call) : constructor_call(*constructor, call);
}

std::uint32_t Resolver::imported_call(ast::Call call) {
  const auto names = split_path(call.callee());
  const Import* import = find_in(module_.imports, names[0]);
  if (import == nullptr) {
    record_path(names);
    if (!is_recording()) unknown_.report_imported_function(call, names, std::nullopt);
    return operands_of(call.node, Op::Broken);
  }
  if (const auto function = imported_declaration(*import, NameSpace::Functions, names)) {
    const Module& module = modules_.module_at(import->module);
    uses_.time = uses_.time || module.functions[function->index].uses_time;
    return function_call(import->module, function->index, call);
  }
  const bool is_loaded = import->module != kNothing;  // if not, that is reported at the import
  if (is_loaded && !is_recording()) unknown_.report_imported_function(call, names, import->module);
  return operands_of(call.node, Op::Broken);
}

std::uint32_t Resolver::unknown_function(ast::Call call) {
  if (is_recording()) {
    recorder_->use_unknown(call.callee(), NameSpace::Functions);
    return operands_of(call.node, Op::Broken);
  }
  // The arguments of an intended constructor may be words.
  const auto nearest = unknown_.report_function(call);
  const Constructor* intended = nearest ? find_constructor(*nearest) : nullptr;
  if (intended == nullptr) return operands_of(call.node, Op::Broken);
  const Guess guess(*this);
  return constructor_call(*intended, call);
}

std::uint32_t Resolver::constructor_call(const Constructor& constructor, ast::Call call) {
  const auto index = static_cast<std::uint32_t>(constructor.index());
  return call_of(Op::Constructor, std::span(&index, 1), constructor.parameters, call);
}

std::uint32_t Resolver::function_call(std::uint32_t module, std::uint32_t function,
                                      ast::Call call) {
  const std::array<std::uint32_t, 2> callee{module, function};
  const Definition& definition = modules_.module_at(module).functions[function];
  const std::span<const Parameter> parameters = definition.parameters;
  return call_of(Op::Function, callee, parameters, call, &definition);
}

/// The arguments of a call of a built-in function while they are read.
struct Resolver::BuiltinArguments {
  const Builtin& builtin;
  std::array<std::uint32_t, kMaxOptions> options;  ///< kNothing: not given
  std::size_t count = 0;                           ///< positional arguments
  bool has_labels = false, is_good = true;
};

std::uint32_t Resolver::builtin_call(const Builtin& builtin, ast::Call call) {
  const std::size_t mark = code_.mark();
  code_.push(static_cast<std::uint32_t>(builtin.index()));
  BuiltinArguments arguments{.builtin = builtin, .options = {}};
  arguments.options.fill(kNothing);
  for (const ast::Node argument : call.arguments()) builtin_argument(arguments, argument);
  bool is_good = arguments.is_good;
  if (is_good &&
      (arguments.count < builtin.min_arguments || arguments.count > max_positional(builtin))) {
    sink_
        .report(diag::wrong_argument_count, call.callee_location(), builtin.name,
                accepted_arguments(builtin), arguments.count)
        .help(fmt::format("write `{}`", builtin.signature));
    is_good = false;
  }
  for (std::size_t i = 0; i < builtin.options.size(); ++i) {
    if (is_good || arguments.options[i] != kNothing) code_.push(arguments.options[i]);
  }
  if (is_good) return code_.add_with(Op::Builtin, call.node, mark);
  code_.remove(mark, mark + 1);
  return code_.add_with(Op::Broken, call.node, mark);
}

void Resolver::builtin_argument(BuiltinArguments& arguments, ast::Node argument) {
  const Builtin& builtin = arguments.builtin;
  if (argument.is(SyntaxKind::Argument)) return builtin_option(arguments, {argument});
  if (arguments.has_labels && arguments.is_good) {
    sink_.report(diag::positional_behind_named, argument.location());
    arguments.is_good = false;
  }
  arguments.is_good = arguments.is_good && !argument.is(SyntaxKind::Error);
  const std::size_t option = arguments.count++ - builtin.max_arguments;
  if (arguments.count > builtin.max_arguments && option < builtin.options.size()) {
    arguments.options[option] = expression(argument, &builtin.options[option]);
  } else {
    code_.push(expression(argument));
  }
}

void Resolver::builtin_option(BuiltinArguments& arguments, ast::Labeled argument) {
  const Builtin& builtin = arguments.builtin;
  arguments.has_labels = true;
  std::size_t index = index_of_name(builtin.options, argument.label());
  if (index == builtin.options.size()) {
    arguments.is_good = false;
    index = unknown_option(arguments, argument);
  } else if (is_recording()) {
    recorder_->use_builtin(argument.label(), SymbolKind::Property, &builtin.options[index]);
  }
  const auto value = argument.value();
  const bool is_known = index != builtin.options.size();
  const bool is_placed = is_known && arguments.options[index] == kNothing;
  if (is_known && !is_placed) {
    const Expression& earlier = code_.code().expressions[arguments.options[index]];
    sink_.report(diag::duplicate, argument.label_location(), "argument", argument.label())
        .label(ast::Node(module_.tree, earlier.node).location(), "first given here");
    arguments.is_good = false;
  }
  const Property* property = is_known ? &builtin.options[index] : nullptr;
  const std::uint32_t operand =
      value ? expression(*value, property) : code_.add_broken(argument.node);
  if (is_placed) {
    arguments.options[index] = operand;
  } else {
    code_.push(operand);
  }
}

/// The index of the intended option if it is not given yet; the number of options otherwise.
std::size_t Resolver::unknown_option(BuiltinArguments& arguments, ast::Labeled argument) {
  const auto options = arguments.builtin.options;
  if (is_recording()) recorder_->use_unknown(argument.label(), NameSpace::Labels);
  auto report = sink_.report(diag::unknown_argument, argument.label_location(), argument.label(),
                             arguments.builtin.name);
  if (options.empty()) {
    report.help(fmt::format("its arguments have no names: `{}`", arguments.builtin.signature));
    return options.size();
  }
  const auto nearest = intended_name(std::nullopt, argument.label(), names_of(options));
  report.suggest(nearest);
  if (!nearest) report.help(fmt::format("write `{}`", arguments.builtin.signature));
  const std::size_t index = nearest ? index_of_name(options, *nearest) : options.size();
  const bool is_free = index < options.size() && arguments.options[index] == kNothing;
  return is_free ? index : options.size();
}

// Arguments of functions with named parameters

/// A call whose arguments are being bound to parameters. The operand of a parameter is kNothing
/// until then.
template <typename T>
struct Resolver::Binding {
  std::span<const T> parameters;
  ast::Call call;
  const Definition* function;  ///< null for a constructor
  std::uint32_t module;        ///< of the function
  std::size_t first;           ///< operand of the first parameter
  bool is_broken;              ///< arguments or parameters may be missing because of an error
  bool is_good;                ///< the call has no errors
  bool has_labels = false, has_too_many = false;
  std::size_t positional = 0;  ///< arguments without a label

  std::size_t none() const noexcept { return parameters.size(); }
};

template <typename T>
std::uint32_t Resolver::call_of(Op op, std::span<const std::uint32_t> callee,
                                std::span<const T> parameters, ast::Call call,
                                const Definition* function) {
  const std::size_t mark = code_.mark();
  for (const std::uint32_t part : callee) code_.push(part);
  const std::size_t first = code_.mark();
  for (std::size_t i = 0; i < parameters.size(); ++i) code_.push(kNothing);
  const bool is_broken = call.is_broken() || std::exchange(is_guess_, false) ||
                         (function != nullptr && function->is_broken);
  Binding<T> binding{.parameters = parameters,
                     .call = call,
                     .function = function,
                     .module = function != nullptr ? function->module : kNothing,
                     .first = first,
                     .is_broken = is_broken,
                     .is_good = !is_broken};
  if constexpr (std::is_same_v<T, Property>) {
    binding.is_good = binding.is_good && !has_swapped_color(call, parameters);
  }
  for (const ast::Node argument : call.arguments()) bind_argument(binding, argument);
  for (std::size_t i = 0; i < parameters.size() && binding.is_good; ++i) {
    if (code_[first + i] != kNothing || !is_required(parameters[i])) continue;
    sink_.report(diag::missing, call.callee_location(), fmt::format("`{}`", call.callee()),
                 parameters[i].name);
    binding.is_good = false;
  }
  if (binding.is_good) return code_.add_with(op, call.node, mark);
  code_.remove_nothing(first);
  code_.remove(mark, first);
  return code_.add_with(Op::Broken, call.node, mark);
}

bool Resolver::has_swapped_color(ast::Call call, std::span<const Property> parameters) {
  if (!swaps_color(call, parameters)) return false;
  sink_
      .report(diag::wrong_argument, (*call.arguments().begin()).location(), call.callee(),
              "a colour", "a number")
      .help(fmt::format("its arguments are `{}({})`", call.callee(),
                        fmt::join(names_of(parameters), ", ")));
  return true;
}

template <typename T>
void Resolver::bind_argument(Binding<T>& binding, ast::Node argument) {
  if (argument.is(SyntaxKind::Error)) {
    record_skipped(argument);
    binding.is_good = false;
    return;
  }
  const bool is_labeled = argument.is(SyntaxKind::Argument);
  const std::size_t index =
      is_labeled ? labeled_argument(binding, {argument}) : positional_argument(binding, argument);
  const auto value = is_labeled ? ast::Labeled{argument}.value() : std::optional(argument);
  if (is_labeled) record_rest(argument, value);
  const bool is_known = index != binding.none();
  const bool is_placed = is_known && code_[binding.first + index] == kNothing;
  if (is_known && !is_placed) {
    const Location where = is_labeled ? argument.head_location() : argument.location();
    const Expression& earlier = code_.code().expressions[code_[binding.first + index]];
    sink_.report(diag::duplicate, where, "argument", binding.parameters[index].name)
        .label(ast::Node(module_.tree, earlier.node).location(), "first given here");
  }
  const Property* property = is_placed ? property_of(binding.parameters[index]) : nullptr;
  const bool excludes_color = is_placed && !may_be_color(binding.parameters[index]);
  if (value && excludes_color) no_color_ = value->span();
  const std::uint32_t operand = value ? expression(*value, property) : code_.add_broken(argument);
  if (is_placed) {
    code_[binding.first + index] = operand;
  } else {
    code_.push(operand);
    binding.is_good = false;
  }
}

/// The index of the parameter with this label; for an unknown label that of the intended parameter,
/// unless it has another argument; otherwise none().
template <typename T>
std::size_t Resolver::labeled_argument(Binding<T>& binding, ast::Labeled argument) {
  binding.has_labels = true;
  const std::string_view label = argument.label();
  const std::size_t index = index_of_name(binding.parameters, label);
  if (is_recording()) record_argument(binding, label, index);
  if (index != binding.none() || is_recording()) return index;

  const bool is_excused = binding.function != nullptr &&
                          (binding.function->is_broken ||
                           (binding.module == index_ &&
                            unknown_.is_excused(index_, label, argument.node.span().begin)));
  const auto habit =
      binding.function != nullptr ? std::nullopt : find_habit(HabitPlace::Argument, label);
  const auto nearest = intended_name(habit, label, names_of(binding.parameters));
  if (!is_excused && (nearest || !binding.is_broken)) {
    sink_.report(diag::unknown_argument, argument.label_location(), label, binding.call.callee())
        .suggest(nearest);
  }
  if (!nearest || has_argument(binding.call, *nearest)) return binding.none();
  const std::size_t intended = index_of_name(binding.parameters, *nearest);
  const bool is_free = code_[binding.first + intended] == kNothing;
  return is_free ? intended : binding.none();
}

template <typename T>
std::size_t Resolver::positional_argument(Binding<T>& binding, ast::Node argument) {
  if (binding.has_labels) {
    if (!binding.is_broken) sink_.report(diag::positional_behind_named, argument.location());
    return binding.none();
  }
  if (binding.positional < binding.none()) return binding.positional++;
  if (!binding.is_broken && !std::exchange(binding.has_too_many, true)) {
    sink_.report(diag::too_many_arguments, argument.location(), binding.call.callee(),
                 arguments(binding.none()));
  }
  return binding.none();
}

template <typename T>
void Resolver::record_argument(const Binding<T>& binding, std::string_view label,
                               std::size_t index) {
  const bool is_known = index != binding.none();
  if constexpr (std::is_same_v<T, Property>) {
    if (is_known) {
      recorder_->use_builtin(label, SymbolKind::Property, &binding.parameters[index]);
    } else {
      recorder_->use_unknown(label, NameSpace::Labels);
    }
  } else {
    if (is_known) {
      recorder_->use(label, {binding.module, binding.parameters[index].node});
    } else {
      recorder_->use_unknown(label, NameSpace::Labels, {binding.module, binding.function->node});
    }
  }
}

}  // namespace sdlc::lang
