#include <algorithm>
#include <array>
#include <set>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/property_names.hpp"
#include "lang/repair/scene_round.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/schema/schema.hpp"
#include "lang/schema/type_names.hpp"
#include "lang/text/ascii.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

/// Declarations, names and values of other languages. Tries each rule at each token: one that
/// applies reports, makes its edits and returns true.
class Values : private SceneRound {
 public:
  using SceneRound::SceneRound;

  std::vector<Edit> run() {
    walk([this] { static_cast<void>(declaration() || value()); });
    return std::move(edits_);
  }

 private:
  bool declaration() {
    if (!tokens_.may_begin_statement(i_)) return false;
    return typed_value() || reserved_name() || assigned_object() || quoted_label() || dashed_name();
  }
  bool value() {
    return decimal_comma() || bare_point() || braced_point() || vector() || wrong_pair() ||
           element_by_dot() || new_value() || quoted_name() || string_of_two_lines() ||
           other_letters();
  }

  /// From the end of one token to the beginning of another.
  Span between(std::size_t first, std::size_t last) const {
    return {tokens_[first].end, tokens_[last].begin};
  }

  // Declarations and names

  /// `let size: number = …`
  bool typed_value() {
    const std::size_t label = i_ + 1;
    const bool is_typed = tokens_.is(i_, "let") && tokens_.is(label, TokenClass::Label) &&
                          tokens_.is_name(label + 1) && tokens_.is(label + 2, "=");
    if (!is_typed) return false;
    const std::string_view type = tokens_.written(label + 1);
    const bool is_type = is_type_name(type) || find_habit(HabitPlace::ValueWord, type).has_value();
    auto message = expected({tokens_[label].end - 1, tokens_[label].end}, "`=`");
    message.help("a value has the type of what it is made of");
    const auto name_end =
        tokens_[label].begin + static_cast<std::uint32_t>(tokens_.label(label).size());
    fix(message, is_type, {name_end, tokens_[label + 1].end}, "");
    skip_to(label + 1);
    return true;
  }

  /// `let if = 3`
  bool reserved_name() {
    const bool is_declared = tokens_.is(i_, "let") || tokens_.is(i_, "param");
    const std::string_view word = tokens_.written(i_ + 1);
    if (!is_declared || !is_one_of(word, kReservedWords) || !tokens_.is(i_ + 2, "=")) return false;
    expected(span_of(i_ + 1), fmt::format("a name after `{}`", tokens_.written(i_)))
        .help(fmt::format("`{}` is a word of the language and cannot be a name", word));
    edit(span_of(i_ + 1), std::string(word.size(), '_'));
    skip_to(i_ + 1);
    return true;
  }

  static bool is_kind(std::string_view name) {
    return std::ranges::any_of(all_kinds(), [&](const Kind& kind) { return kind.name == name; });
  }

  /// `Sphere ball = { … }`, `Sphere ball = sphere { … }` and `let ball = sphere { … }`
  bool assigned_object() {
    const bool is_let = tokens_.is(i_, "let");
    const bool is_object = (is_let || tokens_.is_name(i_)) && tokens_.is_name(i_ + 1) &&
                           tokens_.is_same_line(i_ + 1) && tokens_.is(i_ + 2, "=") &&
                           tokens_.is_same_line(i_ + 2);
    if (!is_object) return false;
    const bool repeats = tokens_.is_name(i_ + 3) && tokens_.is_bracket(i_ + 4, '{');
    const std::size_t brace = i_ + (repeats ? 4 : 3);
    if (!tokens_.is_bracket(brace, '{') || (is_let && !repeats)) return false;
    std::string kind(tokens_.written(is_let ? i_ + 3 : i_));
    kind[0] = to_lower(kind[0]);
    if (!is_kind(kind)) return false;
    const std::string_view name = tokens_.written(i_ + 1);
    const std::string help = fmt::format("an object is `{} {} {{ … }}`", kind, name);
    if (is_let) {
      auto message = report(diag::expected, span_of(i_ + 3), "a value after `=`, found an object");
      message.help(help);
      const Span head{tokens_[i_].begin, tokens_[brace].begin};
      message.unsafe_fix(where(head), fmt::format("{} {} ", kind, name));
      edit({tokens_[i_].begin, tokens_[i_ + 3].begin}, "");
      edit({tokens_[brace].end, tokens_[brace].end}, " ");  // its properties are not checked
    } else {
      auto message = report_expected(i_ + 2, "`{`", false);
      message.help(help);
      fix(message, false, between(i_ + 1, brace), " ");
    }
    skip_to(brace - 1);
    return true;
  }

  static bool is_identifier(std::string_view name) {
    return !name.empty() && end_of_identifier(name, 0) == name.size() &&
           !is_one_of(name, kReservedWords);
  }
  /// Without its quotes.
  std::string_view content(std::size_t string) const {
    const std::string_view text = tokens_.written(string);
    return text.size() > 2 && text.ends_with('"') ? text.substr(1, text.size() - 2)
                                                  : std::string_view();
  }

  /// `sphere "ball" {`
  bool quoted_name() {
    const bool is_quoted = tokens_.is_string(i_) && tokens_.is_bracket(i_ + 1, '{') && i_ > 0 &&
                           tokens_.is_name(i_ - 1) && tokens_.is_same_line(i_) &&
                           tokens_.may_begin_statement(i_ - 1);
    std::string name(content(i_));
    if (!is_quoted || name.empty()) return false;
    const bool is_plain = is_identifier(name);
    for (char& c : name) c = is_idchar(c) ? c : '_';
    if (!is_identifier(name)) name = "_" + name;
    auto message = expected(span_of(i_), "a name");
    message.help("names have no quotes");
    fix(message, is_plain, span_of(i_), name);
    return true;
  }

  /// `"center": …`
  bool quoted_label() {
    const bool is_label = tokens_.is_string(i_) && tokens_.is(i_ + 1, ":") && in_block();
    const std::string_view name = content(i_);
    if (!is_label || name.empty() || end_of_identifier(name, 0) != name.size()) return false;
    auto message = expected(span_of(i_), "a name");
    message.help("names of properties have no quotes");
    // Edited quote by quote: the label's bytes stay where they are.
    const Span span = span_of(i_);
    add_fix(message, true, where(span), std::string(name));
    edit({span.begin, span.begin + 1}, "");
    edit({span.end - 1, span.end}, "");
    return true;
  }

  /// `let my-name = …`, and where else it is written so.
  bool dashed_name() {
    if (!tokens_.is(i_, "let") && !tokens_.is(i_, "param")) return false;
    std::size_t last = i_ + 1;
    while (tokens_.is_word(last) && tokens_.is(last + 1, "-") && tokens_.is_joined(last + 1) &&
           tokens_.is_word(last + 2) && tokens_.is_joined(last + 2)) {
      last += 2;
    }
    const std::size_t size = last - i_ - 1;
    constexpr int kMaxDashed = 50;  // each is looked for in the whole text
    if (size == 0 || !tokens_.is(last + 1, "=") || ++dashed_ > kMaxDashed) return false;
    const std::string name(text_of(span_of(i_ + 1, last)));
    std::string fixed = name;
    std::ranges::replace(fixed, '-', '_');
    auto message = expected(span_of(i_ + 1, last), "a name");
    message.help_if(kNameLetters);
    for (std::size_t i = 0; i + size < tokens_.size(); ++i) {
      const bool is_use = text_of(span_of(i, i + size)) == name;
      if (!is_use || (i > 0 && tokens_.is_joined(i) && tokens_.is(i - 1, "-"))) continue;
      fix(message, false, span_of(i, i + size), fixed);
    }
    skip_to(last);
    return true;
  }

  /// Words with letters that no name has.
  bool other_letters() {
    const bool is_text = tokens_.is_word(i_) || tokens_.is(i_, TokenClass::Label);
    if (!is_text || is_ascii(tokens_.written(i_))) return false;
    std::string plain(tokens_.label(i_));
    const Span span{tokens_[i_].begin,
                    tokens_[i_].begin + static_cast<std::uint32_t>(plain.size())};
    if (reported_words_.insert(plain).second) {
      const auto habit = find_habit(HabitPlace::Name, plain);
      auto message = report(diag::foreign, span, plain);
      message.help_if(habit ? habit->help : kNameLetters);
      if (habit && !habit->meant.empty()) message.suggest(habit->meant);
    }
    std::ranges::replace_if(
        plain, [](char c) { return !is_ascii(c); }, '_');
    edit(span, plain);
    return true;
  }

  // Values

  /// `1,5` for 1.5 in the place of one value.
  bool decimal_comma() {
    const bool follows_name =
        i_ > 0 && in_block() && (tokens_.is(i_ - 1, TokenClass::Label) || tokens_.is(i_ - 1, "="));
    const bool is_number = follows_name && tokens_.is_number(i_) && tokens_.is_joined(i_ + 1) &&
                           tokens_.is(i_ + 1, TokenClass::Comma) && tokens_.is_joined(i_ + 2) &&
                           tokens_.is_number(i_ + 2);
    const bool goes_on = tokens_.is(i_ + 3, TokenClass::Comma) && tokens_.is_number(i_ + 4);
    if (!is_number || goes_on || tokens_.written(i_).find('.') != std::string_view::npos) {
      return false;
    }
    const Span span = span_of(i_, i_ + 2);
    auto message = report(diag::bad_number, span, text_of(span), "decimals follow a point");
    fix(message, false, span_of(i_ + 1), ".");
    skip_to(i_ + 2);
    return true;
  }

  /// The last token of a number or name, perhaps with a sign, at `i`; size() if there is none.
  std::size_t end_of_component(std::size_t i) const {
    if (tokens_.is(i, "-")) ++i;
    const bool is_one = (tokens_.is_number(i) || tokens_.is_name(i)) && tokens_.is_same_line(i);
    return is_one ? i : tokens_.size();
  }

  /// `center: 1, 2, 3`, with commas or without.
  bool bare_point() {
    if (!tokens_.is(i_, TokenClass::Label) || !in_block()) return false;
    std::size_t next = i_ + 1, last = i_;
    bool has_number = false;
    std::array<std::size_t, 3> ends{};
    for (std::size_t& end : ends) {
      if (last != i_ && tokens_.is(next, TokenClass::Comma)) ++next;
      end = last = end_of_component(next);
      if (last >= tokens_.size()) return false;
      has_number = has_number || tokens_.is_number(last);
      next = last + 1;
    }
    const bool has_comma = tokens_.is(ends[0] + 1, TokenClass::Comma);
    const bool ends_value = tokens_[next].is_first || tokens_.is_bracket(next, '}') ||
                            (tokens_.is(next, TokenClass::Comma) && !tokens_.is_number(next + 1));
    // Names one after the other may be anything.
    const bool are_plain = has_comma || (tokens_.is_number(ends[0]) && tokens_.is_number(ends[1]));
    if (!ends_value || !has_number || !are_plain) return false;
    const Span span = span_of(i_ + 1, last);
    std::string point = "(";
    for (std::size_t i = i_ + 1; i <= last; ++i) {
      if (tokens_.is(i, TokenClass::Comma)) continue;
      point += tokens_.written(i);
      if (i == ends[0] || i == ends[1]) point += ", ";
    }
    auto message = expected(span, "a point in parentheses");
    const bool is_safe =
        is_point_property(tokens_.label(i_)) &&
        std::ranges::all_of(ends, [&](std::size_t end) { return tokens_.is_number(end); });
    add_fix(message, is_safe, where(span), point + ")");
    edit({span.begin, span.begin}, "(");
    for (const std::size_t end : {ends[0], ends[1]}) {
      if (!tokens_.is(end + 1, TokenClass::Comma)) edit({tokens_[end].end, tokens_[end].end}, ",");
    }
    edit({span.end, span.end}, ")");
    skip_to(last);
    return true;
  }

  /// `{1, 2, 3}` in the place of a value.
  bool braced_point() {
    if (!tokens_.is_bracket(i_, '{') || i_ == 0 || !tokens_.is(i_ - 1, TokenClass::Label)) {
      return false;
    }
    std::size_t last = i_;
    for (int i = 0; i < 3; ++i) {
      if (i > 0 && !tokens_.is(++last, TokenClass::Comma)) return false;
      last = end_of_component(last + 1);
      if (last >= tokens_.size()) return false;
    }
    if (!tokens_.is_bracket(last + 1, '}')) return false;
    auto message = expected(span_of(i_, last + 1), "a point in parentheses");
    return point_in_signs(message, last + 1, is_point_property(tokens_.label(i_ - 1)));
  }

  /// `<1, 2, 3>`
  bool vector() {
    constexpr std::size_t kMaxTokens = 60;
    if (!tokens_.is(i_, "<") || i_ == 0 || !tokens_.wants_operand(i_ - 1)) return false;
    std::size_t commas = 0, close = i_ + 1;
    for (; !tokens_.is(close, ">"); ++close) {
      if (!tokens_.is_same_line(close) || close > i_ + kMaxTokens) return false;
      if (tokens_.is(close, TokenClass::Open)) close = tokens_.partner(close);
      commas += tokens_.is(close, TokenClass::Comma);
    }
    if (commas != 2) return false;
    auto message = report(diag::foreign, span_of(i_, close), text_of(span_of(i_, close)));
    message.help("a point is written `(x, y, z)`");
    return point_in_signs(message, close, true);
  }

  bool point_in_signs(DiagnosticBuilder& message, std::size_t close, bool is_safe) {
    add_fix(message, is_safe, where(span_of(i_, close)),
            fmt::format("({})", text_of(between(i_, close))));
    edit(span_of(i_), "(");
    edit(span_of(close), ")");
    return true;
  }

  /// Braces or brackets around arguments, parentheses around a block.
  bool wrong_pair() {
    if (!tokens_.is(i_, TokenClass::Open) || i_ < 2 || !tokens_.is_name(i_ - 1)) return false;
    if (tokens_.is_bracket(i_, '{') && is_kind(tokens_.written(i_ - 1))) return false;
    const std::size_t close = tokens_.partner(i_);
    const bool is_pair =
        close < tokens_.size() && tokens_[i_].bracket == (tokens_.is_bracket(close, '}')   ? '{'
                                                          : tokens_.is_bracket(close, ']') ? '['
                                                                                           : '(');
    if (!is_pair) return false;
    const bool has_label = tokens_.is(i_ + 1, TokenClass::Label);
    const bool is_one_line = tokens_[i_].line == tokens_[close].line;
    const bool is_value = tokens_.is(i_ - 2, TokenClass::Label) || tokens_.is(i_ - 2, "=") ||
                          tokens_.is_bracket(i_ - 2, '(') || tokens_.is_bracket(i_ - 2, '[') ||
                          (tokens_.is(i_ - 2, "in") && tokens_.is_bracket(close + 1, '{'));
    const bool are_arguments =
        (tokens_.is_bracket(i_, '{') && is_one_line && is_value && !has_block(i_, close)) ||
        (tokens_.is_bracket(i_, '[') && has_label);
    const bool begins_line = tokens_.may_begin_statement(i_ - 1) ||
                             (tokens_.is_name(i_ - 2) && tokens_.may_begin_statement(i_ - 2));
    const bool is_block =
        tokens_.is_bracket(i_, '(') && begins_line && has_label && tokens_[i_ + 1].is_first;
    if (!are_arguments && !is_block) return false;
    auto message = report_expected(i_, are_arguments ? "`(`" : "`{`", false);
    fix(message, false, span_of(i_), are_arguments ? "(" : "{");
    fix(message, false, span_of(close), are_arguments ? ")" : "}");
    return true;
  }
  bool has_block(std::size_t open, std::size_t close) const {
    for (std::size_t i = open + 1; i < close; ++i) {
      if (tokens_.is_bracket(i, '{')) return true;
    }
    return false;
  }

  /// `row.0`
  bool element_by_dot() {
    const std::string_view number = tokens_.written(i_);
    const bool is_element = tokens_.is_number(i_) && number[0] == '.' && tokens_.is_joined(i_) &&
                            (tokens_.is_name(i_ - 1) || tokens_.is(i_ - 1, TokenClass::Close)) &&
                            number.find_first_not_of("0123456789", 1) == std::string_view::npos;
    if (!is_element) return false;
    const Span span = span_of(i_), digits{span.begin + 1, span.end};
    const std::string element = fmt::format("[{}]", number.substr(1));
    auto message = expected(digits, "a name after `.`");
    message.help(fmt::format("an element of a list is `{}{}`", tokens_.written(i_ - 1), element));
    fix(message, false, span, element);
    return true;
  }

  /// `new diffuse(…)`
  bool new_value() {
    const bool is_new = tokens_.is(i_, "new") && i_ > 0 && tokens_.wants_operand(i_ - 1) &&
                        tokens_.holds_arguments(i_ + 2) && tokens_.is_joined(i_ + 2);
    if (!is_new) return false;
    auto message = report(diag::foreign, span_of(i_), "new");
    message.help("a call makes its value");
    fix(message, true, {tokens_[i_].begin, tokens_[i_ + 1].begin}, "");
    return true;
  }

  /// A string whose closing quote is in the next line.
  bool string_of_two_lines() {
    const auto is_unclosed = [&](std::size_t i) {
      return tokens_.is_string(i) && (tokens_.written(i).size() < 2 || content(i).empty()) &&
             !tokens_.written(i).ends_with("\"\"");
    };
    if (!is_unclosed(i_)) return false;
    std::size_t end = i_ + 1;
    while (end < tokens_.size() && tokens_[end].line <= tokens_[i_].line + 1 &&
           !tokens_.is_string(end)) {
      ++end;
    }
    const bool is_next = is_unclosed(end) && tokens_[end].line == tokens_[i_].line + 1 &&
                         tokens_.is_joined(end) && tokens_.is(end - 1, TokenClass::Value);
    if (!is_next) return false;
    const std::uint32_t begin = tokens_[i_].begin;
    report(diag::unclosed, {begin, begin + 1}, "\"")
        .help("a string ends in the line that it begins in");
    const auto line_end = static_cast<std::uint32_t>(tokens_.text().find('\n', begin));
    const bool has_return = tokens_.text()[line_end - 1] == '\r';
    edit({line_end - has_return, line_end + 1}, " ");
    skip_to(end);
    return true;
  }

  std::set<std::string> reported_words_;
  int dashed_ = 0;  ///< names declared with dashes
};

}  // namespace

std::vector<Edit> repair_values(const RepairContext& context, const TokenList& tokens) {
  return Values(context, tokens).run();
}

}  // namespace sdlc::lang
