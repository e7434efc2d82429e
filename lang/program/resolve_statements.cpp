#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/program/resolver.hpp"

namespace sdlc::lang {

std::uint32_t Resolver::resolve_statement(ast::Node node, Code& code, std::uint32_t& frame_size) {
  code_ = &code;
  frame_size_ = 0;
  const std::uint32_t index = statement(node, true);
  frame_size = frame_size_;
  code_ = &module_.code;
  return index;
}

std::uint32_t Resolver::resolve_expression() {
  const ast::Node file(module_.tree, 0);
  const auto value = file.child(0);
  return value ? expression(*value) : broken(file);
}

std::uint32_t Resolver::statement(ast::Node node, bool is_top) {
  switch (node.kind()) {
    case SyntaxKind::Object: return object({node}, is_top);
    case SyntaxKind::Let: return is_top ? kNothing : let_statement(node);
    case SyntaxKind::For: return for_statement(node);
    case SyntaxKind::If: return if_statement(node);
    case SyntaxKind::Assert: return assert_statement(node);
    case SyntaxKind::Include: return include_statement(node);
    case SyntaxKind::Property: {
      const ast::Labeled property{node};
      auto report =
          sink_.report(diag::property_outside, property.label_location(), property.label());
      const bool is_kind = std::ranges::count(all_kinds(), property.label(), &Kind::name) > 0;
      if (is_kind) {
        report.help(fmt::format("an object is `{} {{ … }}`, without a colon", property.label()));
      } else if (!is_top) {
        report.help(fmt::format("it stands in its object itself: `{}: if … then … else …`",
                                property.label()));
      }
      return kNothing;
    }
    case SyntaxKind::Import:
    case SyntaxKind::Param:
    case SyntaxKind::Fn:
    case SyntaxKind::Def:
      if (!is_top) top_level_only(node);
      return kNothing;
    default: return kNothing;
  }
}

void Resolver::top_level_only(ast::Node statement) {
  auto report = sink_.report(diag::top_level_only, ast::word_location(statement),
                             ast::statement_word(statement.kind()));
  if (statement.is(SyntaxKind::Import)) {
    report.help("`include \"file.scene\"` adds the objects of a file in a block");
  }
}

void Resolver::block(ast::Node node) {
  const Scope scope(*this);
  const std::size_t mark = pending_.size();
  pending_.push_back(0);
  for (const ast::Node child : node.children()) {
    const std::uint32_t index = statement(child, false);
    if (index != kNothing) pending_.push_back(index);
  }
  pending_[mark] = static_cast<std::uint32_t>(pending_.size() - mark - 1);
}

std::uint32_t Resolver::let_statement(ast::Node node) {
  const auto value = ast::expression_of(node);
  declaring_ = ast::declared_name(node);
  const std::uint32_t result = value ? expression(*value) : broken(node);
  declaring_ = {};
  const auto name = node.first(SyntaxKind::Name);
  const Local* const known = name ? find_local(name->text()) : nullptr;
  const bool is_again = known != nullptr && known->slot >= block_begin_;
  if (is_again) sink_.report(diag::duplicate, name->location(), "value", name->text());
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {declare(ast::declared_name(node)), result});
  return add_statement(Action::Let, node, mark);
}

std::uint32_t Resolver::for_statement(ast::Node node) {
  const auto list = node.child(1), body = node.child(2);
  if (!list || !body || !body->is(SyntaxKind::Block)) return kNothing;
  const std::uint32_t values = expression(*list);
  const Scope scope(*this);
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {declare(ast::declared_name(node)), values});
  block(*body);
  return add_statement(Action::For, node, mark);
}

std::uint32_t Resolver::if_statement(ast::Node node) {
  // Conditions and blocks take turns; a last block without a condition is the one behind `else`.
  const std::size_t mark = pending_.size();
  bool has_condition = false;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Block)) {
      if (!has_condition) pending_.push_back(kNothing);
      block(child);
      has_condition = false;
    } else {
      const std::uint32_t condition = expression(child);
      if (has_condition) pending_.push_back(0);  // the block before it could not be read
      pending_.push_back(condition);
      has_condition = true;
    }
  }
  if (has_condition) pending_.push_back(0);
  return add_statement(Action::If, node, mark);
}

std::uint32_t Resolver::assert_statement(ast::Node node) {
  const auto condition = node.child(0), message = node.child(1);
  if (!condition || !message) return kNothing;
  const std::uint32_t first = expression(*condition), second = expression(*message);
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {first, second});
  return add_statement(Action::Assert, node, mark);
}

std::uint32_t Resolver::include_statement(ast::Node node) {
  const auto file = node.first(SyntaxKind::String);
  const std::uint32_t loaded = file ? program_.load(index_, *file, true, sink_) : kNothing;
  if (loaded == kNothing) return kNothing;
  const std::size_t mark = pending_.size();
  pending_.push_back(loaded);
  return add_statement(Action::Include, node, mark);
}

}  // namespace sdlc::lang
