#include "lang/lint/names.hpp"

#include <utility>

#include "lang/ast/statements.hpp"
#include "lang/program/path.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

/// The property of a built-in kind; of no other kind.
const Property* find_property(std::string_view kind_name, std::string_view name) {
  for (const Kind& kind : all_kinds()) {
    if (kind.name != kind_name) continue;
    for (const Property& property : kind.properties) {
      if (property.name == name) return &property;
    }
  }
  return nullptr;
}

std::optional<std::uint32_t> find(const auto& names, std::string_view name) {
  const auto found = names.find(name);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

FileNames::FileNames(const SyntaxTree& tree) : tree_(tree) {
  const ast::Node file(tree, 0);
  for (const ast::Node statement : file.children()) declare_top(statement);
  for (const ast::Node statement : file.children()) visit_top(statement);
}

std::uint32_t FileNames::declare(DeclaredName::Kind kind, ast::Node statement, Location where,
                                 std::string_view name) {
  declared_.push_back({.kind = kind,
                       .where = where,
                       .statement = statement.index(),
                       .name = name,
                       .is_used = false,
                       .hides = {}});
  return static_cast<std::uint32_t>(declared_.size() - 1);
}

void FileNames::declare_top(ast::Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  if (!name) return;
  const auto declare_in = [&](Names& names, DeclaredName::Kind kind) {
    names.try_emplace(name->text(), declare(kind, statement, name->location(), name->text()));
  };
  switch (statement.kind()) {
    case SyntaxKind::Let: return declare_in(values_, DeclaredName::Let);
    case SyntaxKind::Param: return declare_in(values_, DeclaredName::Param);
    case SyntaxKind::Import: return declare_in(values_, DeclaredName::Import);
    case SyntaxKind::Fn: return declare_in(functions_, DeclaredName::Fn);
    case SyntaxKind::Def: return declare_in(kinds_, DeclaredName::Def);
    default: return;
  }
}

void FileNames::declare_local(DeclaredName::Kind kind, ast::Node statement, Location where,
                              std::string_view name) {
  const auto hidden = find_value(name);
  const std::uint32_t index = declare(kind, statement, where, name);
  if (hidden) declared_[index].hides = declared_[*hidden].where;
  locals_.push_back(index);
  locals_by_name_[name].push_back(index);
}

void FileNames::leave_locals(std::size_t size) {
  for (; locals_.size() > size; locals_.pop_back()) {
    locals_by_name_[declared_[locals_.back()].name].pop_back();
  }
}

std::optional<std::uint32_t> FileNames::find_value(std::string_view name) const {
  const auto locals = locals_by_name_.find(name);
  const bool is_local = locals != locals_by_name_.end() && !locals->second.empty();
  return is_local ? std::optional(locals->second.back()) : find(values_, name);
}

void FileNames::use(std::optional<std::uint32_t> declared) {
  if (declared && declared != inside_) declared_[*declared].is_used = true;
}

void FileNames::use_path(const Names& names, std::string_view path) {
  const auto split = split_path(path);
  if (split.size() == 1) use(find(names, split[0]));
  if (split.size() > 1) use(find_value(split[0]));  // an import
}

void FileNames::use_value(std::string_view name, Location where) {
  const auto declared = find_value(name);
  use(declared);
  if (!declared && name == "time" && !time_) time_ = where;
}

void FileNames::visit(ast::Node node) {
  switch (node.kind()) {
    case SyntaxKind::Reference: {
      const auto path = split_path(node.text());
      if (!path.empty()) use_value(path[0], node.location());
      return;
    }
    case SyntaxKind::Call:
      use_path(functions_, ast::Call{node}.callee());
      return visit_children(node);
    case SyntaxKind::Object: return visit_object({node});
    case SyntaxKind::For: return visit_for(node);
    case SyntaxKind::Block: {
      const std::size_t size = locals_.size();
      const bool was_inside = std::exchange(is_inside_block_, true);
      visit_children(node);
      is_inside_block_ = was_inside;
      leave_locals(size);
      return;
    }
    case SyntaxKind::Let:
      visit_children(node);
      if (const auto name = node.first(SyntaxKind::Name); name && is_inside_block_) {
        declare_local(DeclaredName::Let, node, name->location(), name->text());
      }
      return;
    default: return visit_children(node);
  }
}

void FileNames::visit_children(ast::Node node) {
  for (const ast::Node child : node.children()) visit(child);
}

void FileNames::visit_top(ast::Node statement) {
  const std::string_view name = ast::declared_name(statement);
  const bool is_definition = statement.is(SyntaxKind::Fn) || statement.is(SyntaxKind::Def);
  if (statement.is(SyntaxKind::Fn)) inside_ = find(functions_, name);
  if (statement.is(SyntaxKind::Def)) inside_ = find(kinds_, name);
  if (is_definition) {
    visit_definition(statement);
  } else {
    visit(statement);
  }
  inside_.reset();
}

void FileNames::visit_for(ast::Node node) {
  const std::size_t size = locals_.size();
  const auto name = node.first(SyntaxKind::Name);
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Block) && name) {
      declare_local(DeclaredName::Loop, node, name->location(), name->text());
    }
    visit(child);
  }
  leave_locals(size);
}

void FileNames::visit_definition(ast::Node node) {
  const std::size_t size = locals_.size();
  for (const ast::Node child : node.children()) {
    visit(child);
    if (!child.is(SyntaxKind::Parameter)) continue;
    declare_local(DeclaredName::Parameter, node, child.head_location(), child.head());
  }
  leave_locals(size);
}

void FileNames::visit_object(ast::Object object) {
  use_path(kinds_, object.kind());
  const bool is_own = find(kinds_, object.kind()).has_value();
  const std::size_t size = locals_.size();
  const bool was_inside = std::exchange(is_inside_block_, true);
  for (const ast::Node child : object.children()) {
    const Property* property = child.is(SyntaxKind::Property) && !is_own
                                   ? find_property(object.kind(), child.head())
                                   : nullptr;
    const auto value = child.is(SyntaxKind::Property) ? ast::Labeled{child}.value() : std::nullopt;
    const bool is_word =
        property != nullptr && value && value->is(SyntaxKind::Reference) &&
        (property->type == Type::Word || (property->reads_none && value->text() == "none"));
    if (!is_word) visit(child);
  }
  is_inside_block_ = was_inside;
  leave_locals(size);
}

}  // namespace sdlc::lang
