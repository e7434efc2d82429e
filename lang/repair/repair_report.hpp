#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/repaired_text.hpp"
#include "lang/repair/scene_repair.hpp"
#include "lang/repair/tokens.hpp"

namespace sdlc::lang {

inline DiagnosticBuilder& add_fix(DiagnosticBuilder& report, bool is_safe, Location where,
                                  std::string text) {
  return is_safe ? report.fix(where, std::move(text)) : report.unsafe_fix(where, std::move(text));
}

/// One round of repairs: what it reports of the file, and the edits of the text that follow.
class RepairRound {
 public:
  RepairRound(const RepairContext& context, const TokenList& tokens)
      : tokens_(tokens), context_(context) {}

 protected:
  void stop_if_requested() const { context_.sink.stop_if_requested(); }

  template <typename... Args>
  DiagnosticBuilder report(const DiagnosticKind<Args...>& kind, Span span,
                           const std::type_identity_t<Args>&... args) {
    return context_.sink.report(kind, where(span), args...);
  }
  /// "expected …, found …" at the token: at the end of the line before, if it is the first of its
  /// own and the line before is where something is missing.
  DiagnosticBuilder report_expected(std::size_t token, std::string_view what, bool may_end_line);

  /// An edit that a report offers as its fix.
  void fix(DiagnosticBuilder& report, bool is_safe, Span span, std::string text) {
    add_fix(report, is_safe, where(span), text);
    edit(span, std::move(text));
  }
  void edit(Span span, std::string text) { edits_.push_back({span, std::move(text)}); }

  Location where(Span span) const;
  /// Whether the token begins with what an earlier round has added.
  bool is_added(std::size_t token) const { return context_.text.is_added(tokens_[token].begin); }
  Span span_of(std::size_t token) const { return tokens_[token].span(); }
  Span span_of(std::size_t first, std::size_t last) const {
    return {tokens_[first].begin, tokens_[last].end};
  }
  /// The empty span after the token before.
  Span gap_before(std::size_t token) const {
    const std::uint32_t end = token == 0 ? context_.text.part().begin : tokens_[token - 1].end;
    return {end, end};
  }
  std::string_view text_of(Span span) const {
    return tokens_.text().substr(span.begin, span.size());
  }

  const TokenList& tokens_;
  const RepairContext& context_;
  std::vector<Edit> edits_;
};

}  // namespace sdlc::lang
