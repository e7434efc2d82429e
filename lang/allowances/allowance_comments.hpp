#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A space or line end within these comments.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// A line comment that begins with `sdlc:`.
struct AllowanceComment {
  Span comment;
  std::vector<Span> codes;        ///< of `allow(W402, W4)`; empty if it has another form
  std::optional<Span> statement;  ///< what it applies to
};

/// Whether the text can have allowances: a quick check, without a tree.
bool may_have_allowances(std::string_view text) noexcept;

/// The allowances of a scene, in the order of the text. `stop` may be null.
std::vector<AllowanceComment> read_allowance_comments(const SyntaxTree& tree,
                                                      const StopRequest* stop);

}  // namespace sdlc::lang
