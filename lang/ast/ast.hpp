#pragma once

#include <iterator>
#include <optional>
#include <string_view>

#include "lang/syntax/syntax.hpp"

/// Views of a syntax tree: a pointer and an index each, made on demand. Any child of any node may
/// be an Error, and children may be missing after one; accessors return an optional where that can
/// happen.
namespace sdlc::lang::ast {

class Children;

class Node {
 public:
  Node(const SyntaxTree& tree, NodeIndex index) noexcept : tree_(&tree), index_(index) {}

  SyntaxKind kind() const noexcept { return node().kind; }
  bool is(SyntaxKind kind) const noexcept { return node().kind == kind; }
  Operator op() const noexcept { return node().op; }
  NodeIndex index() const noexcept { return index_; }
  const SyntaxTree& tree() const noexcept { return *tree_; }

  Span span() const noexcept { return node().span(); }
  std::string_view text() const noexcept { return tree_->text(span()); }
  Location location() const noexcept { return tree_->location(span()); }

  /// The label, name or path that the node begins with.
  Span head_span() const noexcept { return {node().begin, node().begin + node().head}; }
  std::string_view head() const noexcept { return tree_->text(head_span()); }
  Location head_location() const noexcept { return tree_->location(head_span()); }

  Children children() const noexcept;
  std::optional<Node> child(std::size_t n) const noexcept;
  std::optional<Node> first(SyntaxKind kind) const noexcept;
  /// Whether the node or one of its children could not be read.
  bool is_broken() const noexcept;

 private:
  const SyntaxNode& node() const noexcept { return (*tree_)[index_]; }

  const SyntaxTree* tree_;
  NodeIndex index_;
};

/// The children of a node, in the order of the text.
class Children {
 public:
  class Iterator {
   public:
    using value_type = Node;
    using difference_type = std::ptrdiff_t;

    Iterator(const SyntaxTree& tree, NodeIndex index) noexcept : tree_(&tree), index_(index) {}
    Node operator*() const noexcept { return {*tree_, index_}; }
    Iterator& operator++() noexcept {
      index_ += (*tree_)[index_].extent;
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) noexcept {
      return a.index_ == b.index_;
    }

   private:
    const SyntaxTree* tree_;
    NodeIndex index_;
  };

  explicit Children(Node parent) noexcept : parent_(parent) {}
  Iterator begin() const noexcept { return {parent_.tree(), parent_.index() + 1}; }
  Iterator end() const noexcept {
    return {parent_.tree(), parent_.index() + parent_.tree()[parent_.index()].extent};
  }

 private:
  Node parent_;
};

inline Children Node::children() const noexcept { return Children(*this); }

inline std::optional<Node> Node::child(std::size_t n) const noexcept {
  for (const Node node : children()) {
    if (n-- == 0) return node;
  }
  return std::nullopt;
}

inline std::optional<Node> Node::first(SyntaxKind kind) const noexcept {
  for (const Node node : children()) {
    if (node.is(kind)) return node;
  }
  return std::nullopt;
}

inline bool Node::is_broken() const noexcept {
  return is(SyntaxKind::Error) || first(SyntaxKind::Error).has_value();
}

/// `label: value`, a property or an argument.
struct Labeled {
  Node node;

  std::string_view label() const noexcept { return node.head(); }
  Location label_location() const noexcept { return node.head_location(); }
  std::optional<Node> value() const noexcept { return node.child(0); }
};

/// `kind name { statements }`
struct Object {
  Node node;

  std::string_view kind() const noexcept { return node.head(); }
  Location kind_location() const noexcept { return node.head_location(); }
  std::optional<Node> name() const noexcept {
    const auto first = node.child(0);
    return first && first->is(SyntaxKind::Name) ? first : std::nullopt;
  }
  /// Whether statements may be missing: there is an error, or the file ends before the `}`.
  bool is_broken() const noexcept { return node.is_broken() || !node.text().ends_with('}'); }
  /// The name, if there is one, and the statements.
  Children children() const noexcept { return node.children(); }
};

/// `callee(arguments)`; an argument is an Argument or, without a label, an expression.
struct Call {
  Node node;

  std::string_view callee() const noexcept { return node.head(); }
  Location callee_location() const noexcept { return node.head_location(); }
  /// Whether arguments may be missing, because of an error.
  bool is_broken() const noexcept { return node.is_broken() || !node.text().ends_with(')'); }
  Children arguments() const noexcept { return node.children(); }
};

}  // namespace sdlc::lang::ast
