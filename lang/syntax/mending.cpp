#include "lang/syntax/mending.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/schema/type_names.hpp"
#include "lang/source/limits.hpp"
#include "lang/syntax/certainty.hpp"
#include "lang/syntax/foreign_signs.hpp"
#include "lang/syntax/foreign_words.hpp"
#include "lang/syntax/layout.hpp"
#include "lang/syntax/missing_marks.hpp"
#include "lang/syntax/vocabulary.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool ends_in_comment(std::string_view text) {
  TokenReader tokens(text);
  Token token = tokens.next();
  while (token.kind != TokenKind::End && token.kind != TokenKind::UnclosedComment) {
    token = tokens.next();
  }
  return token.kind == TokenKind::UnclosedComment;
}

/// Whether the token, a closing bracket, stands where a value should.
bool stands_for_value(std::string_view text, const std::vector<LayoutToken>& tokens,
                      std::uint32_t token) {
  if (token == 0 || tokens[token].kind != LayoutKind::Close) return false;
  const LayoutToken& last = tokens[token - 1];
  return last.kind == LayoutKind::Label || text.substr(last.begin, last.end - last.begin) == "=";
}

/// Tells what is wrong with words and brackets.
class Report {
 public:
  Report(const SourceFile& file, std::string_view text, const TokenLayout& layout,
         DiagnosticSink& sink)
      : file_(file), text_(text), layout_(layout), tokens_(layout.tokens), sink_(sink) {}

  void phrases() {
    for (const ForeignPhrase& phrase : layout_.foreign.phrases) {
      const Location place = where(phrase.span);
      auto report = phrase.kind == ForeignPhrase::Foreign
                        ? sink_.report(diag::foreign, place, phrase.message)
                    : phrase.kind == ForeignPhrase::Expected
                        ? sink_.report(diag::expected, place, phrase.message)
                        : sink_.report(diag::missing_version, place);
      report.help_if(phrase.help);
      for (const auto& [span, replacement] : phrase.edits) {
        add_fix(report, phrase.is_safe, where(span), replacement);
      }
    }
  }

  void words() {
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const LayoutToken& token = tokens_[i];
      if (token.meant.empty() || layout_.foreign.is_told[i]) continue;
      const Span span{token.begin, token.end};
      const std::string_view written = text_.substr(span.begin, span.size());
      if (written == "=") {
        equals(token);
      } else if (token.kind == LayoutKind::Operator) {
        sign(written, token.meant, span);
      } else if (token.kind != LayoutKind::Close) {
        // What closes a pair of the wrong kind goes without saying.
        auto report = sink_.report(diag::expected, where(span),
                                   fmt::format("`{}`, found `{}`", token.meant, written));
        if (token.kind != LayoutKind::Open) report.suggest(token.meant);
      }
    }
  }

  void brackets(const std::vector<BracketFault>& faults) {
    for (std::size_t i = 0; i < faults.size(); ++i) {
      const BracketFault& fault = faults[i];
      switch (fault.kind) {
        case BracketFault::MissingMark: missing_mark(fault); break;
        case BracketFault::MissingThird: missing_third(fault); break;
        case BracketFault::Swapped: swapped(fault); break;
        case BracketFault::Surplus:
          // Of a bracket in another's place it has been told what it should be.
          if (i == 0 || faults[i - 1].token != fault.token) surplus(fault);
          break;
        case BracketFault::MissingOpen: missing_opening(fault); break;
        case BracketFault::MissingClose:
          if (fault.token == tokens_.size()) return missing_at_end(faults, i);
          i += missing_closing(faults, i) - 1;
          break;
      }
    }
  }

 private:
  Location where(Span span) const {
    const auto size = static_cast<std::uint32_t>(file_.text().size());
    return {&file_, {std::min(span.begin, size), std::min(span.end, size)}};
  }
  Span span_of(std::uint32_t token) const { return {tokens_[token].begin, tokens_[token].end}; }
  Span gap_before(std::uint32_t token) const {
    const std::uint32_t end = token == 0 ? 0 : tokens_[token - 1].end;
    return {end, end};
  }
  void label_opener(DiagnosticBuilder& report, const BracketFault& fault) const {
    if (fault.partner != BracketFault::kNone) {
      report.label(where(span_of(fault.partner)), "opened here");
    }
  }

  void equals(const LayoutToken& token) {
    const Span span{token.begin, token.end};
    auto report = sink_.report(diag::foreign, where(span), "=");
    if (token.meant == "==") {
      report.help("write `==` to compare").unsafe_fix(where(span), "==");
    } else {
      const LayoutToken& name = *(&token - 1);
      const std::string_view what = token.is_call ? "an argument" : "a property";
      report.help(fmt::format("{} is `name: value`", what));
      const bool is_known = is_property_name(text_.substr(name.begin, name.end - name.begin));
      add_fix(report, is_known, where({name.end, token.end}), ":");
    }
  }

  void sign(std::string_view written, std::string_view meant, Span span) {
    const ForeignSign& sign = *find_foreign_sign(written);
    auto report = sink_.report(diag::foreign, where(span), written);
    if (meant == "," && sign.deletes) {
      report.help("commas stand between values").unsafe_fix(where(span), ",");
    } else {
      const bool is_certain =
          sign.deletes ? ends_statement(text_, span.begin) : is_certain_sign(text_, span);
      report.help_if(sign.help);
      if (is_certain || written != "!")
        add_fix(report, is_certain, where(span), std::string(sign.replacement));
    }
  }

  void missing_mark(const BracketFault& fault) {
    const LayoutToken& opener = tokens_[fault.partner];
    const bool is_list = opener.bracket == '[';
    const bool is_type = fault.bracket == ':' && opener.is_head;
    const std::string_view words = is_type                            ? "`:` and a type"
                                   : fault.bracket == ':'             ? "`:` or `,`"
                                   : is_list                          ? "`,` or `]`"
                                   : opener.is_call || opener.is_head ? "`,` or `)`"
                                                                      : "`)`";
    auto report = expected(fault.token, words);
    const Location gap = where(gap_before(fault.token));
    const std::string_view first = text_of(fault.token - 1);
    if (is_type) {
      report.help("a parameter is `name: type`");
      add_fix(report, !is_type_name(first), gap, ":");
      return;
    }
    if (opener.is_head && (is_type_name(first) || find_foreign_word(first) != nullptr)) {
      report.help("a parameter is `name: type`");
      return;
    }
    if (fault.bracket == ':') {
      report.help("an argument is `name: value`");
      if (is_property_name(first)) report.unsafe_fix(gap, ":");
      return;
    }
    report.label(where(span_of(fault.partner)), "opened here").help("commas stand between values");
    add_fix(report, is_certain_comma(fault), gap, ",");
  }

  /// Whether only a comma can be missing: before the next label of a call, or between numbers of
  /// which there are three.
  bool is_certain_comma(const BracketFault& fault) const {
    const LayoutToken &opener = tokens_[fault.partner], &token = tokens_[fault.token];
    if (opener.is_call) return token.kind == LayoutKind::Label && ends_value(fault.token - 1);
    if (opener.bracket != '(') return false;
    std::uint32_t numbers = 0;
    for (std::uint32_t i = fault.partner + 1; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == LayoutKind::Close) return numbers == 3;
      if (tokens_[i].kind == LayoutKind::Comma || text_of(i) == "-") continue;
      if (!is_number(i) || ++numbers > 3) return false;
    }
    return false;
  }

  /// Whether no value goes on after the token, and none is a mere name.
  bool ends_value(std::uint32_t index) const {
    const LayoutToken& token = tokens_[index];
    if (token.kind == LayoutKind::Close) return true;
    if (token.kind != LayoutKind::Value) return false;
    const bool is_literal =
        is_number(index) || text_[token.begin] == '"' || text_[token.begin] == '#';
    return is_literal || tokens_[index - 1].kind == LayoutKind::Label;
  }

  bool is_number(std::uint32_t index) const {
    const std::string_view text = text_of(index);
    return tokens_[index].kind == LayoutKind::Value && !text.empty() &&
           (is_digit(text[0]) || text[0] == '.');
  }
  std::string_view text_of(std::uint32_t index) const {
    return text_.substr(tokens_[index].begin, tokens_[index].end - tokens_[index].begin);
  }

  static void add_fix(DiagnosticBuilder& report, bool is_safe, Location place, std::string text) {
    is_safe ? report.fix(place, std::move(text)) : report.unsafe_fix(place, std::move(text));
  }

  void missing_third(const BracketFault& fault) {
    expected(fault.token, "`,` and a third value: a point has three");
  }

  /// Another bracket stands in its place.
  void replaced(const BracketFault& fault) {
    auto report = expected(fault.token, fmt::format("`{}`", fault.bracket), true);
    label_opener(report, fault);
    report.unsafe_fix(where(span_of(fault.token)), std::string(1, fault.bracket));
  }

  void swapped(const BracketFault& fault) {
    const Span first = span_of(fault.token), second = span_of(fault.token + 1);
    auto report = expected(fault.token, fmt::format("`{}`", fault.bracket));
    report.unsafe_fix(where(first), std::string(text_.substr(second.begin, second.size())))
        .unsafe_fix(where(second), std::string(text_.substr(first.begin, first.size())));
  }

  void surplus(const BracketFault& fault) {
    const Location place = where(span_of(fault.token));
    const bool opens = fault.bracket == '(' || fault.bracket == '[' || fault.bracket == '{';
    const std::string_view bracket(&fault.bracket, 1);
    auto report = opens ? sink_.report(diag::unclosed, place, bracket)
                        : sink_.report(diag::unmatched, place, bracket);
    // Without it a formula may be another one than with its partner.
    if (!is_beside_operator(fault.token)) report.unsafe_fix(place, "");
  }

  /// Whether an operator of its line is outside of this parenthesis.
  bool is_beside_operator(std::uint32_t index) const {
    if (tokens_[index].bracket == '{' || tokens_[index].bracket == '}') return false;
    const auto ends = [&](std::uint32_t i) {
      return tokens_[i].kind == LayoutKind::Comma || tokens_[i].kind == LayoutKind::Label ||
             text_of(i) == "=";
    };
    std::uint32_t begin = index, end = index + 1;
    while (begin > 0 && !tokens_[begin].is_first && !ends(begin - 1)) --begin;
    while (end < tokens_.size() && !tokens_[end].is_first && !ends(end)) ++end;
    return inside(begin, index).has_operator || inside(index + 1, end).has_operator ||
           (index > begin && is_operator(index - 1)) || (index + 1 < end && is_operator(index + 1));
  }

  /// A bracket is missing in front of the token: at the end of the line before it, if it is the
  /// first of its own.
  DiagnosticBuilder expected(const BracketFault& fault) {
    return expected(fault.token, fmt::format("`{}`", fault.bracket), has_lines(fault));
  }

  /// What is opened at the end of a line is closed in a line of its own.
  bool has_lines(const BracketFault& fault) const {
    return fault.kind == BracketFault::MissingClose && fault.partner != BracketFault::kNone &&
           fault.partner + 1 < fault.token && tokens_[fault.partner + 1].is_first;
  }

  DiagnosticBuilder expected(std::uint32_t index, std::string_view words, bool has_lines = false) {
    const LayoutToken& token = tokens_[index];
    const bool ends_line = token.is_first && index > 0 && !has_lines;
    const std::string_view found = text_.substr(token.begin, token.end - token.begin);
    const std::string what = ends_line ? "the end of the line" : fmt::format("`{}`", found);
    return sink_.report(diag::expected, where(ends_line ? gap_before(index) : span_of(index)),
                        fmt::format("{}, found {}", words, what));
  }

  void missing_opening(const BracketFault& fault) {
    auto report = expected(fault);
    if (fault.partner != BracketFault::kNone) {
      report.label(where(span_of(fault.partner)), "closed here");
    }
    const std::uint32_t at = gap_before(fault.token).end;
    if (fault.bracket == '{') {
      report.unsafe_fix(where({at, at}), " {");
    } else if (fault.partner != BracketFault::kNone && may_begin_at(fault.token, fault.partner)) {
      const std::uint32_t begin = tokens_[fault.token].begin;
      report.unsafe_fix(where({begin, begin}), std::string(1, fault.bracket));
    } else {
      report.help("open it where the part that it encloses begins");
    }
  }

  /// Whether parentheses from the token to `close` can begin nowhere else: they hold one operand,
  /// or the values of a point or list that begins here.
  bool may_begin_at(std::uint32_t token, std::uint32_t close) const {
    const bool is_after_operator = token > 0 && is_operator(token - 1);
    const auto [has_comma, has_operator] = inside(token, close);
    return has_comma ? !is_after_operator : !has_operator && !is_after_operator;
  }

  /// Whether the parenthesis or bracket opened at `open` can only be closed before `end`: the last
  /// value in it is no formula, of which any part may be the last.
  bool may_end_at(std::uint32_t open, std::uint32_t end) const {
    std::uint32_t first = open + 1;
    int depth = 0;
    for (std::uint32_t i = open + 1; i < end; ++i) {
      if (tokens_[i].kind == LayoutKind::Open) ++depth;
      if (tokens_[i].kind == LayoutKind::Close) --depth;
      const bool separates =
          tokens_[i].kind == LayoutKind::Comma || tokens_[i].kind == LayoutKind::Label;
      if (depth == 0 && separates) first = i + 1;
    }
    return !inside(first, end).has_operator;
  }

  struct Inside {
    bool has_comma = false, has_operator = false;
  };
  /// What is between the tokens, inner brackets left out. The sign of a value is no operator.
  Inside inside(std::uint32_t begin, std::uint32_t end) const {
    Inside inside;
    int depth = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
      if (tokens_[i].kind == LayoutKind::Open) ++depth;
      if (tokens_[i].kind == LayoutKind::Close) --depth;
      if (depth != 0) continue;
      inside.has_comma = inside.has_comma || tokens_[i].kind == LayoutKind::Comma;
      const bool is_sign =
          i == begin || tokens_[i - 1].kind == LayoutKind::Comma || is_operator(i - 1);
      inside.has_operator = inside.has_operator || (is_operator(i) && !is_sign);
    }
    return inside;
  }
  bool is_operator(std::uint32_t index) const {
    return (tokens_[index].kind == LayoutKind::Operator && text_of(index) != "=") ||
           is_one_of(text_of(index), kJoints);
  }

  /// Those missing at one place are one mistake, of parentheses or of blocks; how many they are.
  std::size_t missing_closing(const std::vector<BracketFault>& faults, std::size_t first) {
    const BracketFault& fault = faults[first];
    const bool is_block = fault.bracket == '}';
    std::size_t end = first + 1;
    while (end < faults.size() && faults[end].kind == BracketFault::MissingClose &&
           faults[end].token == fault.token && (faults[end].bracket == '}') == is_block) {
      ++end;
    }
    const bool is_one_line = fault.partner != BracketFault::kNone &&
                             tokens_[fault.partner].line == tokens_[fault.token - 1].line;
    const bool is_replaced = end < faults.size() && faults[end].token == fault.token &&
                             faults[end].kind == BracketFault::Surplus;
    if (is_replaced) {
      replaced(fault);
      return end - first;
    }
    if (is_block && tokens_[fault.token].is_first && !is_one_line) {
      missing_brace(fault);
      return end - first;
    }
    auto report = expected(fault);
    std::string brackets = is_block ? " " : "";
    for (std::size_t i = first; i < end; ++i) {
      label_opener(report, faults[i]);
      brackets += faults[i].bracket;
    }
    if (is_block || fault.partner == BracketFault::kNone ||
        may_end_at(fault.partner, fault.token)) {
      report.unsafe_fix(where(gap_before(fault.token)), brackets);
    } else {
      report.help("close it where the part that it encloses ends");
    }
    return end - first;
  }

  void missing_brace(const BracketFault& fault) {
    const std::uint32_t at = tokens_[fault.token].begin;
    auto report = sink_.report(diag::missing_brace, where(span_of(fault.token)));
    label_opener(report, fault);
    const std::uint32_t indent =
        fault.partner == BracketFault::kNone ? 0 : tokens_[fault.partner].indent;
    report.help("close the block in front of this line, or indent what belongs to it")
        .unsafe_fix(where({at, at}), "}\n" + std::string(indent, ' '));
  }

  /// Where the text ends too soon: one error, however many brackets are open.
  void missing_at_end(const std::vector<BracketFault>& faults, std::size_t first) {
    const BracketFault& fault = faults[first];
    std::string closing;
    for (std::size_t i = first; i < faults.size(); ++i) closing += faults[i].bracket;
    const Span place = end_of_text(fault);
    auto report = sink_.report(diag::expected, where(place),
                               fmt::format("`{}`, found the end of the file", fault.bracket));
    bool is_one_place = true;
    for (std::size_t i = first; i < faults.size(); ++i) {
      label_opener(report, faults[i]);
      const bool is_formula = faults[i].bracket != '}' &&
                              faults[i].partner != BracketFault::kNone &&
                              !may_end_at(faults[i].partner, faults[i].token);
      is_one_place = is_one_place && !is_formula;
    }
    if (is_one_place) report.unsafe_fix(where(place), closing);
  }

  /// Where the bracket would stand: in the line behind the last token, if its block has lines of
  /// its own.
  Span end_of_text(const BracketFault& fault) const {
    const std::uint32_t end = tokens_.back().end;
    const bool has_lines = fault.bracket == '}' && fault.partner != BracketFault::kNone &&
                           tokens_[fault.partner].line < tokens_.back().line;
    const std::size_t line_end = text_.find('\n', end);
    if (!has_lines || line_end == std::string_view::npos) return {end, end};
    const auto next = static_cast<std::uint32_t>(line_end + 1);
    return {next, next};
  }

  const SourceFile& file_;
  std::string_view text_;
  const TokenLayout& layout_;
  const std::vector<LayoutToken>& tokens_;
  DiagnosticSink& sink_;
};

/// Leaves nothing to mend but signs and phrases, of which everyone knows what they mean.
void keep_certain(TokenLayout& layout) {
  for (std::size_t i = 0; i < layout.tokens.size(); ++i) {
    LayoutToken& token = layout.tokens[i];
    if (token.kind != LayoutKind::Operator && !layout.foreign.is_told[i]) token.meant = {};
  }
}

}  // namespace

std::optional<MendedText> mend(const SourceFile& file, std::string_view text, MendOptions options,
                               DiagnosticSink& sink) {
  if (text.size() > kMaxMendedText) return std::nullopt;
  TokenLayout layout = scan_layout(text);
  const std::vector<LayoutToken>& tokens = layout.tokens;
  BracketRepair repair;
  if (options.is_certain) {
    keep_certain(layout);
  } else if (options.may_mismatch || !has_matching_brackets(tokens)) {
    repair = repair_brackets(tokens);
  }
  const bool has_words = std::any_of(tokens.begin(), tokens.end(),
                                     [](const LayoutToken& token) { return !token.meant.empty(); });
  const bool is_cut_off = ends_in_comment(text);
  std::erase_if(repair.faults, [&](const BracketFault& fault) {
    // What a comment swallowed may have closed them.
    if (fault.token == tokens.size()) return is_cut_off;
    // A bracket in the place of a value says less than that the value is missing.
    return fault.kind == BracketFault::Surplus && stands_for_value(text, tokens, fault.token);
  });
  if (!options.is_certain) find_missing_marks(text, tokens, repair);
  if (repair.faults.empty() && !has_words) return std::nullopt;
  Report report(file, text, layout, sink);
  report.phrases();
  report.words();
  report.brackets(repair.faults);
  return MendedText(text, tokens, repair);
}

}  // namespace sdlc::lang
