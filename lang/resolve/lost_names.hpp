#pragma once

#include <string_view>
#include <unordered_set>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// The names that unreadable statements probably declare. Uses of these names are not reported as
/// unknown.
class LostNames {
 public:
  /// `stop` may be null.
  explicit LostNames(const SyntaxTree& tree, const StopRequest* stop = nullptr);

  bool contains(std::string_view name) const;

 private:
  void read_skipped(std::string_view text, const StopRequest* stop);
  void read_alias(ast::Node import);

  std::unordered_set<std::string_view> names_;
  std::vector<std::string_view> merged_;  ///< words that begin or end with a name, or are one
};

}  // namespace sdlc::lang
