#include "lang/syntax/broken_parts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "lang/text/brackets.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// A child of the File.
struct Statement {
  std::uint32_t begin = 0;
  bool is_broken = false;
};

std::vector<Statement> statements_of(std::span<const SyntaxNode> nodes) {
  std::vector<Statement> statements;
  for (std::size_t i = 1; i < nodes.size(); i += nodes[i].extent) {
    const bool is_broken =
        std::ranges::any_of(nodes.subspan(i, nodes[i].extent),
                            [](const SyntaxNode& node) { return node.kind == SyntaxKind::Error; });
    statements.push_back({nodes[i].begin, is_broken});
  }
  return statements;
}

/// Marks the statements with an error, or after which one is. False if an error is before the
/// first, or may be anywhere.
bool mark(std::vector<Statement>& statements, const DiagnosticSink& errors) {
  if (statements.empty() || !errors.not_kept().empty()) return false;
  for (const Diagnostic& error : errors.diagnostics()) {
    auto after =
        std::ranges::upper_bound(statements, error.where.span.begin, {}, &Statement::begin);
    if (after == statements.begin()) return false;
    std::prev(after)->is_broken = true;
  }
  return !statements.front().is_broken;
}

/// The broken statements with their neighbours.
std::vector<Span> parts_with(const std::vector<Statement>& statements, std::string_view text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  const auto begins_line = [&](std::size_t i) {
    return is_first_of_line(text, statements[i].begin);
  };
  std::vector<Span> parts;
  for (std::size_t i = 1; i < statements.size(); ++i) {
    if (!statements[i].is_broken) continue;
    std::size_t first = i - 1, end = i + 2;
    while (first > 0 && !begins_line(first)) --first;
    while (end < statements.size() && !begins_line(end)) ++end;
    const Span part{first == 0 ? 0 : statements[first].begin,
                    end < statements.size() ? statements[end].begin : size};
    if (!parts.empty() && part.begin <= parts.back().end) {
      parts.back().end = std::max(parts.back().end, part.end);
    } else {
      parts.push_back(part);
    }
  }
  return parts;
}

/// Whether each bracket of the part that is opened is closed, and no other.
bool has_pairs(std::string_view text, Span part) {
  std::string open;
  TokenReader tokens(text.substr(0, part.end), part.begin);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    const char bracket = text[token.span.begin];
    if (token.kind == TokenKind::Open) open += bracket;
    if (token.kind != TokenKind::Close) continue;
    if (open.empty() || !is_bracket_pair(open.back(), bracket)) return false;
    open.pop_back();
  }
  return open.empty();
}

}  // namespace

std::vector<Span> broken_parts(std::string_view text, std::span<const SyntaxNode> nodes,
                               const DiagnosticSink& errors) {
  std::vector<Statement> statements = statements_of(nodes);
  if (!mark(statements, errors)) return {{0, static_cast<std::uint32_t>(text.size())}};
  std::vector<Span> parts = parts_with(statements, text);
  // A block that is not opened looks like statements without an error, to the bracket that closes
  // it.
  if (!std::ranges::all_of(parts, [&](Span part) { return has_pairs(text, part); })) {
    parts = {{parts.front().begin, parts.back().end}};
  }
  return parts;
}

std::optional<Span> misplaced_part(std::string_view text, std::span<const SyntaxNode> nodes,
                                   std::span<const std::uint32_t> misplaced,
                                   const DiagnosticSink& errors) {
  std::vector<std::uint32_t> begins(misplaced.begin(), misplaced.end());
  std::ranges::sort(begins);
  const std::vector<Statement> statements = statements_of(nodes);
  auto first = std::ranges::upper_bound(statements, begins.front(), {}, &Statement::begin);
  if (first == statements.begin() || !errors.not_kept().empty()) return std::nullopt;
  // The object and the statement before it, which may belong to the mistake.
  for (int before = 0; before < 2 && first != statements.begin(); ++before) {
    do {
      --first;
    } while (first != statements.begin() && !is_first_of_line(text, first->begin));
  }
  const auto end = std::ranges::find_if(begins.begin() + 1, begins.end(),
                                        [&](std::uint32_t at) { return text[at - 1] == '\n'; });
  if (end == begins.end()) return std::nullopt;
  // What is reported at the end of the text follows from the missing bracket.
  const std::size_t text_end = text.find_last_not_of(" \t\r\n") + 1;
  const auto is_beyond = [&](const Diagnostic& error) {
    return error.where.span.begin >= *end && error.where.span.begin < text_end;
  };
  const Span misplaced_one{begins.front(), *end};
  const Span rest{*end, static_cast<std::uint32_t>(text.size())};
  const bool is_mistake_before = !std::ranges::any_of(errors.diagnostics(), is_beyond) &&
                                 has_pairs(text, misplaced_one) && has_pairs(text, rest);
  if (!is_mistake_before) return std::nullopt;
  return Span{first == statements.begin() ? 0 : first->begin, *end};
}

}  // namespace sdlc::lang
