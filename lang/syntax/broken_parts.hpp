#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// The parts of a text that are repaired: the statements of the file that have an error, each with
/// the one before it and the one after it, which may belong to the mistake. In the order of the
/// text, never overlapping. Each ends with the text or before the first token of a line. Thus the
/// repair of one mistake in a long text costs no more than in a short one.
///
/// `nodes` are those of the tree of `text`, and `errors` what was reported of it, both with the
/// bytes of `text`.
std::vector<Span> broken_parts(std::string_view text, std::span<const SyntaxNode> nodes,
                               const DiagnosticSink& errors);

/// The part of a text in which an object lacks its `}`, so that the statements after it, which
/// begin at `misplaced`, are in it: from the statement before the object to the first misplaced
/// one. None if the mistake may reach beyond it. Precondition: `misplaced` is not empty.
std::optional<Span> misplaced_part(std::string_view text, std::span<const SyntaxNode> nodes,
                                   std::span<const std::uint32_t> misplaced,
                                   const DiagnosticSink& errors);

}  // namespace sdlc::lang
