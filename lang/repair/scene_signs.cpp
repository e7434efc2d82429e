#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/property_names.hpp"
#include "lang/repair/scene_round.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

/// Operators, quotes, comments and separated units as other languages write them.
class Signs : private SceneRound {
 public:
  using SceneRound::SceneRound;

  std::vector<Edit> run() {
    for (const Span comment : tokens_.foreign_comments()) foreign_comment(comment);
    walk([this] {
      if (tokens_.is_number(i_)) {
        separate_unit();
      } else if (tokens_.is(i_, "=")) {
        equals();
      } else if (tokens_.is(i_, TokenClass::Operator)) {
        sign();
      }
    });
    return std::move(edits_);
  }

 private:
  /// Suppresses what the parser would report of the same place.
  void leave(Span span) { context_.text.note_reported(where(span).span); }

  bool is_joint(std::size_t i) const {
    return tokens_.is_word(i) && is_one_of(tokens_.written(i), kJoints);
  }
  bool follows_value() const {
    const bool ends_value = tokens_.is(i_ - 1, TokenClass::Value) ||
                            tokens_.is_bracket(i_ - 1, ')') || tokens_.is_bracket(i_ - 1, ']');
    return i_ > 0 && ends_value && tokens_.is_same_line(i_) && !is_joint(i_ - 1);
  }
  bool precedes_value() const {
    const std::size_t next = i_ + 1;
    if (!tokens_.is_same_line(next)) return false;
    return tokens_.is(next, TokenClass::Value) || tokens_.is_bracket(next, '(') ||
           tokens_.is_bracket(next, '[') || tokens_.is(next, "-") || tokens_.is(next, "!");
  }

  // Comments

  void foreign_comment(Span comment) {
    const std::string_view text = text_of(comment);
    const Span mark{comment.begin, comment.begin + (text[0] == '#' ? 1 : 2)};
    auto message = report(diag::foreign, mark, text_of(mark));
    const std::string_view rest = text.substr(mark.size());
    if (rest.starts_with("define ") || rest.starts_with("declare ") || rest.starts_with("local ")) {
      message.help("a value gets its name by `let name = value`");
    } else {
      message.help("comments begin with `//`");
      const bool is_shebang = rest.starts_with('!') && comment.begin == 0;
      const bool is_text = rest.empty() || rest[0] == ' ' || rest[0] == '\t' || rest[0] == '\r';
      if (is_text || is_shebang) message.fix(where(mark), "//");
    }
    edit(mark, "//");
  }

  // Units

  /// `5 m`, `40 °` and `3 px`
  void separate_unit() {
    const std::size_t unit = i_ + 1;
    const char last = tokens_.written(i_).back();
    if (!tokens_.is_same_line(unit) || (!is_digit(last) && last != '.')) return;
    const bool is_degree = tokens_.is(unit, "°");
    const std::string_view written = is_degree ? "deg" : tokens_.written(unit);
    const bool is_unit = is_one_of(written, kUnits) && (is_degree || !tokens_.is_joined(unit));
    if (!is_unit) return unknown_unit(unit);
    const bool is_remainder =
        written == "%" && tokens_.is(unit + 1, TokenClass::Value) && tokens_.is_same_line(unit + 1);
    const bool is_name = tokens_.is_bracket(unit + 1, '(') || tokens_.begins_object(unit);
    if (!is_degree && (is_remainder || is_name)) return;
    auto message = is_degree ? report(diag::foreign, span_of(unit), "°")
                             : report(diag::separate_unit, span_of(i_, unit), written);
    const std::string fixed = fmt::format("{}{}", tokens_.written(i_), written);
    const bool is_safe = is_degree || (ends_value_with(unit, written) && !may_be_name(written));
    add_fix(message, is_safe, where(span_of(i_, unit)), fixed);
    edit({tokens_[i_].end, tokens_[unit].end}, std::string(written));
    skip_to(unit);
  }

  void unknown_unit(std::size_t unit) {
    const bool is_end =
        tokens_.is(unit + 1, TokenClass::Comma) || tokens_.is_bracket(unit + 1, '}');
    if (!in_block() || !tokens_.is_name(unit) || tokens_.is_joined(unit) || !is_end) return;
    report(diag::foreign, span_of(unit), tokens_.written(unit))
        .help(fmt::format("units are {}", fmt::join(kUnits, ", ")));
    edit(span_of(unit), "");
    skip_to(unit);
  }

  /// Whether the number can only be the end or an operand of a value: `2 s 3` lacks more.
  bool ends_value_with(std::size_t unit, std::string_view written) const {
    const std::size_t next = unit + 1;
    if (tokens_.is(next, TokenClass::Value) && !tokens_[next].is_first) {
      return is_joint(next) || is_one_of(tokens_.written(next), kStatementWords) ||
             tokens_.begins_object(next);
    }
    if (tokens_.is(next, TokenClass::Open) && !tokens_[next].is_first) return false;
    return written != "%" || !(tokens_.is(next, "+") || tokens_.is(next, "-"));
  }

  /// Whether the text has the unit as a name: only those of one letter are likely.
  bool may_be_name(std::string_view unit) const {
    if (unit != "m" && unit != "s") return false;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      const bool is_it =
          tokens_.is(i, TokenClass::Label) ? tokens_.label(i) == unit : tokens_.is(i, unit);
      if (is_it && (i == 0 || !tokens_.is_number(i - 1))) return true;
    }
    return false;
  }

  // `=`

  /// `=` where nothing is defined.
  void equals() {
    const bool follows_name = i_ > 0 && tokens_.is_name(i_ - 1);
    const bool begins_argument =
        i_ > 1 && (tokens_.is(i_ - 2, TokenClass::Comma) || tokens_.is_bracket(i_ - 2, '('));
    const bool is_argument = follows_name && inside() == Inside::Arguments && begins_argument;
    // `let a = 1, b = 2 in a + b` goes on after its commas.
    const bool is_binding = in_let() && follows_name && i_ > 1 &&
                            (tokens_.is(i_ - 2, "let") || tokens_.is(i_ - 2, TokenClass::Comma));
    if (is_binding) return;
    const bool is_statement = follows_name && tokens_.may_begin_statement(i_ - 1);
    if (in_condition() && !is_argument) {
      auto message = report(diag::foreign, span_of(i_), "=");
      message.help("write `==` to compare");
      fix(message, false, span_of(i_), "==");
    } else if (is_argument || (is_statement && in_object())) {
      auto message = report(diag::foreign, span_of(i_), "=");
      message.help(fmt::format("{} is `name: value`", is_argument ? "an argument" : "a property"));
      fix(message, is_property_name(tokens_.written(i_ - 1)),
          {tokens_[i_ - 1].end, tokens_[i_].end}, ":");
    } else if (is_statement && in_block()) {
      auto message = report(diag::foreign, span_of(i_), "=");
      message.help("a value gets its name by `let name = value`");
      const std::uint32_t name = tokens_[i_ - 1].begin;
      message.unsafe_fix(where({name, name}), "let ");
      leave(span_of(i_ - 1, i_));
    } else if (inside() == Inside::Value || inside() == Inside::Arguments) {
      report(diag::foreign, span_of(i_), "=")
          .help("write `==` to compare, `:` for a property or an argument");
      edit(span_of(i_), "==");
    }
  }

  // Other signs

  void sign() {
    const std::string_view written = tokens_.written(i_);
    if (written == "'") return single_quotes();
    const auto habit = find_habit(HabitPlace::Sign, written);
    if (!habit) return;
    if (written == ";") return semicolon(habit->help);
    const Span span = span_of(i_);
    auto message = report(diag::foreign, span, written);
    message.help_if(habit->help);
    if (habit->meant == "\"") return typographic_quote(message);
    if (written == "%") suggest_remainder(message);
    if (habit->meant.empty() || habit->meant == "deg") return leave(span);
    if (written == "!" && follows_value()) return edit(span, " ");  // 5!
    const bool is_certain = is_certain_sign();
    if (is_certain || written != "!") {
      add_fix(message, is_certain, where(span), std::string(habit->meant));
    }
    const bool is_word = habit->meant == "and" || habit->meant == "or";
    edit(span, is_word ? fmt::format(" {} ", habit->meant) : std::string(habit->meant));
  }

  /// Whether the operands leave no doubt about the operator. `**`, `<>` and `=<` may be typos of
  /// others; 800×600 is no product, and of vectors `×` and `·` are `cross` and `dot`.
  bool is_certain_sign() const {
    constexpr auto kBinary =
        std::to_array<std::string_view>({"&&", "||", "!==", "===", "÷", "≤", "≥", "≠", "…"});
    const std::string_view written = tokens_.written(i_);
    if (is_one_of(written, kBinary)) {
      const bool is_declared = i_ > 1 && (tokens_.is(i_ - 2, "let") || tokens_.is(i_ - 2, "param"));
      return follows_value() && precedes_value() && !(written == "===" && is_declared);
    }
    if (written == "−") return precedes_value();
    if (written == "–") return precedes_value() && !follows_value();  // 1–5 may be a range
    return written == "!" && !follows_value() && !tokens_.is(i_ - 1, "<") &&
           tokens_.is_joined(i_ + 1) &&
           (tokens_.is_word(i_ + 1) || tokens_.is_number(i_ + 1) ||
            tokens_.is_bracket(i_ + 1, '('));
  }

  /// The first token of the operand that ends at the token `last`: a name, a number, a call or what
  /// is in parentheses; size() for others.
  std::size_t operand_begin(std::size_t last) const {
    if (tokens_.is(last, TokenClass::Value) && !is_joint(last)) return last;
    if (!tokens_.is_bracket(last, ')')) return tokens_.size();
    const std::size_t open = tokens_.partner(last);
    const bool is_call = open < last && tokens_.is_joined(open) && tokens_.is_name(open - 1);
    return is_call ? open - 1 : open;
  }
  std::size_t operand_end(std::size_t first) const {
    const bool is_value = tokens_.is(first, TokenClass::Value) && !is_joint(first);
    const bool is_call = tokens_.is_bracket(first + 1, '(') && tokens_.is_joined(first + 1);
    if (is_value) return is_call ? tokens_.partner(first + 1) : first;
    return tokens_.is_bracket(first, '(') ? tokens_.partner(first) : tokens_.size();
  }

  /// Offers `mod(a, b)` for `a % b`. Nothing beside the operands may bind as tightly as `%`.
  void suggest_remainder(DiagnosticBuilder& message) {
    if (!follows_value() || !precedes_value()) return;
    const std::size_t first = operand_begin(i_ - 1), last = operand_end(i_ + 1);
    if (first >= tokens_.size() || last >= tokens_.size()) return;
    constexpr auto kTight = std::to_array<std::string_view>({"*", "/", "%", "^", "**", ".", "!"});
    const bool is_negative = tokens_.is(first - 1, "-") && tokens_.wants_operand(first - 2);
    const bool is_after_operator = is_negative || is_one_of(tokens_.written(first - 1), kTight);
    const bool is_before_operator =
        is_one_of(tokens_.written(last + 1), kTight) ||
        (tokens_.is(last + 1, TokenClass::Open) && !tokens_.is_bracket(last + 1, '{'));
    if (is_after_operator || is_before_operator) return;
    message.unsafe_fix(where(span_of(first, last)),
                       fmt::format("mod({}, {})", text_of(span_of(first, i_ - 1)),
                                   text_of(span_of(i_ + 1, last))));
  }

  void semicolon(std::string_view help) {
    if (inside() == Inside::Loop) return;
    auto message = report(diag::foreign, span_of(i_), ";");
    if (!in_block()) {
      message.help("separate values with commas");
      return fix(message, false, span_of(i_), ",");
    }
    message.help_if(help);
    const std::size_t next = i_ + 1;
    const bool begins_next = tokens_[next].is_first || tokens_.is_bracket(next, '}') ||
                             tokens_.is(next, TokenClass::Label) || tokens_.begins_object(next) ||
                             is_one_of(tokens_.written(next), kStatementWords);
    const bool ends_last = follows_value() || (i_ > 0 && tokens_.is_bracket(i_ - 1, '}'));
    add_fix(message, begins_next && ends_last, where(span_of(i_)), "");
    edit(span_of(i_), " ");
  }

  // Quotes

  static bool is_plain_string(std::string_view content) {
    return content.find_first_of("\"\\\t\r'") == std::string_view::npos &&
           content.find("//") == std::string_view::npos &&
           content.find("/*") == std::string_view::npos;
  }
  std::string_view rest_of_line(std::uint32_t begin) const {
    const std::string_view text = tokens_.text();
    return text.substr(begin, std::min(text.find('\n', begin), text.size()) - begin);
  }
  void skip_before(std::uint32_t end) {
    std::size_t last = i_;
    while (last + 1 < tokens_.size() && tokens_[last + 1].begin < end) ++last;
    skip_to(last);
  }

  void single_quotes() {
    const std::uint32_t begin = tokens_[i_].begin;
    const std::size_t size = rest_of_line(begin + 1).find('\'');
    const bool is_closed = size != std::string_view::npos;
    const Span content{begin + 1, begin + 1 + static_cast<std::uint32_t>(is_closed ? size : 0)};
    const Span span{begin, content.end + (is_closed ? 1 : 0)};
    auto message = report(diag::foreign, span, text_of(span));
    message.help("strings are in double quotes");
    if (is_closed && is_plain_string(text_of(content))) {
      fix(message, true, span, fmt::format("\"{}\"", text_of(content)));
    } else {
      leave(span);
    }
    skip_before(span.end);
  }

  /// Replaces a quote of a word processor and the one that closes it, if the text between is plain.
  void typographic_quote(DiagnosticBuilder& message) {
    const Span opening = span_of(i_);
    const bool is_single = text_of(opening) == "‘";
    const std::string_view line = rest_of_line(opening.end);
    std::size_t size = line.size();
    for (const std::string_view quote : {"“", "”", "’"}) {
      if ((quote == "’") == is_single) size = std::min(size, line.find(quote));
    }
    const bool is_opening = is_single || text_of(opening) != "’";
    if (!is_opening || size == line.size() || !is_plain_string(line.substr(0, size))) {
      return leave(opening);
    }
    const std::uint32_t end = opening.end + static_cast<std::uint32_t>(size);
    fix(message, true, opening, "\"");
    fix(message, true, {end, end + 3}, "\"");
    skip_before(end + 3);
  }
};

}  // namespace

std::vector<Edit> repair_signs(const RepairContext& context, const TokenList& tokens) {
  return Signs(context, tokens).run();
}

}  // namespace sdlc::lang
