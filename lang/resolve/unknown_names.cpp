#include "lang/resolve/unknown_names.hpp"

#include <algorithm>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/resolve/declarations.hpp"
#include "lang/resolve/lookup.hpp"
#include "lang/resolve/path.hpp"
#include "lang/resolve/record_symbols.hpp"
#include "lang/schema/find_kind.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

void add_names(const Scopes& locals, std::vector<std::string_view>& names) {
  for (std::uint32_t i = 0; i < locals.size(); ++i) names.push_back(locals[i].name);
}

/// The name of a library function or constant of other languages: `pi` for `math.PI`.
std::string member_of_library(std::string_view path) {
  return lower_case(path.substr(path.rfind('.') + 1));
}

}  // namespace

std::optional<std::string_view> intended_name(const std::optional<Habit>& habit,
                                              std::string_view name,
                                              std::span<const std::string_view> known) {
  if (!habit) return nearest_name(name, known);
  const bool is_known = std::ranges::find(known, habit->meant) != known.end();
  return is_known ? std::optional(habit->meant) : std::nullopt;
}

bool UnknownNames::may_suggest(std::size_t names) {
  constexpr std::uint64_t kMaxCompared = 2'000'000;
  module_.compared_names += names;
  return module_.compared_names <= kMaxCompared;
}

std::optional<std::string> UnknownNames::nearest_import(
    std::span<const std::string_view> names) const {
  std::vector<std::string_view> known;
  for (const auto& [name, import] : module_.imports) known.push_back(name);
  const auto nearest = nearest_name(names[0], known);
  if (!nearest) return std::nullopt;
  return fmt::format("{}.{}", *nearest, fmt::join(names.subspan(1), "."));
}

bool UnknownNames::is_excused(std::uint32_t module, std::string_view name, std::uint32_t use) {
  if (!is_ascii(name)) return true;  // the parser has reported its letters
  Module& declaring = modules_.module_at(module);
  if (!declaring.lost_names) declaring.lost_names = std::make_unique<LostNames>(declaring.tree);
  if (declaring.lost_names->contains(name)) return true;
  if (module != index_ || sink_.is_muted()) return false;
  const Misspelling* misspelling = find_misspelling(use);
  if (misspelling == nullptr || !misspelling->is_certain) return false;
  sink_
      .report(diag::misspelt_declaration, misspelling->declared, misspelling->name,
              misspelling->meant)
      .unsafe_fix(misspelling->declared, std::string(misspelling->meant))
      .label(misspelling->used, fmt::format("`{}` is used here", misspelling->meant));
  return true;
}

const Misspelling* UnknownNames::find_misspelling(std::uint32_t use) {
  if (!module_.misspellings) {
    const StopRequest* stop = sink_.stop_request();
    const SymbolTable names = record_symbols(modules_, index_, SymbolDetail::Declared, stop);
    module_.misspellings = std::make_unique<Misspellings>(names, stop);
  }
  return module_.misspellings->find(use);
}

void UnknownNames::label_unused(DiagnosticBuilder& report, std::uint32_t use,
                                std::optional<std::string_view> meant) {
  const Misspelling* misspelling = meant ? find_misspelling(use) : nullptr;
  if (misspelling == nullptr || misspelling->name != *meant) return;
  report.label(misspelling->declared,
               fmt::format("`{}` is declared here and not used", misspelling->name));
}

std::optional<std::string_view> UnknownNames::suggest_member(DiagnosticBuilder& report,
                                                             std::span<const std::string_view> path,
                                                             const Module& module,
                                                             NameSpace space) {
  const std::size_t count = space == NameSpace::Functions ? module.functions.size()
                            : space == NameSpace::Kinds   ? module.defs.size()
                                                          : module.globals.size();
  if (!report.is_kept() || !may_suggest(count)) return std::nullopt;
  const auto known = space == NameSpace::Functions ? names_of(module.functions)
                     : space == NameSpace::Kinds   ? names_of(module.defs)
                                                   : names_of(module.globals);
  const auto nearest = nearest_name(path.back(), known);
  if (!nearest) return std::nullopt;
  report.suggest(fmt::format("{}.{}", path.front(), *nearest));
  const ast::Node declaration(module.tree, find_declaration(module, space, *nearest)->node);
  if (const auto name = declaration.first(SyntaxKind::Name)) {
    report.label(name->location(), fmt::format("`{}` is declared here", name->text()));
  }
  return nearest;
}

// Values

bool UnknownNames::names_object(std::string_view name) {
  if (!module_.object_names) {
    std::unordered_set<std::string_view> names;
    for (NodeIndex i = 0; i < module_.tree.nodes().size(); ++i) {
      const ast::Node node(module_.tree, i);
      sink_.stop_if_requested();
      if (!node.is(SyntaxKind::Object)) continue;
      if (const auto label = node.first(SyntaxKind::Name)) names.insert(label->text());
    }
    module_.object_names = std::move(names);
  }
  return module_.object_names->contains(name);
}

/// Candidates in the order of preference among equally near ones: an unused name, names of the
/// file, built-in names.
std::vector<std::string_view> UnknownNames::known_values(std::uint32_t use,
                                                         std::string_view declaring) {
  std::vector<std::string_view> known;
  if (const Misspelling* misspelling = find_misspelling(use)) known.push_back(misspelling->name);
  add_names(locals_.values, known);
  for (const Global& global : module_.globals) {
    if (global.name != declaring) known.push_back(global.name);
  }
  for (const auto& [name, import] : module_.imports) known.push_back(name);
  for (const NamedColor& color : named_colors()) known.push_back(color.name);
  known.insert(known.end(), {"pi", "time", "true", "false"});
  return known;
}

void UnknownNames::report_value(ast::Node reference, std::string_view name,
                                const Excluded& excluded) {
  const bool is_function = module_.function_names.contains(name) ||
                           find_constructor(name) != nullptr || find_builtin(name) != nullptr;
  if (is_function) {
    sink_.report(diag::function_as_value, reference.location(), name)
        .help(fmt::format("call it: `{}(…)`", name));
    return;
  }
  const std::uint32_t begin = reference.span().begin;
  if (is_excused(index_, name, begin)) return;
  const std::string_view path = reference.text();
  if (find_habit(HabitPlace::Library, name) && path.size() > name.size()) {
    sink_.report(diag::unknown_name, reference.location(), path)
        .help(fmt::format("there are no libraries; write `{}`", member_of_library(path)));
    return;
  }
  const Location where =
      reference.tree().location({begin, begin + static_cast<std::uint32_t>(name.size())});
  auto report = sink_.report(diag::unknown_name, where, name);
  if (!report.is_kept() || !may_suggest(module_.globals.size())) return;
  if (names_object(name)) {
    report.help(
        fmt::format("`{}` is the name of an object, not a value; declare values with `let`", name));
    return;
  }
  const auto habit = find_habit(HabitPlace::Name, name);
  auto nearest = intended_name(habit, name, known_values(begin, excluded.declaring));
  const bool is_color = nearest && find_named_color(*nearest) && !locals_.values.find(*nearest) &&
                        !module_.global_names.contains(*nearest);
  if (is_color && reference.span() == excluded.no_color) nearest = std::nullopt;
  report.suggest(nearest);
  if (habit) report.help_if(habit->help);
  if (is_color_without_sign(name)) report.help(fmt::format("a colour is `#{}`", name));
  label_unused(report, begin, nearest);
}

void UnknownNames::report_imported_value(ast::Node reference,
                                         std::span<const std::string_view> names,
                                         std::uint32_t module_index) {
  const Module& module = modules_.module_at(module_index);
  if (names.size() == 1) {
    auto report = sink_.report(diag::import_as_value, reference.location(), names[0]);
    if (!module.globals.empty()) {
      report.help(
          fmt::format("use one of its names, such as `{}.{}`", names[0], module.globals[0].name));
    }
    return;
  }
  if (module.function_names.contains(names[1])) {
    sink_.report(diag::function_as_value, reference.location(), reference.text())
        .help(fmt::format("call it: `{}(…)`", reference.text()));
    return;
  }
  if (is_excused(module_index, names[1], reference.span().begin)) return;
  auto report = sink_.report(diag::unknown_name, reference.location(), reference.text());
  suggest_member(report, names.first(2), module, NameSpace::Values);
}

// Functions

std::optional<std::string_view> UnknownNames::report_function(ast::Call call) {
  const std::string_view callee = call.callee();
  const std::uint32_t begin = call.node.span().begin;
  if (is_excused(index_, callee, begin)) return std::nullopt;
  if (!may_suggest(module_.functions.size())) {
    sink_.report(diag::unknown_function, call.callee_location(), callee);
    return std::nullopt;
  }
  std::vector<std::string_view> known = names_of(module_.functions);
  add_names(locals_.functions, known);
  for (const Constructor& constructor : all_constructors()) known.push_back(constructor.name);
  for (const Builtin& builtin : all_builtins()) known.push_back(builtin.name);
  const auto habit = find_habit(HabitPlace::Callee, callee);
  const auto nearest = intended_name(habit, callee, known);
  auto report =
      sink_.report(diag::unknown_function, call.callee_location(), callee).suggest(nearest);
  if (habit) report.help_if(habit->help);
  label_unused(report, begin, nearest);
  if (locals_.values.find(callee) || module_.global_names.contains(callee)) {
    report.help(
        fmt::format("`{0}` is a value, not a function; an element of a list is `{0}[0]`", callee));
  } else if (locals_.kinds.find(callee) || module_.def_names.contains(callee)) {
    report.help(fmt::format("`{0}` is a kind of object; write `{0} {{ … }}`", callee));
  }
  return nearest;
}

void UnknownNames::report_imported_function(ast::Call call, std::span<const std::string_view> names,
                                            std::optional<std::uint32_t> module) {
  const std::string_view name = module ? names.back() : names.front();
  if (is_excused(module.value_or(index_), name, call.node.span().begin)) return;
  auto report = sink_.report(diag::unknown_function, call.callee_location(), call.callee());
  if (!module) {
    if (find_habit(HabitPlace::Library, names.front())) {
      report.help(
          fmt::format("there are no libraries; write `{}(…)`", member_of_library(call.callee())));
    } else {
      report.suggest(nearest_import(names));
    }
    return;
  }
  suggest_member(report, names, modules_.module_at(*module), NameSpace::Functions);
}

// Kinds and properties

UnknownNames::IntendedKind UnknownNames::report_kind_of_no_import(
    ast::Object object, std::span<const std::string_view> names) {
  if (is_excused(index_, names[0], object.node.span().begin)) return {.is_excused = true};
  sink_.report(diag::unknown_kind, object.kind_location(), object.kind())
      .suggest(nearest_import(names));
  return {};
}

UnknownNames::IntendedKind UnknownNames::report_kind(ast::Object object,
                                                     std::uint32_t module_index) {
  const Module& module = modules_.module_at(module_index);
  const bool is_own = module_index == index_;
  const std::uint32_t begin = object.node.span().begin;
  const std::vector<std::string_view> path = split_path(object.kind());
  const std::string_view name = is_own ? object.kind() : path.back();
  if (is_excused(module_index, name, begin)) return {.is_excused = true};
  auto report = sink_.report(diag::unknown_kind, object.kind_location(), object.kind());
  if (!is_own) return {.name = suggest_member(report, path, module, NameSpace::Kinds)};
  if (!may_suggest(module.defs.size())) return {};
  std::vector<std::string_view> known = names_of(module.defs);
  add_names(locals_.kinds, known);
  for (const Kind& kind : all_kinds()) known.push_back(kind.name);
  const auto habit = find_habit(HabitPlace::Kind, object.kind());
  const auto nearest = report.is_kept() ? intended_name(habit, object.kind(), known) : std::nullopt;
  if (habit) report.help_if(habit->help);
  report.suggest(nearest);
  label_unused(report, begin, nearest);
  if (locals_.functions.find(object.kind()) || module_.function_names.contains(object.kind())) {
    report.help(fmt::format("`{}` is a function; `def` declares a kind of object", object.kind()));
  }
  return {.name = nearest};
}

UnknownNames::IntendedProperty UnknownNames::report_property(
    ast::Labeled property, std::string_view kind_name, std::span<const std::string_view> names,
    bool is_broken) {
  const bool is_own =
      module_.def_names.contains(kind_name) || locals_.kinds.find(kind_name).has_value();
  const Kind* kind = is_own ? nullptr : find_kind(kind_name);
  const auto habit = kind != nullptr ? property_habit(*kind, property.label())
                                     : find_habit(HabitPlace::GroupProperty, property.label());
  const auto nearest = intended_name(habit, property.label(), names);
  const std::uint32_t begin = property.node.span().begin;
  const bool is_silent = is_broken || (is_own && is_excused(index_, property.label(), begin));
  if (!is_silent) {
    auto report =
        sink_.report(diag::unknown_property, property.label_location(), property.label(), kind_name)
            .suggest(nearest);
    if (habit) report.help_if(habit->help);
    if (is_own) label_unused(report, begin, nearest);
  }
  return {.name = nearest, .in_place_of = habit ? habit->in_place_of : std::string_view()};
}

}  // namespace sdlc::lang
