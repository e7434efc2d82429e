#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include <tree_sitter/api.h>

#include "lang/source/source.hpp"

/// The generated parser and its queries in libtree-sitter, as an editor uses them.
namespace sdlc::test {

struct Deleter {
  void operator()(TSParser* parser) const { ts_parser_delete(parser); }
  void operator()(TSTree* tree) const { ts_tree_delete(tree); }
  void operator()(TSQuery* query) const { ts_query_delete(query); }
  void operator()(TSQueryCursor* cursor) const { ts_query_cursor_delete(cursor); }
};

class SceneTree {
 public:
  explicit SceneTree(std::string_view text);
  /// The tree of a changed text, made of the one before: `replaced` of the old text became
  /// `size` bytes.
  SceneTree(const SceneTree& old, std::string_view text, lang::Span replaced, std::uint32_t size);

  std::string_view text() const noexcept { return text_; }
  TSNode root() const { return ts_tree_root_node(tree_.get()); }
  bool has_error() const { return ts_node_has_error(root()); }
  /// As an S-expression.
  std::string shape() const;
  /// The first ERROR or MISSING node as `line:column: kind`; empty if there is none.
  std::string first_error() const;

 private:
  void parse(const TSTree* old);

  std::string_view text_;
  std::unique_ptr<TSTree, Deleter> tree_;
};

struct Capture {
  lang::Span span;
  std::string_view name;  ///< of the query

  friend bool operator==(const Capture&, const Capture&) = default;
};

/// A file of editors/tree-sitter-sdlc/queries. Evaluates the predicates `match?` and `not-match?`
/// of lists of names: `^(a|b)$`.
class Query {
 public:
  explicit Query(const std::string& file);

  /// In the order of the text.
  std::vector<Capture> captures(const SceneTree& tree) const;
  /// The captures that the query names.
  std::vector<std::string_view> capture_names() const;

 private:
  struct Condition {
    std::uint32_t capture = 0;
    bool is_negated = false;
    std::unordered_set<std::string> words;
  };

  std::vector<Condition> conditions_of(std::uint32_t pattern) const;
  std::string_view string(std::uint32_t id) const;
  std::string_view capture_name(std::uint32_t id) const;
  bool holds(const TSQueryMatch& match, std::string_view text) const;

  std::unique_ptr<TSQuery, Deleter> query_;
  std::vector<std::vector<Condition>> conditions_;  ///< by pattern
};

}  // namespace sdlc::test
