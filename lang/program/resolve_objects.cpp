#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/program/path.hpp"
#include "lang/program/resolver.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

const Kind* find_kind(std::string_view name) noexcept {
  const auto kinds = all_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}
template <typename Map>
std::optional<std::uint32_t> find(const Map& map, std::string_view name) {
  if (map.empty()) return std::nullopt;
  const auto found = map.find(name);
  return found == map.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

std::uint32_t Resolver::object(ast::Object node, bool is_top) {
  const std::string_view path = node.kind();
  const bool is_path = path.find('.') != std::string_view::npos;
  if (!is_path) {
    if (const auto def = find(module_.def_names, path)) return instance_of(index_, *def, node);
    const Kind* kind = find_kind(path);
    if (kind == nullptr) return unknown_kind(node, index_, is_top);
    if (kind->is_setting && !is_top) {
      sink_.report(diag::top_level_only, node.kind_location(), kind->name);
      return kNothing;
    }
    return object_of(*kind, node);
  }

  const std::vector<std::string_view> names = split_path(path);
  const auto module = find_import(names[0]);
  if (!module) {
    if (is_excused(index_, names[0], node.node.span().begin)) return kNothing;
    sink_.report(diag::unknown_kind, node.kind_location(), path).suggest(nearest_import(names));
    return object_of_no_kind(node);
  }
  if (*module == kNothing) return kNothing;  // reported where it is imported
  const auto def =
      names.size() == 2 ? find(program_.module(*module).def_names, names[1]) : std::nullopt;
  return def ? instance_of(*module, *def, node) : unknown_kind(node, *module, is_top);
}

std::uint32_t Resolver::unknown_kind(ast::Object node, std::uint32_t scope, bool is_top) {
  std::vector<std::string_view> names;
  const Module& module = program_.module(scope);
  for (const Definition& def : module.defs) names.push_back(def.name);
  std::string_view written = node.kind();
  if (scope == index_) {
    for (const Kind& known : all_kinds()) names.push_back(known.name);
  } else {
    written = split_path(written).back();
  }
  if (is_excused(scope, written, node.node.span().begin)) return kNothing;
  auto report = sink_.report(diag::unknown_kind, node.kind_location(), node.kind());
  if (!may_suggest(names.size())) return object_of_no_kind(node);
  const auto habit = scope == index_ ? find_habit(HabitPlace::Kind, written) : std::nullopt;
  const auto nearest = report.is_kept() ? meant_name(habit, written, names) : std::nullopt;
  if (habit) report.help_if(habit->help);
  if (scope == index_) {
    report.suggest(nearest);
    label_unused(report, node.node.span().begin, nearest);
  } else if (nearest) {
    report.suggest(fmt::format("{}.{}", split_path(node.kind())[0], *nearest));
    label_declared(report, {module.tree, module.defs[module.def_names.at(*nearest)].node});
  }
  if (module_.function_names.contains(node.kind())) {
    report.help(fmt::format("`{}` is a function; `def` makes a kind of object", node.kind()));
  }
  if (!nearest) return object_of_no_kind(node);
  if (scope == index_) return object_as(*nearest, node, is_top);
  const Guess guess(*this);
  return instance_of(scope, *find(module.def_names, *nearest), node);
}

/// What a misspelt kind holds is read as that of the kind which was probably meant.
std::uint32_t Resolver::object_as(std::string_view kind, ast::Object node, bool is_top) {
  // Nor is anything missing of what may be another kind.
  const Guess guess(*this);
  if (const auto def = find(module_.def_names, kind)) return instance_of(index_, *def, node);
  const Kind& known = *find_kind(kind);
  return known.is_setting && !is_top ? kNothing : object_of(known, node);
}

/// No one knows which properties an unknown kind has, and which words they take; what they are
/// computed from may be wrong all the same. It is a group that does nothing, whose material no one
/// misses.
std::uint32_t Resolver::object_of_no_kind(ast::Object node) {
  const Scope scope(*this);
  std::vector<std::uint32_t> values, statements;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      const auto value = ast::Labeled{child}.value();
      const bool is_word = value && value->is(SyntaxKind::Reference);
      if (value && !is_word) values.push_back(expression(*value));
    } else if (const auto index = statement(child, false); index != kNothing) {
      statements.push_back(index);
    }
  }
  const std::size_t mark = pending_.size();
  const auto pairs = static_cast<std::uint32_t>(values.size() + 1);
  pending_.insert(pending_.end(), {0, pairs, group_property::kMaterial, broken(node.node)});
  for (const std::uint32_t value : values) pending_.insert(pending_.end(), {kNothing, value});
  pending_.push_back(static_cast<std::uint32_t>(statements.size()));
  pending_.insert(pending_.end(), statements.begin(), statements.end());
  return add_statement(Action::Group, node.node, mark, ObjectKind::Group);
}

void Resolver::check_name(const Kind& kind, ast::Object node) {
  const auto name = node.name();
  if (!name || kind.takes_name) return;
  sink_.report(diag::takes_no_name, name->location(), kind.name).unsafe_fix(name->location(), "");
}

void Resolver::misplaced(std::string_view kind, ast::Node statement) {
  const bool is_object = statement.is(SyntaxKind::Object);
  const Location where = is_object ? statement.head_location() : ast::word_location(statement);
  const std::string_view word =
      is_object ? statement.head() : ast::statement_word(statement.kind());
  auto report = sink_.report(diag::properties_only, where, kind, word);
  const auto habit = is_object ? find_habit(HabitPlace::Kind, word) : std::nullopt;
  if (habit) report.help_if(habit->help);
  if (!statement.is(SyntaxKind::If)) return;
  const auto block = statement.first(SyntaxKind::Block);
  const auto property = block ? block->first(SyntaxKind::Property) : std::nullopt;
  if (property) report.help(fmt::format("write `{}: if … then … else …`", property->head()));
}

void Resolver::Slots::reset(std::string_view kind_) {
  kind = kind_;
  is_broken = false;
  names.clear();
  given.clear();
  others.clear();
}

void Resolver::Slots::add(std::string_view name, const Property* property, const TypeInfo* type) {
  names.push_back({name, property, type});
  given.emplace_back();
}

std::size_t Resolver::Slots::index_of(std::string_view name) const {
  std::size_t index = 0;
  while (index < names.size() && names[index].name != name) ++index;
  return index;
}

/// Where the value of an unknown property goes: to the one that was probably meant, unless that one
/// stands there too. What is missing only because of a slip of the pen is not missing.
std::size_t Resolver::guess_property(ast::Labeled node) {
  std::vector<std::string_view> names;
  for (const Slots::Name& known : slots_.names) names.push_back(known.name);
  const bool is_own = module_.def_names.contains(slots_.kind);
  const Kind* kind = is_own ? nullptr : find_kind(slots_.kind);
  const auto habit = kind != nullptr ? property_habit(*kind, node.label())
                                     : find_habit(HabitPlace::GroupProperty, node.label());
  const auto nearest = meant_name(habit, node.label(), names);
  const bool is_told =
      slots_.is_broken || (is_own && is_excused(index_, node.label(), node.node.span().begin));
  if (!is_told) {
    auto report =
        sink_.report(diag::unknown_property, node.label_location(), node.label(), slots_.kind)
            .suggest(nearest);
    if (habit) report.help_if(habit->help);
    if (is_own) label_unused(report, node.node.span().begin, nearest);
  }
  if (habit && !habit->in_place_of.empty()) {
    Slots::Given& other = slots_.given[slots_.index_of(habit->in_place_of)];
    if (!other.is_written) {
      other = {.value = broken(node.node), .span = {}, .is_written = true, .is_guess = true};
    }
  }
  const std::size_t index = nearest ? slots_.index_of(*nearest) : names.size();
  return index < names.size() && !slots_.given[index].is_written ? index : names.size();
}

void Resolver::read_property(ast::Labeled node) {
  const std::size_t none = slots_.names.size();
  std::size_t index = slots_.index_of(node.label());
  const bool is_guess = index == none;
  if (is_guess) {
    index = guess_property(node);
  } else if (slots_.given[index].is_written && !slots_.given[index].is_guess) {
    sink_.report(diag::duplicate, node.label_location(), "property", node.label())
        .label(node.node.tree().location(slots_.given[index].span), "first given here");
    index = none;
  }

  const auto value = node.value();
  const Property* property = index == none ? nullptr : slots_.names[index].property;
  const bool is_stretched =
      property != nullptr && property->name == "scale" && value && value->is(SyntaxKind::Triple);
  if (is_stretched) {
    sink_
        .report(diag::wrong_type, value->location(), property->name, describe(property->type),
                describe(Type::Vec3))
        .help("a group is scaled by one number, alike in all directions");
  }
  const TypeInfo* type = index == none ? nullptr : slots_.names[index].type;
  const bool takes_no_color = (property != nullptr && property->type != Type::Color) ||
                              (type != nullptr && type->name != "color");
  if (value && takes_no_color) no_color_ = value->span();
  const std::uint32_t result =
      value && !is_stretched ? expression(*value, property) : broken(node.node);
  if (index == none) {
    slots_.others.push_back(result);
  } else {
    slots_.given[index] = {.value = result,
                           .span = value ? value->span() : node.node.span(),
                           .is_written = true,
                           .is_guess = is_guess};
  }
}

void Resolver::read_properties(ast::Object node) {
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      read_property({child});
    } else if (!child.is(SyntaxKind::Name) && !child.is(SyntaxKind::Error)) {
      misplaced(slots_.kind, child);
      expect_inside(child);
    }
  }
}

/// A property that stands in a misplaced `if` or `for` is not missing.
void Resolver::expect_inside(ast::Node statement) {
  for (const ast::Node child : statement.children()) {
    if (child.is(SyntaxKind::Block)) expect_inside(child);
    if (!child.is(SyntaxKind::Property)) continue;
    const std::size_t index = slots_.index_of(child.head());
    if (index == slots_.names.size() || slots_.given[index].is_written) continue;
    slots_.given[index] = {
        .value = broken(child), .span = child.span(), .is_written = true, .is_guess = true};
  }
}

void Resolver::push_properties(std::size_t first) {
  for (std::size_t i = first; i < slots_.given.size(); ++i) {
    if (!slots_.given[i].is_written) continue;
    pending_.push_back(static_cast<std::uint32_t>(i - first));
    pending_.push_back(slots_.given[i].value);
  }
  for (const std::uint32_t other : slots_.others) {
    pending_.push_back(kNothing);
    pending_.push_back(other);
  }
}

std::uint32_t Resolver::object_of(const Kind& kind, ast::Object node) {
  check_name(kind, node);
  if (kind.id == ObjectKind::Group) return group(kind, node);
  slots_.reset(kind.name);
  for (const Property& property : kind.properties) slots_.add(property.name, &property);
  read_properties(node);
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    const Property& property = kind.properties[i];
    const bool is_missing = property.presence == Presence::Required && !slots_.given[i].is_written;
    // A property that could not be read may be the one that is missing.
    if (is_missing && !node.is_broken() && !is_guess_) {
      sink_.report(diag::missing, node.kind_location(), kind.name, property.name);
    }
  }
  const std::size_t mark = pending_.size();
  push_properties(0);
  return add_statement(Action::Object, node.node, mark, kind.id);
}

std::uint32_t Resolver::group(const Kind& kind, ast::Object node) {
  const Scope scope(*this);
  Slots own;
  own.reset(kind.name);
  for (const Property& property : kind.properties) own.add(property.name, &property);
  std::vector<std::uint32_t> lets, statements;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      std::swap(slots_, own);
      read_property({child});
      std::swap(slots_, own);
      continue;
    }
    const std::uint32_t index = statement(child, false);
    if (index == kNothing) continue;
    statements.push_back(index);
    if (child.is(SyntaxKind::Let)) lets.push_back(index);
  }
  // The properties are needed before the statements, and may use the lets before them.
  std::swap(slots_, own);
  const std::size_t mark = pending_.size();
  const auto push = [&](const std::vector<std::uint32_t>& list) {
    pending_.push_back(static_cast<std::uint32_t>(list.size()));
    pending_.insert(pending_.end(), list.begin(), list.end());
  };
  push(lets);
  const std::size_t size_at = pending_.size();
  pending_.push_back(0);
  push_properties(0);
  pending_[size_at] = static_cast<std::uint32_t>((pending_.size() - size_at - 1) / 2);
  push(statements);
  return add_statement(Action::Group, node.node, mark, kind.id);
}

std::uint32_t Resolver::instance_of(std::uint32_t module, std::uint32_t def, ast::Object node) {
  const Module& owner = program_.module(module);
  const std::vector<Parameter>& parameters = owner.defs[def].parameters;
  slots_.reset(node.kind());
  slots_.is_broken = owner.defs[def].is_broken;
  for (const Parameter& parameter : parameters) slots_.add(parameter.name, nullptr, parameter.type);
  for (const Property& property : kind_info(ObjectKind::Group).properties) {
    // A parameter named `material` takes the place of the group's.
    const bool is_taken = slots_.index_of(property.name) < parameters.size();
    slots_.add(is_taken ? std::string_view() : property.name, &property);
  }
  read_properties(node);
  bool is_complete = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (slots_.given[i].is_written || parameters[i].has_default) continue;
    is_complete = false;
    if (node.is_broken() || slots_.is_broken || is_guess_) continue;
    sink_.report(diag::missing, node.kind_location(), node.kind(), parameters[i].name)
        .label(ast::Node(owner.tree, parameters[i].node).head_location(), "declared here");
  }
  if (!is_complete) return kNothing;

  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {module, def, 0});
  push_properties(parameters.size());
  pending_[mark + 2] = static_cast<std::uint32_t>((pending_.size() - mark - 3) / 2);
  for (std::size_t i = 0; i < parameters.size(); ++i) pending_.push_back(slots_.given[i].value);
  return add_statement(Action::Instance, node.node, mark, ObjectKind::Group);
}

}  // namespace sdlc::lang
