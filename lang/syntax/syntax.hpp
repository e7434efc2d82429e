#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/node_buffer.hpp"

/// The syntax tree of a scene file: lossless, flat, and always there, however broken the file is.
namespace sdlc::lang {

/// The kind of a node. Its children are listed in order; `head` is a label, name or path at the
/// node's beginning without a node of its own. Any child and any statement may be an Error.
enum class SyntaxKind : std::uint8_t {
  Error,  ///< text that could not be read; its children are the parts that could
  File,   ///< Version, statements

  // Statements
  Property,  ///< head: label; expression
  Import,    ///< String, Name
  Include,   ///< String
  Param,     ///< Name, [TypeName], expression
  Let,       ///< Name, expression
  Fn,        ///< Name, Parameter..., expression
  Def,       ///< Name, Parameter..., Block
  Assert,    ///< expression, expression
  For,       ///< Pattern, expression, Block
  If,        ///< expression, Block, [expression, Block]..., [Block]
  Object,    ///< head: path of the kind; [Name], statements

  // Parts of statements and comprehensions
  Version,     ///< leaf
  Name,        ///< leaf
  TypeName,    ///< leaf
  Parameter,   ///< head: name; [TypeName], [expression]
  Pattern,     ///< of a loop: [Name of the index], Name or RowPattern
  RowPattern,  ///< Name...
  ForClause,   ///< Pattern, expression
  IfClause,    ///< expression
  Block,       ///< statements
  Binding,     ///< Name, expression; of a LetIn

  // Expressions
  Conditional,    ///< condition, value, [condition, value]..., value
  LetIn,          ///< Binding..., value
  Or,             ///< operands, two or more
  And,            ///< operands, two or more
  Not,            ///< operand
  Comparison,     ///< left, right; the operator is the right one's
  Interval,       ///< from, to
  Sum,            ///< operands, two or more; each but the first has its operator
  Product,        ///< likewise
  Negative,       ///< operand
  Power,          ///< base, exponent
  Postfix,        ///< operand, then Member or Index...
  Member,         ///< leaf `.name`
  Index,          ///< expression
  Reference,      ///< leaf: a path
  Call,           ///< head: path of the callee; arguments
  Argument,       ///< head: label; expression. A positional argument is its expression.
  Group,          ///< expression
  Triple,         ///< three expressions
  List,           ///< elements
  Comprehension,  ///< value, ForClause, [ForClause or IfClause]...
  Number,         ///< leaf
  String,         ///< leaf, with its quotes
  Color,          ///< leaf `#rgb` or `#rrggbb`
  True,           ///< leaf
  False,          ///< leaf
};

/// The operator before an operand of a Sum, Product or Comparison.
enum class Operator : std::uint8_t {
  None,
  Add,
  Subtract,
  Multiply,
  Divide,
  Equal,
  NotEqual,
  LessEqual,
  GreaterEqual,
  Less,
  Greater,
};

struct SyntaxNode {
  std::uint32_t begin = 0;  ///< bytes of the text, from the first to the last token
  std::uint32_t end = 0;
  std::uint32_t extent = 1;  ///< nodes of the subtree, this one included
  SyntaxKind kind = SyntaxKind::Error;
  Operator op = Operator::None;
  std::uint16_t head = 0;  ///< bytes of the label, name or path at the beginning

  Span span() const noexcept { return {begin, end}; }
};
static_assert(sizeof(SyntaxNode) == 16, "a million spheres have 15 million nodes");

using NodeIndex = std::uint32_t;

enum class CommentKind : std::uint8_t { Line, Block, Doc };

struct Comment {
  Span span;
  CommentKind kind = CommentKind::Line;
};

/// The nodes of one file in pre-order: a node's first child follows it, its next sibling is
/// `extent` nodes later. Node 0 is the File.
class SyntaxTree {
 public:
  SyntaxTree(const SourceFile& file, NodeBuffer<SyntaxNode> nodes, std::vector<Comment> comments)
      : file_(&file), nodes_(std::move(nodes)), comments_(std::move(comments)) {}

  const SourceFile& file() const noexcept { return *file_; }
  std::span<const SyntaxNode> nodes() const noexcept { return nodes_.span(); }
  const SyntaxNode& operator[](NodeIndex node) const noexcept { return nodes_[node]; }
  /// In the order of the text, never overlapping.
  std::span<const Comment> comments() const noexcept { return comments_; }

  std::string_view text(Span span) const noexcept { return file_->text(span); }
  Location location(Span span) const noexcept { return {file_, span}; }

 private:
  const SourceFile* file_;
  NodeBuffer<SyntaxNode> nodes_;
  std::vector<Comment> comments_;
};

/// Parses a file. Mistakes are reported and become Error nodes; the rest of the file is parsed as
/// usual. `file` must outlive the tree.
SyntaxTree parse(const SourceFile& file, DiagnosticSink& sink);

/// Parses a text that is one expression: the only child of the File.
SyntaxTree parse_expression(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
