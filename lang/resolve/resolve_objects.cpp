#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/resolve/lookup.hpp"
#include "lang/resolve/path.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/schema/find_kind.hpp"

namespace sdlc::lang {
// Kinds

std::uint32_t Resolver::object(ast::Object node, bool is_top) {
  if (is_recording()) recorder_->declare_object(node);
  const std::string_view name = node.kind();
  if (name.find('.') != std::string_view::npos) return imported_object(node, is_top);
  if (const Definition* local = find_local(NameSpace::Kinds, name)) {
    if (is_recording()) recorder_->use_own(name, local->node);
    return local_instance(*local, node);
  }
  if (const auto def = find_declaration(module_, NameSpace::Kinds, name)) {
    if (is_recording()) recorder_->use_own(name, def->node);
    return instance_of(index_, def->index, node);
  }
  const Kind* kind = find_kind(name);
  if (kind == nullptr) {
    if (is_recording()) {
      recorder_->use_unknown(name, NameSpace::Kinds);
      return object_of_no_kind(node);
    }
    return object_as(unknown_.report_kind(node, index_), index_, node, is_top);
  }
  if (is_recording()) recorder_->use_builtin(name, SymbolKind::BuiltinKind);
  if (kind->is_setting && !is_top) {
    sink_.report(diag::top_level_only, node.kind_location(), kind->name);
    if (!is_recording()) return kNothing;
  }
  return object_of(*kind, node);
}

std::uint32_t Resolver::imported_object(ast::Object node, bool is_top) {
  const std::vector<std::string_view> names = split_path(node.kind());
  const Import* import = find_in(module_.imports, names[0]);
  if (import == nullptr) {
    record_path(names);
    if (is_recording()) return object_of_no_kind(node);
    return object_as(unknown_.report_kind_of_no_import(node, names), index_, node, is_top);
  }
  const auto def = imported_declaration(*import, NameSpace::Kinds, names);
  if (def) return instance_of(import->module, def->index, node);
  if (is_recording()) return object_of_no_kind(node);
  if (import->module == kNothing) return kNothing;  // reported at the import
  return object_as(unknown_.report_kind(node, import->module), import->module, node, is_top);
}

/// Resolves an object of a misspelt kind as one of the intended kind.
std::uint32_t Resolver::object_as(const UnknownNames::IntendedKind& intended, std::uint32_t module,
                                  ast::Object node, bool is_top) {
  if (intended.is_excused) return kNothing;
  if (!intended.name) return object_of_no_kind(node);
  const Guess guess(*this);
  const Module& owner = modules_.module_at(module);
  const Definition* local =
      module == index_ ? find_local(NameSpace::Kinds, *intended.name) : nullptr;
  if (local != nullptr) return local_instance(*local, node);
  if (const auto def = find_declaration(owner, NameSpace::Kinds, *intended.name)) {
    return instance_of(module, def->index, node);
  }
  const Kind& known = *find_kind(*intended.name);
  return known.is_setting && !is_top ? kNothing : object_of(known, node);
}

/// The properties of an unknown kind are unknown, and so are the words that they accept. Errors in
/// their values and in statements are reported: the object becomes a group, with a broken material
/// so that no sphere in it lacks one.
std::uint32_t Resolver::object_of_no_kind(ast::Object node) {
  const Block scope(*this, ast::end_of_inside(node.node));
  std::vector<std::uint32_t> values, statements;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      if (is_recording()) recorder_->use_unknown(child.head(), NameSpace::Labels);
      const auto value = ast::Labeled{child}.value();
      record_rest(child, value);
      const bool may_be_word = value && value->is(SyntaxKind::Reference) && !is_recording();
      if (value && !may_be_word) values.push_back(expression(*value));
    } else if (const auto index = statement(child, false); index != kNothing) {
      statements.push_back(index);
    }
  }
  const std::size_t mark = code_.mark();
  const auto pairs = static_cast<std::uint32_t>(values.size() + 1);
  code_.push({0, pairs, group_property::kMaterial, code_.add_broken(node.node)});
  for (const std::uint32_t value : values) code_.push({kNothing, value});
  code_.push(static_cast<std::uint32_t>(statements.size()));
  code_.push(statements);
  return code_.add_statement(Action::Group, node.node, mark, ObjectKind::Group);
}

void Resolver::check_name(const Kind& kind, ast::Object node) {
  const auto name = node.name();
  if (!name || kind.takes_name) return;
  sink_.report(diag::takes_no_name, name->location(), kind.name).unsafe_fix(name->location(), "");
}

std::uint32_t Resolver::object_of(const Kind& kind, ast::Object node) {
  check_name(kind, node);
  if (kind.id == ObjectKind::Group) return group(kind, node);
  slots_.reset(kind.name);
  for (const Property& property : kind.properties) slots_.add(property);
  read_properties(node);
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    const Property& property = kind.properties[i];
    const bool is_missing = property.presence == Presence::Required && !slots_.given[i].is_written;
    // An error may hide the missing property.
    if (is_missing && !node.is_broken() && !is_guess_) {
      sink_.report(diag::missing, node.kind_location(), kind.name, property.name);
    }
  }
  const std::size_t mark = code_.mark();
  slots_.push_to(code_, 0);
  return code_.add_statement(Action::Object, node.node, mark, kind.id);
}

std::uint32_t Resolver::group(const Kind& kind, ast::Object node) {
  const Block scope(*this, ast::end_of_inside(node.node));
  PropertySlots own;
  own.reset(kind.name);
  for (const Property& property : kind.properties) own.add(property);
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
  // Properties are evaluated before the statements, and may use the lets.
  std::swap(slots_, own);
  const std::size_t mark = code_.mark();
  code_.push(static_cast<std::uint32_t>(lets.size()));
  code_.push(lets);
  const std::size_t pairs = code_.reserve();
  slots_.push_to(code_, 0);
  code_[pairs] = static_cast<std::uint32_t>((code_.mark() - pairs - 1) / 2);
  code_.push(static_cast<std::uint32_t>(statements.size()));
  code_.push(statements);
  return code_.add_statement(Action::Group, node.node, mark, kind.id);
}

std::uint32_t Resolver::local_instance(const Definition& def, ast::Object node) {
  use_definition(def);
  return instance_of(Action::LocalInstance, local_callee(def), def, node);
}

std::uint32_t Resolver::instance_of(std::uint32_t module, std::uint32_t index, ast::Object node) {
  const Definition& def = modules_.module_at(module).defs[index];
  return instance_of(Action::Instance, {module, index}, def, node);
}

std::uint32_t Resolver::instance_of(Action action, std::array<std::uint32_t, 2> callee,
                                    const Definition& def, ast::Object node) {
  slots_.reset(node.kind());
  slots_.is_broken = def.is_broken;
  slots_.def = {def.module, def.node};
  for (const Parameter& parameter : def.parameters) slots_.add_parameter(parameter);
  for (const Property& property : kind_info(ObjectKind::Group).properties) {
    // A parameter `material` replaces the property of the group.
    const bool is_taken = slots_.index_of(property.name) < def.parameters.size();
    slots_.add(property, is_taken ? std::string_view() : property.name);
  }
  read_properties(node);
  if (!has_all_parameters(modules_.module_at(def.module), def, node)) return kNothing;

  const std::size_t mark = code_.mark();
  code_.push({callee[0], callee[1], 0});
  slots_.push_to(code_, def.parameters.size());
  code_[mark + 2] = static_cast<std::uint32_t>((code_.mark() - mark - 3) / 2);
  for (std::size_t i = 0; i < def.parameters.size(); ++i) code_.push(slots_.given[i].value);
  return code_.add_statement(action, node.node, mark, ObjectKind::Group);
}

bool Resolver::has_all_parameters(const Module& owner, const Definition& def, ast::Object node) {
  bool is_complete = true;
  for (std::size_t i = 0; i < def.parameters.size(); ++i) {
    const Parameter& parameter = def.parameters[i];
    if (slots_.given[i].is_written || parameter.has_default) continue;
    is_complete = false;
    if (node.is_broken() || slots_.is_broken || is_guess_) continue;
    sink_.report(diag::missing, node.kind_location(), node.kind(), parameter.name)
        .label(ast::Node(owner.tree, parameter.node).head_location(), "declared here");
  }
  return is_complete;
}

// Properties

void Resolver::read_properties(ast::Object node) {
  std::optional<Block> scope;  // for misplaced statements
  if (is_recording()) scope.emplace(*this, ast::end_of_inside(node.node));
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      read_property({child});
    } else if (!child.is(SyntaxKind::Name)) {
      misplaced(child);
    }
  }
}

void Resolver::misplaced(ast::Node statement) {
  if (is_recording()) return record_misplaced(statement);
  if (statement.is(SyntaxKind::Error)) return;
  const bool is_object = statement.is(SyntaxKind::Object);
  const Location where = is_object ? statement.head_location() : ast::word_location(statement);
  const std::string_view word =
      is_object ? statement.head() : ast::statement_word(statement.kind());
  auto report = sink_.report(diag::properties_only, where, slots_.kind, word);
  const auto habit = is_object ? find_habit(HabitPlace::Kind, word) : std::nullopt;
  if (habit) report.help_if(habit->help);
  if (statement.is(SyntaxKind::If)) {
    const auto block = statement.first(SyntaxKind::Block);
    const auto property = block ? block->first(SyntaxKind::Property) : std::nullopt;
    if (property) report.help(fmt::format("write `{}: if … then … else …`", property->head()));
  }
  expect_inside(statement);
}

/// Marks properties in a misplaced `if` or `for` as written, so that they are not missing.
void Resolver::expect_inside(ast::Node statement) {
  for (const ast::Node child : statement.children()) {
    if (child.is(SyntaxKind::Block)) expect_inside(child);
    if (!child.is(SyntaxKind::Property)) continue;
    const std::size_t index = slots_.index_of(child.head());
    if (index == slots_.names.size() || slots_.given[index].is_written) continue;
    slots_.given[index] = {.value = code_.add_broken(child),
                           .span = child.span(),
                           .is_written = true,
                           .is_guess = true};
  }
}

/// The slot of the property that an unknown one was intended to be, so that it is not missing; the
/// number of slots if there is none or it has a value.
std::size_t Resolver::guess_property(ast::Labeled node) {
  const std::vector<std::string_view> names = names_of(slots_.names);
  const UnknownNames::IntendedProperty intended =
      unknown_.report_property(node, slots_.kind, names, slots_.is_broken);
  if (!intended.in_place_of.empty()) {
    PropertySlots::Given& other = slots_.given[slots_.index_of(intended.in_place_of)];
    if (!other.is_written) {
      other = {
          .value = code_.add_broken(node.node), .span = {}, .is_written = true, .is_guess = true};
    }
  }
  const std::size_t index = intended.name ? slots_.index_of(*intended.name) : names.size();
  return index < names.size() && !slots_.given[index].is_written ? index : names.size();
}

void Resolver::read_property(ast::Labeled node) {
  const std::size_t none = slots_.names.size();
  std::size_t index = slots_.index_of(node.label());
  const bool is_guess = index == none;
  if (is_recording()) {
    record_label(node, index);
  } else if (is_guess) {
    index = guess_property(node);
  } else if (slots_.given[index].is_written && !slots_.given[index].is_guess) {
    sink_.report(diag::duplicate, node.label_location(), "property", node.label())
        .label(node.node.tree().location(slots_.given[index].span), "first given here");
    index = none;
  }
  const std::uint32_t value = property_value(node, index);
  if (index == none) {
    slots_.others.push_back(value);
    return;
  }
  const auto written = node.value();
  slots_.given[index] = {.value = value,
                         .span = written ? written->span() : node.node.span(),
                         .is_written = true,
                         .is_guess = is_guess};
}

/// `index`: the slot of the property; slots_.names.size() for an unknown one.
std::uint32_t Resolver::property_value(ast::Labeled node, std::size_t index) {
  const auto value = node.value();
  record_rest(node.node, value);
  if (!value) return code_.add_broken(node.node);
  if (index == slots_.names.size()) return expression(*value);
  const auto& [name, property, type, parameter] = slots_.names[index];
  const bool is_vector_scale =
      property != nullptr && property->name == "scale" && value->is(SyntaxKind::Triple);
  if (is_vector_scale) {
    sink_
        .report(diag::wrong_type, value->location(), property->name, describe(property->type),
                describe(Type::Vec3))
        .help("a group is scaled by one number, equally in all directions");
    record_skipped(*value);
    return code_.add_broken(node.node);
  }
  const bool excludes_color = (property != nullptr && property->type != Type::Color) ||
                              (type != nullptr && type->name != "color");
  if (excludes_color) no_color_ = value->span();
  return expression(*value, property);
}

}  // namespace sdlc::lang
