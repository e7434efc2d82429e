#include <algorithm>
#include <string>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "lang/program/path.hpp"
#include "lang/program/resolver.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

std::string arguments(std::size_t count) {
  return fmt::format("{} argument{}", count, count == 1 ? "" : "s");
}

constexpr double kPi = 3.141592653589793;

// What binding an argument asks of a parameter, of whatever kind the function is.

std::string_view name_of(const Property& parameter) { return parameter.name; }
std::string_view name_of(const Parameter& parameter) { return parameter.name; }
bool may_be_color(const Property& argument) { return argument.type == Type::Color; }
bool may_be_color(const Parameter& parameter) {
  return parameter.type == nullptr || parameter.type->name == "color";
}

const Property* property_of(const Property& parameter) { return &parameter; }
const Property* property_of(const Parameter& /*parameter*/) { return nullptr; }
bool is_required(const Property& parameter) { return parameter.presence == Presence::Required; }
bool is_required(const Parameter& parameter) { return !parameter.has_default; }

template <typename Parameters>
std::size_t index_of_name(const Parameters& parameters, std::string_view name) {
  std::size_t index = 0;
  while (index < parameters.size() && name_of(parameters[index]) != name) ++index;
  return index;
}

bool has_argument(ast::Call call, std::string_view label) {
  for (const ast::Node argument : call.arguments()) {
    if (argument.is(SyntaxKind::Argument) && argument.head() == label) return true;
  }
  return false;
}

/// What a function or constant of a library elsewhere is called here: `math.PI` is `pi`.
std::string member_of_library(std::string_view path) {
  return lower_case(path.substr(path.rfind('.') + 1));
}

bool is_color(ast::Node value) {
  if (value.is(SyntaxKind::Color)) return true;
  return value.is(SyntaxKind::Reference) && find_named_color(value.text()).has_value();
}

/// Whether a call without labels has the colour and the number of its material in the wrong order.
template <typename Parameters>
bool swaps_color(ast::Call call, const Parameters& parameters) {
  if constexpr (!std::is_same_v<std::remove_cvref_t<decltype(parameters[0])>, Property>) {
    return false;
  } else {
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
}

template <typename Parameters>
std::string signature_of(std::string_view name, const Parameters& parameters) {
  std::vector<std::string_view> names;
  for (const auto& parameter : parameters) names.push_back(name_of(parameter));
  return fmt::format("{}({})", name, fmt::join(names, ", "));
}

bool reads_words(const Property* property) {
  return property != nullptr && (property->type == Type::Word || property->reads_none);
}

}  // namespace

std::uint32_t Resolver::broken(ast::Node node) { return add(Op::Broken, node); }

std::uint32_t Resolver::constant(ast::Node node, Computed value) {
  code_->constants.push_back(std::move(value));
  return add(Op::Constant, node, static_cast<std::uint32_t>(code_->constants.size() - 1));
}

std::uint32_t Resolver::operands_of(ast::Node node, Op op, const Property* property) {
  const std::size_t mark = pending_.size();
  for (const ast::Node child : node.children()) {
    const std::uint32_t operand = expression(child, property);
    code_->expressions[operand].before = child.op();
    pending_.push_back(operand);
  }
  return add_with(op, node, mark);
}

/// `property` is what the value is for, where it may be a bare word (ruling 12).
std::uint32_t Resolver::expression(ast::Node node, const Property* property) {
  switch (node.kind()) {
    case SyntaxKind::Number: return number(node);
    case SyntaxKind::String: {
      Computed text = evaluate_string(node, sink_);
      const auto* value = get_if<std::string>(&text);
      const bool is_good = value == nullptr || check_string_size(value->size(), program_.limits(),
                                                                 node.location(), sink_);
      return is_good ? constant(node, std::move(text)) : broken(node);
    }
    case SyntaxKind::Color: return constant(node, decode_hex_color(node.text()));
    case SyntaxKind::True: return constant(node, true);
    case SyntaxKind::False: return constant(node, false);
    case SyntaxKind::Group: {
      const auto inside = node.child(0);
      return inside ? expression(*inside, property) : broken(node);
    }
    case SyntaxKind::Triple: return operands_of(node, Op::Triple);
    case SyntaxKind::Interval: return operands_of(node, Op::Interval);
    case SyntaxKind::Sum: return operands_of(node, Op::Sum);
    case SyntaxKind::Product: return operands_of(node, Op::Product);
    case SyntaxKind::Power: return operands_of(node, Op::Power);
    case SyntaxKind::Negative: return operands_of(node, Op::Negative);
    case SyntaxKind::Not: return operands_of(node, Op::Not);
    case SyntaxKind::Or: return operands_of(node, Op::Or);
    case SyntaxKind::And: return operands_of(node, Op::And);
    case SyntaxKind::Comparison: return operands_of(node, Op::Comparison);
    case SyntaxKind::List: return operands_of(node, Op::List);
    case SyntaxKind::Conditional: return conditional(node, property);
    case SyntaxKind::Postfix: return postfix(node);
    case SyntaxKind::Reference: return reference(node, property);
    case SyntaxKind::Call: return call({node});
    default: return operands_of(node, Op::Broken);  // what could not be read
  }
}

std::uint32_t Resolver::number(ast::Node node) {
  const Computed value = evaluate_number(node, sink_);
  const auto* scalar = get_if<Scalar>(&value);
  if (scalar == nullptr) return constant(node, value);
  code_->numbers.push_back(scalar->value);
  return add(Op::Number, node, static_cast<std::uint32_t>(code_->numbers.size() - 1), 0,
             static_cast<std::uint8_t>(scalar->unit));
}

std::uint32_t Resolver::conditional(ast::Node node, const Property* property) {
  // Condition, value, condition, value, …; the last value has no condition.
  const std::size_t mark = pending_.size();
  const ast::Children children = node.children();
  for (auto child = children.begin(); child != children.end();) {
    const ast::Node part = *child;
    ++child;
    const bool is_value = (pending_.size() - mark) % 2 == 1 || child == children.end();
    const std::uint32_t operand = expression(part, is_value ? property : nullptr);
    pending_.push_back(operand);
  }
  return add_with(Op::Conditional, node, mark);
}

std::uint32_t Resolver::member(std::uint32_t operand, std::string_view name, ast::Node node) {
  const bool is_axis = name == "x" || name == "y" || name == "z";
  const std::size_t mark = pending_.size();
  pending_.push_back(operand);
  return add_with(Op::Member, node, mark, is_axis ? static_cast<std::uint8_t>(name[0]) : 0);
}

std::uint32_t Resolver::postfix(ast::Node node) {
  std::uint32_t value = kNothing;
  for (const ast::Node part : node.children()) {
    if (value == kNothing) {
      value = expression(part);
    } else if (part.is(SyntaxKind::Member)) {
      const auto names = split_path(part.text());
      value = names.empty() ? broken(part) : member(value, names[0], part);
    } else if (part.is(SyntaxKind::Index)) {
      const auto position = part.child(0);
      const std::uint32_t index = position ? expression(*position) : broken(part);
      const std::size_t mark = pending_.size();
      pending_.insert(pending_.end(), {value, index});
      value = add_with(Op::Index, part, mark);
    } else {
      return broken(part);
    }
  }
  return value == kNothing ? broken(node) : value;
}

// Names of values

std::uint32_t Resolver::reference(ast::Node node, const Property* property) {
  const std::string_view path = node.text();
  const bool is_path = path.find('.') != std::string_view::npos;
  if (!is_path && reads_words(property)) {
    if (property->reads_none && path == "none") return constant(node, None{});
    if (property->type == Type::Word) return constant(node, Word{std::string(path)});
  }
  std::vector<std::string_view> split;
  if (is_path) split = split_path(path);
  const auto names = is_path ? std::span<const std::string_view>(split) : std::span(&path, 1);

  std::uint32_t value = kNothing;
  std::size_t used = 1;
  const auto global = [&](std::uint32_t module, std::uint32_t index) {
    const std::size_t mark = pending_.size();
    pending_.insert(pending_.end(), {module, index});
    return add_with(Op::Global, node, mark);
  };
  if (const Local* local = find_local(names[0])) {
    value = add(Op::Local, node, local->slot);
  } else if (const auto own = module_.global_names.find(names[0]);
             own != module_.global_names.end()) {
    uses_.globals.push_back(own->second);
    value = global(index_, own->second);
  } else if (const auto import = find_import(names[0])) {
    if (*import == kNothing) return broken(node);  // reported where it is imported
    const Module& module = program_.module(*import);
    const auto found =
        names.size() > 1 ? module.global_names.find(names[1]) : module.global_names.end();
    if (found == module.global_names.end()) return unknown_import(node, names, *import);
    uses_.time = uses_.time || module.globals[found->second].uses_time;
    value = global(*import, found->second);
    used = 2;
  } else if (const auto color = find_named_color(names[0])) {
    value = constant(node, *color);
  } else if (names[0] == "pi") {
    code_->numbers.push_back(kPi);
    value = add(Op::Number, node, static_cast<std::uint32_t>(code_->numbers.size() - 1));
  } else if (names[0] == "time") {
    uses_.time = true;
    value = add(Op::Time, node);
  } else {
    return unknown_name(node, names[0]);
  }
  for (; used < names.size(); ++used) value = member(value, names[used], node);
  return value;
}

bool Resolver::names_object(std::string_view name) const {
  for (NodeIndex i = 0; i < module_.tree.nodes().size(); ++i) {
    const ast::Node node(module_.tree, i);
    if (!node.is(SyntaxKind::Object)) continue;
    const auto label = node.first(SyntaxKind::Name);
    if (label && label->text() == name) return true;
  }
  return false;
}

std::uint32_t Resolver::unknown_import(ast::Node node, std::span<const std::string_view> names,
                                       std::uint32_t module_index) {
  const Module& module = program_.module(module_index);
  std::vector<std::string_view> known;
  for (const Global& global : module.globals) known.push_back(global.name);
  if (names.size() == 1) {
    auto report = sink_.report(diag::import_as_value, node.location(), names[0]);
    if (!known.empty()) report.help(fmt::format("name what is in it: `{}.{}`", names[0], known[0]));
    return broken(node);
  }
  if (module.function_names.contains(names[1])) {
    sink_.report(diag::function_as_value, node.location(), node.text())
        .help(fmt::format("call it: `{}(…)`", node.text()));
    return broken(node);
  }
  if (is_excused(module_index, names[1], node.span().begin)) return broken(node);
  auto report = sink_.report(diag::unknown_name, node.location(), node.text());
  if (!report.is_kept()) return broken(node);
  if (const auto nearest = nearest_name(names[1], known)) {
    const Global& global = module.globals[module.global_names.at(*nearest)];
    report.suggest(fmt::format("{}.{}", names[0], *nearest));
    label_declared(report, {module.tree, global.node});
  }
  return broken(node);
}

std::uint32_t Resolver::unknown_name(ast::Node node, std::string_view name) {
  const bool is_function = module_.function_names.contains(name) ||
                           find_constructor(name) != nullptr || find_builtin(name) != nullptr;
  if (is_function) {
    sink_.report(diag::function_as_value, node.location(), name)
        .help(fmt::format("call it: `{}(…)`", name));
    return broken(node);
  }
  if (is_excused(index_, name, node.span().begin)) return broken(node);
  const Location where = node.tree().location(
      {node.span().begin, node.span().begin + static_cast<std::uint32_t>(name.size())});
  const std::string_view path = node.text();
  if (find_habit(HabitPlace::Library, name) && path.size() > name.size()) {
    sink_.report(diag::unknown_name, node.location(), path)
        .help(fmt::format("there are no libraries; write `{}`", member_of_library(path)));
    return broken(node);
  }
  auto report = sink_.report(diag::unknown_name, where, name);
  if (!report.is_kept() || !may_suggest(module_.globals.size())) return broken(node);
  if (names_object(name)) {
    report.help(
        fmt::format("`{}` names an object; what several share gets its name by `let`", name));
    return broken(node);
  }
  // Among equals the likelier ones first: what nothing uses, then the file's other names.
  std::vector<std::string_view> known;
  const Misspelling* misspelling = find_misspelling(node.span().begin);
  if (misspelling != nullptr) known.push_back(misspelling->name);
  for (const Local& local : locals_) known.push_back(local.name);
  for (const Global& global : module_.globals) {
    if (global.name != declaring_) known.push_back(global.name);
  }
  for (const auto& [import, module] : module_.imports) known.push_back(import);
  for (const NamedColor& color : named_colors()) known.push_back(color.name);
  known.insert(known.end(), {"pi", "time", "true", "false"});
  const auto habit = find_habit(HabitPlace::Name, name);
  auto nearest = meant_name(habit, name, known);
  const auto is_declared = [&] {
    return find_local(*nearest) != nullptr || module_.global_names.contains(*nearest);
  };
  const bool is_color = nearest && find_named_color(*nearest) && !is_declared();
  if (is_color && node.span() == no_color_) nearest = std::nullopt;
  report.suggest(nearest);
  if (habit) report.help_if(habit->help);
  if (is_color_without_sign(name)) report.help(fmt::format("a colour is `#{}`", name));
  label_unused(report, node.span().begin, nearest);
  return broken(node);
}

// Calls

std::uint32_t Resolver::call(ast::Call call) {
  const std::string_view callee = call.callee();
  if (callee.find('.') == std::string_view::npos) {
    if (const auto own = module_.function_names.find(callee); own != module_.function_names.end()) {
      uses_.functions.push_back(own->second);
      return function_call(index_, own->second, call);
    }
    if (const Constructor* constructor = find_constructor(callee)) {
      const std::uint32_t index = static_cast<std::uint32_t>(constructor->index());
      return call_of(Op::Constructor, std::span(&index, 1), constructor->parameters, call);
    }
    if (const Builtin* builtin = find_builtin(callee)) return builtin_call(*builtin, call);
    return unknown_function(call);
  }

  const auto names = split_path(callee);
  const auto import = find_import(names[0]);
  if (import && *import == kNothing) return operands_of(call.node, Op::Broken);
  if (import && names.size() == 2) {
    const Module& module = program_.module(*import);
    const auto found = module.function_names.find(names[1]);
    if (found != module.function_names.end()) {
      uses_.time = uses_.time || module.functions[found->second].uses_time;
      return function_call(*import, found->second, call);
    }
  }
  return unknown_imported_function(call, names, import);
}

std::uint32_t Resolver::unknown_function(ast::Call call) {
  const std::string_view callee = call.callee();
  if (is_excused(index_, callee, call.node.span().begin)) {
    return operands_of(call.node, Op::Broken);
  }
  if (!may_suggest(module_.functions.size())) {
    sink_.report(diag::unknown_function, call.callee_location(), callee);
    return operands_of(call.node, Op::Broken);
  }
  std::vector<std::string_view> known;
  for (const Definition& function : module_.functions) known.push_back(function.name);
  for (const Constructor& constructor : all_constructors()) known.push_back(constructor.name);
  for (const Builtin& builtin : all_builtins()) known.push_back(builtin.name);
  const auto habit = find_habit(HabitPlace::Callee, callee);
  const auto nearest = meant_name(habit, callee, known);
  auto report =
      sink_.report(diag::unknown_function, call.callee_location(), callee).suggest(nearest);
  if (habit) report.help_if(habit->help);
  label_unused(report, call.node.span().begin, nearest);
  if (find_local(callee) != nullptr || module_.global_names.contains(callee)) {
    report.help(fmt::format("`{0}` is a value; an element of a list is `{0}[0]`", callee));
  } else if (module_.def_names.contains(callee)) {
    report.help(fmt::format("`{}` is a kind of object; write `{} {{ … }}`", callee, callee));
  }
  // The arguments of what was probably meant may be words.
  const Constructor* meant = nearest ? find_constructor(*nearest) : nullptr;
  if (meant == nullptr) return operands_of(call.node, Op::Broken);
  const Guess guess(*this);
  const auto index = static_cast<std::uint32_t>(meant->index());
  return call_of(Op::Constructor, std::span(&index, 1), meant->parameters, call);
}

std::uint32_t Resolver::unknown_imported_function(ast::Call call,
                                                  std::span<const std::string_view> names,
                                                  std::optional<std::uint32_t> import) {
  const bool is_own = !import;
  const std::string_view name = is_own ? names.front() : names.back();
  if (is_excused(is_own ? index_ : *import, name, call.node.span().begin)) {
    return operands_of(call.node, Op::Broken);
  }
  auto report = sink_.report(diag::unknown_function, call.callee_location(), call.callee());
  if (is_own && find_habit(HabitPlace::Library, names.front())) {
    report.help(
        fmt::format("there are no libraries; write `{}(…)`", member_of_library(call.callee())));
    return operands_of(call.node, Op::Broken);
  }
  if (is_own) {
    report.suggest(nearest_import(names));
    return operands_of(call.node, Op::Broken);
  }
  std::vector<std::string_view> known;
  for (const Definition& function : program_.module(*import).functions) {
    known.push_back(function.name);
  }
  const auto nearest = report.is_kept() ? nearest_name(name, known) : std::nullopt;
  if (nearest) {
    const Module& module = program_.module(*import);
    const Definition& function = module.functions[module.function_names.at(*nearest)];
    report.suggest(fmt::format("{}.{}", names[0], *nearest));
    label_declared(report, {module.tree, function.node});
  }
  return operands_of(call.node, Op::Broken);
}

std::uint32_t Resolver::function_call(std::uint32_t module, std::uint32_t function,
                                      ast::Call call) {
  const std::array<std::uint32_t, 2> callee{module, function};
  const std::span<const Parameter> parameters =
      program_.module(module).functions[function].parameters;
  return call_of(Op::Function, callee, parameters, call);
}

std::uint32_t Resolver::builtin_call(const Builtin& builtin, ast::Call call) {
  const std::size_t mark = pending_.size();
  pending_.push_back(static_cast<std::uint32_t>(builtin.index()));
  bool is_good = true;
  for (const ast::Node argument : call.arguments()) {
    std::optional<ast::Node> value = argument;
    if (argument.is(SyntaxKind::Argument)) {
      const ast::Labeled labeled{argument};
      sink_.report(diag::unknown_argument, labeled.label_location(), labeled.label(), builtin.name)
          .help(fmt::format("its arguments have no names: `{}`", builtin.signature));
      value = labeled.value();
      is_good = false;
    }
    is_good = is_good && !argument.is(SyntaxKind::Error);
    const std::uint32_t operand = value ? expression(*value) : broken(argument);
    pending_.push_back(operand);
  }
  const std::size_t count = pending_.size() - mark - 1;
  if (is_good && (count < builtin.least || count > builtin.most)) {
    const std::string_view number = builtin.least == builtin.most ? "" : "at least ";
    sink_
        .report(diag::wrong_argument_count, call.callee_location(), builtin.name,
                fmt::format("{}{}", number, arguments(builtin.least)), count)
        .help(fmt::format("write `{}`", builtin.signature));
    is_good = false;
  }
  if (is_good) return add_with(Op::Builtin, call.node, mark);
  pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(mark));
  return add_with(Op::Broken, call.node, mark);
}

bool Resolver::is_broken_function(Op op, std::span<const std::uint32_t> callee) const {
  return op == Op::Function && program_.module(callee[0]).functions[callee[1]].is_broken;
}

template <typename Parameters>
std::uint32_t Resolver::call_of(Op op, std::span<const std::uint32_t> callee,
                                const Parameters& parameters, ast::Call call) {
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), callee.begin(), callee.end());
  const std::size_t first = pending_.size();
  pending_.resize(first + parameters.size(), kNothing);
  std::size_t positional = 0;
  // Where an argument or a bracket could not be read, the others may not stand where they should.
  const bool is_broken =
      call.is_broken() || std::exchange(is_guess_, false) || is_broken_function(op, callee);
  bool has_labels = false, is_good = !is_broken, has_too_many = false;
  if (is_good && swaps_color(call, parameters)) {
    const ast::Node first_argument = *call.arguments().begin();
    sink_
        .report(diag::wrong_argument, first_argument.location(), call.callee(), "a colour",
                "a number")
        .help(fmt::format("its arguments are `{}`", signature_of(call.callee(), parameters)));
    is_good = false;
  }
  for (const ast::Node argument : call.arguments()) {
    if (argument.is(SyntaxKind::Error)) {
      is_good = false;
      continue;
    }
    std::optional<ast::Node> value = argument;
    std::size_t index = parameters.size();
    Location where = argument.location();
    if (argument.is(SyntaxKind::Argument)) {
      has_labels = true;
      const ast::Labeled labeled{argument};
      where = labeled.label_location();
      value = labeled.value();
      index = index_of_name(parameters, labeled.label());
      if (index == parameters.size()) {
        std::vector<std::string_view> names;
        for (const auto& parameter : parameters) names.push_back(name_of(parameter));
        const bool is_told = is_broken_function(op, callee) ||
                             (op == Op::Function && callee[0] == index_ &&
                              is_excused(index_, labeled.label(), argument.span().begin));
        const auto habit =
            op == Op::Function ? std::nullopt : find_habit(HabitPlace::Argument, labeled.label());
        const auto nearest = meant_name(habit, labeled.label(), names);
        if (!is_told && (nearest || !is_broken)) {
          sink_.report(diag::unknown_argument, where, labeled.label(), call.callee())
              .suggest(nearest);
        }
        // It is the argument that was probably meant, unless that one is there too.
        const bool is_free = nearest && !has_argument(call, *nearest);
        if (is_free) index = index_of_name(parameters, *nearest);
      }
    } else if (has_labels) {
      if (!is_broken) sink_.report(diag::positional_behind_named, where);
    } else if (positional < parameters.size()) {
      index = positional++;
    } else if (!is_broken && !std::exchange(has_too_many, true)) {
      sink_.report(diag::too_many_arguments, where, call.callee(), arguments(parameters.size()));
    }
    const bool is_placed = index < parameters.size() && pending_[first + index] == kNothing;
    if (index < parameters.size() && !is_placed) {
      const ast::Node earlier(*code_->tree, code_->expressions[pending_[first + index]].node);
      sink_.report(diag::duplicate, where, "argument", name_of(parameters[index]))
          .label(earlier.location(), "first given here");
    }
    const Property* property = is_placed ? property_of(parameters[index]) : nullptr;
    if (value && is_placed && !may_be_color(parameters[index])) no_color_ = value->span();
    const std::uint32_t operand = value ? expression(*value, property) : broken(argument);
    if (is_placed) {
      pending_[first + index] = operand;
    } else {
      pending_.push_back(operand);
      is_good = false;
    }
  }
  // What is missing is not reported where something could not be read: it may be that.
  for (std::size_t i = 0; i < parameters.size() && is_good; ++i) {
    if (pending_[first + i] != kNothing || !is_required(parameters[i])) continue;
    sink_.report(diag::missing, call.callee_location(), fmt::format("`{}`", call.callee()),
                 name_of(parameters[i]));
    is_good = false;
  }
  if (is_good) return add_with(op, call.node, mark);
  const auto arguments = pending_.begin() + static_cast<std::ptrdiff_t>(first);
  pending_.erase(std::remove(arguments, pending_.end(), kNothing), pending_.end());
  pending_.erase(pending_.begin() + static_cast<std::ptrdiff_t>(mark),
                 pending_.begin() + static_cast<std::ptrdiff_t>(first));
  return add_with(Op::Broken, call.node, mark);
}

}  // namespace sdlc::lang
