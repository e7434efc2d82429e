#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

std::uint32_t Resolver::resolve_statement(ast::Node node, Code& code) {
  code_.write_to(code);
  uses_.clear();
  scopes_.reset_frame_size();
  const std::uint32_t index = statement(node, true);
  code.frame_size = scopes_.frame_size();
  code_.write_to(module_.code);
  return index;
}

std::uint32_t Resolver::resolve_expression() {
  const ast::Node file(module_.tree, 0);
  const auto value = file.child(0);
  scopes_.reset_frame_size();
  const std::uint32_t index = value ? expression(*value) : code_.add_broken(file);
  module_.code.frame_size = scopes_.frame_size();
  return index;
}

std::uint32_t Resolver::resolve_value(ast::Node value, const Property* property, Code& code) {
  code_.write_to(code);
  scopes_.reset_frame_size();
  const std::uint32_t index = expression(value, property);
  code.frame_size = scopes_.frame_size();
  code_.write_to(module_.code);
  return index;
}

std::uint32_t Resolver::statement(ast::Node node, bool is_top) {
  sink_.stop_if_requested();
  switch (node.kind()) {
    case SyntaxKind::Object: return object({node}, is_top);
    case SyntaxKind::Let: return is_top ? kNothing : let_statement(node);
    case SyntaxKind::For: return for_statement(node);
    case SyntaxKind::If: return if_statement(node);
    case SyntaxKind::Assert: return assert_statement(node);
    case SyntaxKind::Include: return include_statement(node);
    case SyntaxKind::Property: return property_outside({node}, is_top);
    case SyntaxKind::Fn:
    case SyntaxKind::Def:
      if (!is_top) local_definition(node);
      return kNothing;
    case SyntaxKind::Import:
    case SyntaxKind::Param:
      if (is_top) return kNothing;
      top_level_only(node);
      record_misplaced_declaration(node);
      return kNothing;
    default: record_error(node, is_top); return kNothing;
  }
}

void Resolver::top_level_only(ast::Node statement) {
  auto report = sink_.report(diag::top_level_only, ast::word_location(statement),
                             ast::statement_word(statement.kind()));
  if (statement.is(SyntaxKind::Import)) {
    report.help("`include \"file.scene\"` adds the objects of a file in a block");
  }
}

std::uint32_t Resolver::property_outside(ast::Labeled property, bool is_top) {
  auto report = sink_.report(diag::property_outside, property.label_location(), property.label());
  const bool is_kind = std::ranges::count(all_kinds(), property.label(), &Kind::name) > 0;
  if (is_kind) {
    report.help(
        fmt::format("an object is written without a colon: `{} {{ … }}`", property.label()));
  } else if (!is_top) {
    report.help(
        fmt::format("write it directly in its object: `{}: if … then … else …`", property.label()));
  }
  if (is_recording()) recorder_->use_unknown(property.label(), NameSpace::Labels);
  record_skipped_children(property.node);
  return kNothing;
}

void Resolver::block(ast::Node node) {
  const Block scope(*this, ast::end_of_inside(node));
  const std::size_t count = code_.reserve();
  for (const ast::Node child : node.children()) {
    const std::uint32_t index = statement(child, false);
    if (index != kNothing) code_.push(index);
  }
  code_[count] = static_cast<std::uint32_t>(code_.mark() - count - 1);
}

std::uint32_t Resolver::let_statement(ast::Node node) {
  const auto value = ast::expression_of(node);
  const std::string_view name = ast::declared_name(node);
  record_rest(node, value);
  declaring_ = name;
  const std::uint32_t result = value ? expression(*value) : code_.add_broken(node);
  declaring_ = {};
  const std::size_t mark = code_.mark();
  code_.push({declare_let(node), result});
  return code_.add_statement(Action::Let, node, mark);
}

std::uint32_t Resolver::declare_let(ast::Node node) {
  const std::string_view name = ast::declared_name(node);
  const auto known = !name.empty() ? scopes_.find(name) : std::nullopt;
  if (known && scopes_.is_innermost(*known)) {
    sink_.report(diag::duplicate, node.first(SyntaxKind::Name)->location(), "value", name);
  }
  return declare_local({.kind = SymbolKind::Let,
                        .is_local = true,
                        .node = node.index(),
                        .name = name,
                        .scope = {node.span().end, scope_end_}});
}

std::uint32_t Resolver::for_statement(ast::Node node) {
  const auto list = node.child(1), body = node.child(2);
  if (!list || !body || !body->is(SyntaxKind::Block)) {
    record_broken_for(node);
    return kNothing;
  }
  const std::uint32_t values = expression(*list);
  const Block scope(*this, ast::end_of_inside(*body));
  const std::size_t mark = code_.mark();
  pattern(node, {body->span().begin, scope_end_});
  code_.push(values);
  block(*body);
  return code_.add_statement(Action::For, node, mark);
}

void Resolver::pattern(ast::Node loop, Span scope) {
  const ast::LoopNames names = ast::names_of_loop(loop);
  std::uint32_t first = kNothing;
  for (std::size_t i = 0; i < names.all.size(); ++i) {
    const ast::Node name = names.all[i];
    const auto same =
        std::ranges::find(names.all.begin(), names.all.begin() + i, name.text(), &ast::Node::text);
    const bool is_duplicate = same != names.all.begin() + i && name.text() != "_";
    if (is_duplicate) {
      sink_.report(diag::duplicate, name.location(), "loop variable", name.text())
          .label(same->location(), "first declared here");
    }
    const std::uint32_t slot = declare_local({.kind = SymbolKind::LoopVariable,
                                              .is_local = true,
                                              .is_duplicate = is_duplicate,
                                              .node = name.index(),
                                              .owner = loop.index(),
                                              .name = name.text(),
                                              .scope = scope});
    if (first == kNothing) first = slot;
  }
  if (first == kNothing) first = declare_local({.kind = SymbolKind::LoopVariable});
  code_.push({first, names.has_index, static_cast<std::uint32_t>(names.part_count())});
}

std::uint32_t Resolver::if_statement(ast::Node node) {
  // Conditions and blocks alternate; a last block without a condition is that of `else`.
  const std::size_t mark = code_.mark();
  bool has_condition = false;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Block)) {
      if (!has_condition) code_.push(kNothing);
      block(child);
      has_condition = false;
    } else {
      const std::uint32_t condition = expression(child);
      if (has_condition) code_.push(0u);  // an empty block for one that could not be read
      code_.push(condition);
      has_condition = true;
    }
  }
  if (has_condition) code_.push(0u);
  return code_.add_statement(Action::If, node, mark);
}

std::uint32_t Resolver::assert_statement(ast::Node node) {
  const auto condition = node.child(0), message = node.child(1);
  if (!condition || !message) {
    record_skipped_children(node);
    return kNothing;
  }
  const std::uint32_t first = expression(*condition), second = expression(*message);
  const std::size_t mark = code_.mark();
  code_.push({first, second});
  return code_.add_statement(Action::Assert, node, mark);
}

std::uint32_t Resolver::include_statement(ast::Node node) {
  if (is_recording()) return kNothing;
  const auto file = node.first(SyntaxKind::String);
  const std::uint32_t loaded = file ? modules_.load(index_, *file, true, sink_) : kNothing;
  if (loaded == kNothing) return kNothing;
  const std::size_t mark = code_.mark();
  code_.push(loaded);
  return code_.add_statement(Action::Include, node, mark);
}

}  // namespace sdlc::lang
