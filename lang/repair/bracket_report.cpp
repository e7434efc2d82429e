#include <string>

#include <fmt/format.h>

#include "lang/repair/brackets.hpp"
#include "lang/repair/repair_report.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/text/brackets.hpp"

namespace sdlc::lang {
namespace {

class BracketReport : private RepairRound {
 public:
  BracketReport(const RepairContext& context, const TokenList& tokens)
      : RepairRound(context, tokens), is_scene_(context.file.format() == SourceFormat::Scene) {}

  std::vector<Edit> run(const std::vector<BracketFault>& faults) {
    for (std::size_t i = 0; i < faults.size();) {
      const BracketFault& fault = faults[i];
      switch (fault.kind) {
        case BracketFault::MissingOpen: missing_open(fault), ++i; break;
        case BracketFault::Surplus: surplus(fault), ++i; break;
        case BracketFault::Replaced: replaced(fault), ++i; break;
        case BracketFault::Swapped: swapped(fault), ++i; break;
        case BracketFault::MissingClose: i = missing_close(faults, i); break;
      }
    }
    return std::move(edits_);
  }

 private:
  using Faults = std::vector<BracketFault>;

  bool has_partner(const BracketFault& fault) const { return fault.partner < tokens_.size(); }

  void surplus(const BracketFault& fault) {
    const Span place = span_of(fault.token);
    const std::string_view bracket(&fault.bracket, 1);
    auto message = tokens_.is(fault.token, TokenClass::Open)
                       ? report(diag::unclosed, place, bracket)
                       : report(diag::unmatched, place, bracket);
    // Without the bracket a formula may be another than with its partner.
    if (!is_beside_operator(fault.token)) message.unsafe_fix(where(place), "");
    edit(place, " ");
  }

  void replaced(const BracketFault& fault) {
    const bool may_end_line = false;
    auto message = report_expected(fault.token, fmt::format("`{}`", fault.bracket), may_end_line);
    if (has_partner(fault)) {
      const bool closes = tokens_.is(fault.token, TokenClass::Close);
      message.label(where(span_of(fault.partner)), closes ? "opened here" : "closed here");
    }
    fix(message, false, span_of(fault.token), std::string(1, fault.bracket));
  }

  void swapped(const BracketFault& fault) {
    const Span first = span_of(fault.token), second = span_of(fault.token + 1);
    auto message = report_expected(fault.token, fmt::format("`{}`", fault.bracket), true);
    fix(message, false, first, std::string(text_of(second)));
    fix(message, false, second, std::string(text_of(first)));
  }

  void missing_open(const BracketFault& fault) {
    const std::uint32_t token = fault.token;
    // In JSON the first of several objects or values is what lacks it.
    const bool may_end_line = is_scene_ || tokens_.is(token - 1, TokenClass::Label);
    auto message = report_expected(token, fmt::format("`{}`", fault.bracket), may_end_line);
    if (has_partner(fault)) message.label(where(span_of(fault.partner)), "closed here");
    const std::uint32_t end = gap_before(token).end, begin = tokens_[token].begin;
    const bool is_block = is_scene_ && fault.bracket == '{';
    const bool follows_name = is_scene_ && tokens_.is_name(token - 1);
    const Span place =
        is_block || (follows_name && fault.bracket == '(') ? Span{end, end} : Span{begin, begin};
    const std::string bracket = (is_block ? " " : "") + std::string(1, fault.bracket);
    const bool is_certain_place =
        !is_scene_ || is_block || (has_partner(fault) && may_begin_at(token, fault.partner));
    if (is_certain_place) {
      message.unsafe_fix(where(is_block ? place : Span{begin, begin}), bracket);
    } else {
      message.help("open it where the part that it encloses begins");
    }
    // Arguments need a function: its name has run together with the first label.
    const bool lacks_name = is_scene_ && tokens_.is(token, TokenClass::Label) &&
                            tokens_.is(token - 1, TokenClass::Label);
    edit(place, lacks_name ? "f" + bracket : bracket);
  }

  /// Those missing at one place are one mistake, of parentheses or of blocks.
  std::size_t missing_close(const Faults& faults, std::size_t first) {
    const BracketFault& fault = faults[first];
    if (fault.token == tokens_.size()) return missing_at_end(faults, first);
    const bool is_brace = fault.bracket == '}';
    std::size_t end = first + 1;
    while (end < faults.size() && faults[end].kind == BracketFault::MissingClose &&
           faults[end].token == fault.token && (faults[end].bracket == '}') == is_brace) {
      ++end;
    }
    const RepairToken& token = tokens_[fault.token];
    const bool has_lines = is_multiline(fault);
    std::string brackets;
    for (std::size_t i = first; i < end; ++i) brackets += faults[i].bracket;
    if (is_scene_ && is_brace && token.is_first && has_lines) {
      missing_brace(fault, brackets);
      return end;
    }
    auto message = report_expected(fault.token, fmt::format("`{}`", fault.bracket), !has_lines);
    bool is_formula = false;
    for (std::size_t i = first; i < end; ++i) {
      message.label(where(span_of(faults[i].partner)), "opened here");
      is_formula = is_formula || !may_end_at(faults[i].partner, fault.token);
    }
    const std::string spaced = (is_scene_ && is_brace ? " " : "") + brackets;
    if (is_formula) {
      message.help("close it where the part that it encloses ends");
    } else {
      message.unsafe_fix(where(gap_before(fault.token)), spaced);
    }
    // In JSON a bracket that is lost with its line took the comma along.
    const bool lacks_comma =
        !is_scene_ && token.kind != TokenClass::Comma && token.kind != TokenClass::Close;
    const bool is_after_comma = !is_scene_ && follows_comma(fault);
    edit(gap_before(fault.token - is_after_comma),
         brackets + (lacks_comma && !is_after_comma ? "," : ""));
    return end;
  }

  bool follows_comma(const BracketFault& fault) const {
    return tokens_.is(fault.token - 1, TokenClass::Comma);
  }

  /// Whether what the bracket opened goes on in other lines.
  bool is_multiline(const BracketFault& fault) const {
    return has_partner(fault) && fault.partner + 1 < fault.token &&
           tokens_[fault.partner].line != tokens_[fault.token - 1].line &&
           (is_scene_ ? fault.bracket == '}' || tokens_[fault.partner + 1].is_first
                      : tokens_[fault.partner + 1].is_first);
  }

  void missing_brace(const BracketFault& fault, const std::string& brackets) {
    const std::uint32_t at = tokens_[fault.token].begin;
    auto message = report(diag::missing_brace, span_of(fault.token));
    message.label(where(span_of(fault.partner)), "opened here")
        .help("close the block before this line, or indent the lines that belong to it")
        .unsafe_fix(where({at, at}), "}\n" + std::string(tokens_[fault.partner].indent, ' '));
    edit(gap_before(fault.token), brackets);
  }

  /// Where the text ends too soon: one error, however many brackets are open.
  std::size_t missing_at_end(const Faults& faults, std::size_t first) {
    std::string closing;
    bool is_formula = false;
    for (std::size_t i = first; i < faults.size(); ++i) {
      closing += faults[i].bracket;
      is_formula = is_formula || !may_end_at(faults[i].partner, faults[i].token);
    }
    const Span place = end_of_text(faults[first]);
    auto message = report(diag::expected, place,
                          fmt::format("`{}`, found the end of the file", faults[first].bracket));
    for (std::size_t i = first; i < faults.size(); ++i) {
      message.label(where(span_of(faults[i].partner)), "opened here");
    }
    if (!is_formula) message.unsafe_fix(where(place), closing);
    edit(gap_before(tokens_.size()), closing);
    return faults.size();
  }

  /// Where the bracket would be: in the line after the last token, if its block has several lines.
  Span end_of_text(const BracketFault& fault) const {
    const RepairToken& last = tokens_[tokens_.size() - 1];
    const std::size_t line_end = tokens_.text().find('\n', last.end);
    const bool has_lines = tokens_[fault.partner].line < last.line &&
                           (!is_scene_ || fault.bracket == '}') &&
                           line_end != std::string_view::npos;
    const std::uint32_t at = has_lines ? static_cast<std::uint32_t>(line_end + 1) : last.end;
    return {at, at};
  }

  // Whether the place of a bracket is certain

  struct Inside {
    bool has_comma = false, has_operator = false;
  };

  bool is_operator(std::size_t i) const {
    return (tokens_.is(i, TokenClass::Operator) && !tokens_.is(i, "=")) ||
           is_one_of(tokens_.written(i), kJoints);
  }

  /// What is between the tokens, outside of inner brackets. The sign of a value is no operator.
  Inside inside(std::size_t begin, std::size_t end) const {
    Inside inside;
    int depth = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (tokens_.is(i, TokenClass::Open)) ++depth;
      if (tokens_.is(i, TokenClass::Close)) --depth;
      if (depth != 0) continue;
      inside.has_comma = inside.has_comma || tokens_.is(i, TokenClass::Comma);
      const bool is_sign = i == begin || tokens_.is(i - 1, TokenClass::Comma) || is_operator(i - 1);
      inside.has_operator = inside.has_operator || (is_operator(i) && !is_sign);
    }
    return inside;
  }

  /// Whether parentheses from the token to `close` can begin nowhere else: they hold one operand,
  /// or the values of a point or list.
  bool may_begin_at(std::size_t token, std::size_t close) const {
    const bool follows_operator = token > 0 && is_operator(token - 1);
    const auto [has_comma, has_operator] = inside(token, close);
    return !follows_operator && (has_comma || !has_operator);
  }

  /// Whether the parenthesis can only end at the token: the last value is no formula, of which any
  /// part may be the last.
  bool may_end_at(std::size_t open, std::size_t end) const {
    if (!is_scene_ || tokens_.is_bracket(open, '{')) return true;
    std::size_t first = open + 1;
    int depth = 0;
    for (std::size_t i = open + 1; i < end; ++i) {
      if (tokens_.is(i, TokenClass::Open)) ++depth;
      if (tokens_.is(i, TokenClass::Close)) --depth;
      const bool separates = tokens_.is(i, TokenClass::Comma) || tokens_.is(i, TokenClass::Label);
      if (depth == 0 && separates) first = i + 1;
    }
    return !inside(first, end).has_operator;
  }

  /// Whether an operator of the line is outside of this parenthesis.
  bool is_beside_operator(std::size_t index) const {
    const char bracket = tokens_[index].bracket;
    if (!is_scene_ || bracket == '{' || bracket == '}') return false;
    const auto ends = [&](std::size_t i) {
      return tokens_.is(i, TokenClass::Comma) || tokens_.is(i, TokenClass::Label) ||
             tokens_.is(i, "=");
    };
    std::size_t begin = index, end = index + 1;
    while (begin > 0 && !tokens_[begin].is_first && !ends(begin - 1)) --begin;
    while (end < tokens_.size() && !tokens_[end].is_first && !ends(end)) ++end;
    return inside(begin, index).has_operator || inside(index + 1, end).has_operator ||
           (index > begin && is_operator(index - 1)) || (index + 1 < end && is_operator(index + 1));
  }

  bool is_scene_;
};

}  // namespace

std::vector<Edit> repair_brackets(const RepairContext& context, const TokenList& tokens,
                                  const std::vector<BracketFault>& faults) {
  constexpr std::size_t kMaxFaults = 64;  // a text beyond that is no text
  if (faults.empty() || faults.size() > kMaxFaults) return {};
  return BracketReport(context, tokens).run(faults);
}

}  // namespace sdlc::lang
