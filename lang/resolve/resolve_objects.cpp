#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/resolve/path.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/schema/find_kind.hpp"

namespace sdlc::lang {
namespace {

template <typename Map>
std::optional<std::uint32_t> find(const Map& map, std::string_view name) {
  if (map.empty()) return std::nullopt;
  const auto found = map.find(name);
  return found == map.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

// Kinds

std::uint32_t Resolver::object(ast::Object node, bool is_top) {
  if (is_recording()) recorder_->declare_object(node);
  const std::string_view name = node.kind();
  if (name.find('.') != std::string_view::npos) return imported_object(node, is_top);
  if (const auto def = find(module_.def_names, name)) {
    if (is_recording()) recorder_->use_own(name, module_.defs[*def].node);
    return instance_of(index_, *def, node);
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
  const auto import = module_.imports.find(names[0]);
  if (import == module_.imports.end()) {
    record_path(names);
    if (is_recording()) return object_of_no_kind(node);
    return object_as(unknown_.report_kind_of_no_import(node, names), index_, node, is_top);
  }
  const std::uint32_t module = import->second.module;
  if (is_recording()) recorder_->use_own(names[0], import->second.node);
  const auto def = module != kNothing && names.size() == 2
                       ? find(modules_.module_at(module).def_names, names[1])
                       : std::nullopt;
  if (is_recording()) {
    record_member(names,
                  def ? SymbolId{module, modules_.module_at(module).defs[*def].node} : SymbolId{});
    return def ? instance_of(module, *def, node) : object_of_no_kind(node);
  }
  if (module == kNothing) return kNothing;  // reported where it is imported
  if (def) return instance_of(module, *def, node);
  return object_as(unknown_.report_kind(node, module), module, node, is_top);
}

/// An object of a misspelt kind is read as one of the kind that was probably meant.
std::uint32_t Resolver::object_as(const UnknownNames::MeantKind& meant, std::uint32_t module,
                                  ast::Object node, bool is_top) {
  if (meant.is_excused) return kNothing;
  if (!meant.name) return object_of_no_kind(node);
  const Guess guess(*this);
  if (const auto def = find(modules_.module_at(module).def_names, *meant.name)) {
    return instance_of(module, *def, node);
  }
  const Kind& known = *find_kind(*meant.name);
  return known.is_setting && !is_top ? kNothing : object_of(known, node);
}

/// Which properties an unknown kind has, and which words they take, is unknown; what they are
/// computed from may be wrong all the same. The object becomes a group that does nothing, with a
/// material, so that none is missing.
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
    // A property that could not be read may be the one that is missing.
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
  // Properties are needed before the statements, and may use the lets before them.
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

std::uint32_t Resolver::instance_of(std::uint32_t module, std::uint32_t index, ast::Object node) {
  const Module& owner = modules_.module_at(module);
  const Definition& def = owner.defs[index];
  slots_.reset(node.kind());
  slots_.is_broken = def.is_broken;
  slots_.def = {module, def.node};
  for (const Parameter& parameter : def.parameters) slots_.add_parameter(parameter);
  for (const Property& property : kind_info(ObjectKind::Group).properties) {
    // A parameter named `material` takes the place of the group's.
    const bool is_taken = slots_.index_of(property.name) < def.parameters.size();
    slots_.add(property, is_taken ? std::string_view() : property.name);
  }
  read_properties(node);
  if (!has_all_parameters(owner, def, node)) return kNothing;

  const std::size_t mark = code_.mark();
  code_.push({module, index, 0});
  slots_.push_to(code_, def.parameters.size());
  code_[mark + 2] = static_cast<std::uint32_t>((code_.mark() - mark - 3) / 2);
  for (std::size_t i = 0; i < def.parameters.size(); ++i) code_.push(slots_.given[i].value);
  return code_.add_statement(Action::Instance, node.node, mark, ObjectKind::Group);
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
  std::optional<Block> scope;  // of misplaced statements
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
  if (statement.is(SyntaxKind::If)) {
    const auto block = statement.first(SyntaxKind::Block);
    const auto property = block ? block->first(SyntaxKind::Property) : std::nullopt;
    if (property) report.help(fmt::format("write `{}: if … then … else …`", property->head()));
  }
  expect_inside(statement);
}

/// A property in a misplaced `if` or `for` is not missing.
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

/// The slot for the value of an unknown property: that of the one that was probably meant, unless
/// it is written too. A property is not missing only because its name is misspelt.
std::size_t Resolver::guess_property(ast::Labeled node) {
  std::vector<std::string_view> names;
  for (const PropertySlots::Name& known : slots_.names) names.push_back(known.name);
  const UnknownNames::MeantProperty meant =
      unknown_.report_property(node, slots_.kind, names, slots_.is_broken);
  if (!meant.in_place_of.empty()) {
    PropertySlots::Given& other = slots_.given[slots_.index_of(meant.in_place_of)];
    if (!other.is_written) {
      other = {
          .value = code_.add_broken(node.node), .span = {}, .is_written = true, .is_guess = true};
    }
  }
  const std::size_t index = meant.name ? slots_.index_of(*meant.name) : names.size();
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

/// `index`: the slot of the property; slots_.names.size() if it has none.
std::uint32_t Resolver::property_value(ast::Labeled node, std::size_t index) {
  const auto value = node.value();
  record_rest(node.node, value);
  if (!value) return code_.add_broken(node.node);
  if (index == slots_.names.size()) return expression(*value);
  const auto& [name, property, type, parameter] = slots_.names[index];
  const bool is_stretched =
      property != nullptr && property->name == "scale" && value->is(SyntaxKind::Triple);
  if (is_stretched) {
    sink_
        .report(diag::wrong_type, value->location(), property->name, describe(property->type),
                describe(Type::Vec3))
        .help("a group is scaled by one number, alike in all directions");
    record_skipped(*value);
    return code_.add_broken(node.node);
  }
  const bool takes_no_color = (property != nullptr && property->type != Type::Color) ||
                              (type != nullptr && type->name != "color");
  if (takes_no_color) no_color_ = value->span();
  return expression(*value, property);
}

}  // namespace sdlc::lang
