#pragma once

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/expectation.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// Thrown after a mistake was reported; the enclosing statement catches it and continues after it.
struct Reported {};
/// Thrown where the rest of the text cannot be read.
struct ParseAbandoned {};

/// The nodes of the growing tree, and the context that error messages need.
///
/// `text` is the file's text, a copy of the same length, or that of `repaired`. The nodes count the
/// bytes of `text`.
class TreeBuilder {
 public:
  TreeBuilder(const SourceFile& file, std::string_view text, const RepairedText* repaired,
              DiagnosticSink& sink)
      // One node per four bytes suffices for most texts. Unused memory is never touched.
      : file_(&file),
        text_(text),
        repaired_(repaired),
        sink_(&sink),
        nodes_(text.size() / 4 + 16) {}

  std::string_view text() const noexcept { return text_; }
  DiagnosticSink& sink() noexcept { return *sink_; }
  Location location(Span span) const noexcept { return {file_, in_file(span)}; }
  Span in_file(Span span) const noexcept {
    return repaired_ == nullptr ? span : repaired_->in_source(span);
  }
  /// Whether a repair has reported the place `at`.
  bool is_reported(std::uint32_t at) const noexcept {
    return repaired_ != nullptr && repaired_->is_reported(at);
  }
  /// Whether the bracket at `at` is missing in the file.
  bool is_added(std::uint32_t at) const noexcept {
    return repaired_ != nullptr && repaired_->is_added(at);
  }
  /// Whether a repair has changed the text of the span.
  bool is_repaired(Span span) const {
    return repaired_ != nullptr &&
           file_->text(in_file(span)) != text_.substr(span.begin, span.size());
  }
  std::uint32_t offset(const char* at) const noexcept {
    return static_cast<std::uint32_t>(at - text_.data());
  }

  std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(nodes_.size()); }
  SyntaxNode& node(NodeIndex index) noexcept { return nodes_[index]; }
  std::span<const SyntaxNode> nodes() const noexcept { return nodes_.span(); }

  void push(SyntaxKind kind, Span span) {
    constexpr std::size_t kNodesPerPoll = 1024;
    if (nodes_.size() % kNodesPerPoll == 0) sink_->stop_if_requested();
    nodes_.push({.begin = span.begin, .end = span.end, .kind = kind});
  }
  void truncate(NodeIndex size) noexcept { nodes_.truncate(size); }
  /// Ends the subtree of `index` with the last token.
  void close(NodeIndex index) noexcept {
    nodes_[index].extent = size() - index;
    nodes_[index].end = std::max(token_end_, nodes_[index].begin);
  }
  /// Makes the nodes from `first` on the children of a new node before them.
  void wrap(NodeIndex first, SyntaxKind kind);
  bool is_one_node(NodeIndex first) const noexcept {
    return first + 1 == nodes_.size() ||
           (first < nodes_.size() && first + nodes_[first].extent == nodes_.size());
  }

  void add_comment(Span span);

  /// The last token ends at `end`; the space after it ends at `space_end`.
  void end_token(std::uint32_t end) noexcept { token_end_ = end; }
  void end_space(std::uint32_t end) noexcept { space_end_ = end; }
  std::uint32_t token_end() const noexcept { return token_end_; }

  /// Marks `at` as the place of a mistake, with an empty Error after the last token.
  void mark_error(std::uint32_t at);
  std::uint32_t error_at() const noexcept { return error_at_; }

  /// Turns the last child of the last statement into an Error: the text after it may belong to it.
  void poison_last_statement();
  /// Turns a name before the mistake into an Error: it may be part of a longer expression.
  void poison_last_name();
  /// The same for the last part of the statement at `statement`, if the mistake follows it.
  void poison_last_part(NodeIndex statement);
  /// Turns all nodes that begin at `begin` or later into Errors.
  void poison_since(std::uint32_t begin);
  void set_last_statement(NodeIndex statement) noexcept { last_statement_ = statement; }

  NodeBuffer<SyntaxNode> take_nodes() { return std::move(nodes_); }
  std::vector<Comment> take_comments() { return std::move(comments_); }

  // The surroundings of the current place.
  std::uint32_t depth = 0;          ///< of nesting
  std::uint32_t brackets = 0;       ///< open in the current statement
  std::uint32_t blocks = 0;         ///< open
  std::uint32_t opener = 0;         ///< where the innermost bracket is opened
  std::uint32_t comment_begin = 0;  ///< where the outermost comment is opened
  std::uint32_t label_end = 0;      ///< of the last label
  bool in_object = false;           ///< the innermost block is an object's
  bool in_group = false;            ///< that object is a group
  bool in_head = false;             ///< in the list of a `for` or the condition of an `if`
  bool has_version = false;         ///< the file began with its version
  bool is_foreign = false;          ///< the text is of another version or format
  Operator op = Operator::None;     ///< the last one read
  /// Where the statements in objects begin that are not indented, inner ones first.
  std::vector<std::uint32_t> misplaced;

  static constexpr NodeIndex kNone = 0xFFFFFFFF;

 private:
  const SourceFile* file_;
  std::string_view text_;
  const RepairedText* repaired_;
  DiagnosticSink* sink_;
  NodeBuffer<SyntaxNode> nodes_;
  std::vector<Comment> comments_;
  std::uint32_t token_end_ = 0;
  std::uint32_t space_end_ = 0;
  std::uint32_t error_at_ = 0;
  NodeIndex last_statement_ = kNone;
};

/// A node that is open while its children are read. When a mistake ends it early it keeps those it
/// has.
class OpenNode {
 public:
  OpenNode(TreeBuilder& builder, SyntaxKind kind, std::uint32_t begin)
      : builder_(&builder), index_(builder.size()) {
    builder.push(kind, {begin, begin});
  }
  OpenNode(const OpenNode&) = delete;
  OpenNode& operator=(const OpenNode&) = delete;
  ~OpenNode() {
    if (is_open_) builder_->close(index_);
  }

  NodeIndex index() const noexcept { return index_; }
  void discard() noexcept {
    builder_->truncate(index_);
    is_open_ = false;
  }

 private:
  TreeBuilder* builder_;
  NodeIndex index_;
  bool is_open_ = true;
};

/// Operands that become one node when there are several. When a mistake ends them early they become
/// an Error.
class OpenChain {
 public:
  explicit OpenChain(TreeBuilder& builder) noexcept : builder_(&builder), first_(builder.size()) {}
  OpenChain(const OpenChain&) = delete;
  OpenChain& operator=(const OpenChain&) = delete;
  ~OpenChain() {
    if (is_open_) break_off();
  }

  [[gnu::always_inline]] void close(SyntaxKind kind) {
    is_open_ = false;
    if (!builder_->is_one_node(first_)) [[unlikely]]
      builder_->wrap(first_, kind);
  }
  void discard() noexcept {
    builder_->truncate(first_);
    is_open_ = false;
  }

 private:
  void break_off();

  TreeBuilder* builder_;
  NodeIndex first_;
  bool is_open_ = true;
};

// Wrong literals: each function reports the mistake and returns the end of the literal.

/// Precondition: a digit, or a point and a digit, at `begin`; no number of the language.
std::uint32_t diagnose_number(TreeBuilder& builder, std::uint32_t begin);
/// Precondition: `"` at `begin`; no string of the language.
std::uint32_t diagnose_string(TreeBuilder& builder, std::uint32_t begin);
/// Whether `color` has the right digits; if not, reports.
bool check_color(TreeBuilder& builder, Span color);

// Places where no rule of the grammar matches.

void diagnose_expected(TreeBuilder& builder, std::uint32_t at, Expectation expectation);
/// Where to continue after text that is no statement.
struct Resumption {
  std::uint32_t from = 0;
  bool is_statement = false;  ///< the next statement begins here; otherwise search for it
};
/// No statement begins at `at`; the resumption lies beyond.
Resumption diagnose_statement(TreeBuilder& builder, std::uint32_t at);
/// The file does not begin with `scene 1`; returns where its statements begin.
std::uint32_t diagnose_header(TreeBuilder& builder, std::uint32_t at);

}  // namespace sdlc::lang
