#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <unordered_set>

#include <fmt/format.h>

#include "lang/repair/certainty.hpp"
#include "lang/repair/habits.hpp"
#include "lang/repair/recovery.hpp"
#include "lang/repair/repair_report.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/schema/schema.hpp"
#include "lang/schema/type_names.hpp"
#include "lang/syntax/tree_builder.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/text/utf8.hpp"
#include "lang/token/brackets.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kScene = "scene";

/// Whether a comment of another language begins at `at`, where a statement may.
bool begins_foreign_comment(std::string_view text, std::uint32_t at) {
  const bool is_hash = char_at(text, at) == '#';
  if (is_hash && !is_idchar(char_at(text, at + 1))) return true;
  return (is_hash || text.substr(at).starts_with("--")) && is_first_of_line(text, at);
}

/// What other languages define a value with, after a `#`.
constexpr auto kDefinitions = std::to_array<std::string_view>({"define", "declare", "local"});

std::string_view word_at(std::string_view text, std::uint32_t at) {
  return text.substr(at, end_of_identifier(text, at) - at);
}

/// Reports it, and returns its end.
std::uint32_t foreign_comment(TreeBuilder& builder, std::uint32_t at) {
  const std::string_view text = builder.text(), mark = text.substr(at, text[at] == '#' ? 1 : 2);
  const Location where = builder.location({at, at + static_cast<std::uint32_t>(mark.size())});
  auto report = builder.sink().report(diag::foreign, where, mark);
  if (is_one_of(word_at(text, at + 1), kDefinitions)) {
    report.help("a value gets its name by `let name = value`");
    return static_cast<std::uint32_t>(std::min(text.find('\n', at), text.size()));
  }
  report.help("comments begin with `//`");
  // `#define` and `--i` are something else.
  const char next = char_at(text, where.span.end);
  const bool is_shebang = next == '!' && at == 0;
  if (is_shebang || std::string_view(" \t\r\n\0", 5).find(next) != std::string_view::npos) {
    report.fix(where, "//");
  }
  return static_cast<std::uint32_t>(std::min(text.find('\n', at), text.size()));
}

class Diagnosis {
 public:
  Diagnosis(TreeBuilder& builder, std::uint32_t at)
      : builder_(builder), text_(builder.text()), at_(at), found_(token_at(text_, at)) {
    const std::uint32_t end = std::min(builder.token_end(), at);
    is_on_next_line_ = text_.substr(end, at - end).find('\n') != std::string_view::npos;
  }

  void expected(Expectation expectation) {
    const Wanted wanted = expectation.wanted;
    if (foreign_sign() || single_quotes() || missing_value(wanted)) return;
    if (goes_on(wanted) && assignment()) return;
    // Behind a comma the bracket does not close yet.
    const bool behind_comma = at_ > 0 && last_char() == ',';
    const bool wants_more = behind_comma && ends_values(wanted);
    auto report = report_expected(wants_more ? "a value" : expectation.words);
    explain(report, wanted);
    if (!is_closing(wanted)) return;
    report.label(where({builder_.opener, builder_.opener + 1}), "opened here");
    const std::uint32_t end = builder_.token_end();
    const bool is_next_value = is_value(char_at(text_, at_)) && !looks_like_statement(text_, at_);
    if (wanted == Wanted::GroupEnd && commas_in_group() > 1) {
      report.help("a point has three values");
    } else if (!behind_comma && is_next_value) {
      if (!is_on_next_line_) builder_.poison_last_name();
      report.help("commas stand between values");
      if (end < at_) report.unsafe_fix(where({end, end}), ",");
    }
  }

  Resumption statement() {
    const char c = char_at(text_, at_);
    if (c == '}' || c == ')' || c == ']') {
      builder_.sink().report(diag::unmatched, where(found_), text(found_));
      return here(found_.end);
    }
    if (c == ',') {
      builder_.sink()
          .report(diag::foreign, where(found_), ",")
          .help("one comma is enough")
          .fix(where(found_), "");
      return here(found_.end);
    }
    if (c == '{') return {stray_block()};
    if (begins_foreign_comment(text_, at_)) return here(foreign_comment(builder_, at_));
    if (c == ';' && foreign_sign()) return here(found_.end);
    if (foreign_sign() || assignment()) {
      builder_.poison_last_statement();
      return {found_.end};
    }
    poison_what_goes_on();
    if (is_letter(c)) return word_statement();
    is_on_next_line_ = false;
    report_expected("a statement");
    return {c == '#' ? end_of_identifier(text_, at_ + 1) : found_.end};
  }

 private:
  /// Whether an expression in front of it could go on.
  static bool goes_on(Wanted wanted) {
    return wanted == Wanted::Block || wanted == Wanted::Then || wanted == Wanted::Message ||
           is_closing(wanted);
  }
  static bool is_closing(Wanted wanted) {
    return ends_values(wanted) || wanted == Wanted::GroupEnd || wanted == Wanted::IndexEnd;
  }
  static bool ends_values(Wanted wanted) {
    return wanted == Wanted::ParametersEnd || wanted == Wanted::ArgumentsEnd ||
           wanted == Wanted::ListEnd;
  }

  /// What to write instead, where what was found tells it.
  void explain(DiagnosticBuilder& report, Wanted wanted) {
    const char c = char_at(text_, at_);
    switch (wanted) {
      case Wanted::Is:
        if (c == ':') fix_colon(report);
        break;
      case Wanted::FunctionIs:
        if (c == '{') report.help_if(kFunction);
        if (c == ':') fix_colon(report);
        break;
      case Wanted::Type:
        if (is_value(c)) {
          const std::uint32_t colon = builder_.token_end() - 1;
          report.help("a default follows `=`").unsafe_fix(where({colon, colon + 1}), "=");
        }
        break;
      case Wanted::Name:
        if (c == '(') report.help_if(kNoLoop);
        if (static_cast<unsigned char>(c) >= 0x80) report.help_if(kNameLetters);
        if (is_one_of(word(), kReservedWords)) {
          report.help(fmt::format("`{}` is a word of the language and cannot be a name", word()));
        }
        break;
      case Wanted::In:
        if (c == '=') report.help_if(kNoLoop);
        break;
      case Wanted::Block:
        if (word() == "then") {
          report.help("`if … then …` is a value; a statement is `if … { … }`");
        } else if (c == ':') {
          report.help("a block stands in braces");
        }
        break;
      case Wanted::SecondOperand: report.help("write `a < b and b < c`"); break;
      case Wanted::FileName:
        report.help("a file name is a string, known without evaluating anything");
        break;
      default: break;
    }
  }

  /// `let a: 1` and `let a := 1`; what has a type there lacks its value.
  void fix_colon(DiagnosticBuilder& report) {
    const bool is_assignment = char_at(text_, found_.end) == '=';
    const Span sign{found_.begin, found_.end + (is_assignment ? 1 : 0)};
    const Span next = token_at(text_, skip_blanks(text_, sign.end));
    if (!is_type_name(text(next))) report.fix(where(sign), "=");
  }

  /// Behind the string, comment, bracket or character at `at`.
  std::uint32_t end_of_part(std::uint32_t at) const {
    const char c = text_[at];
    const bool opens = c == '(' || c == '[' || c == '{';
    return std::max(opens ? end_of_bracket(text_, at) : end_of_opaque(text_, at), at + 1);
  }

  /// Of the parenthesis around this place.
  std::size_t commas_in_group() const {
    std::size_t commas = 0;
    for (std::uint32_t i = builder_.opener + 1; i < at_;) {
      const std::uint32_t behind = end_of_part(i);
      if (text_[i] == ',') ++commas;
      i = behind;
    }
    return commas;
  }

  /// What stands in the line of the last statement, and no comma between, was perhaps meant to be a
  /// part of it.
  void poison_what_goes_on() {
    const bool goes_on = !is_on_next_line_ && last_char() != ',' && is_value(char_at(text_, at_));
    if (goes_on) builder_.poison_last_statement();
  }

  /// The next statement begins behind the blanks at `end`.
  Resumption here(std::uint32_t end) const { return {skip_blanks(text_, end), true}; }
  Location where(Span span) const { return builder_.location(span); }
  std::string_view text(Span span) const { return text_.substr(span.begin, span.size()); }
  std::string_view word() const { return text(found_); }
  char last_char() const {
    const std::uint32_t end = builder_.token_end();
    return end == 0 ? '\0' : text_[end - 1];
  }

  /// Whether a value can begin with `c`.
  static bool is_value(char c) {
    return c == '"' || c == '#' || c == '[' || c == '(' || c == '-' || c == '.' || is_idchar(c);
  }

  std::string found_text() const {
    if (is_on_next_line_) return "the end of the line";
    if (found_.size() == 0) return "the end of the file";
    if (builder_.is_added(found_.begin)) return "the end of the block";
    const std::string_view token = text(found_);
    return fmt::format("`{}`",
                       token.size() <= 40 ? token : token.substr(0, decode_utf8(token).size));
  }

  /// What is missing at the end of a line is reported there, not at whatever the next line begins
  /// with.
  DiagnosticBuilder report_expected(std::string_view words) {
    const std::uint32_t end = builder_.token_end();
    const Span place = is_on_next_line_ || found_.size() == 0 ? Span{end, end} : found_;
    return builder_.sink().report(diag::expected, where(place),
                                  fmt::format("{}, found {}", words, found_text()));
  }

  /// A sign of other languages. The parser stops inside some of them: after the first `*` of `**`,
  /// the second `=` of `===`.
  bool foreign_sign() {
    for (std::uint32_t read = std::min<std::uint32_t>(2, at_);; --read) {
      const std::uint32_t begin = at_ - read;
      const std::string_view sign =
          foreign_sign_at(text_.substr(std::min<std::size_t>(begin, text_.size())));
      if (sign.size() > read) return report_sign(sign, begin);
      if (read == 0) return false;
    }
  }

  bool report_sign(std::string_view sign, std::uint32_t begin) {
    const Habit habit = *find_habit(HabitPlace::Sign, sign);
    const Span span{begin, begin + static_cast<std::uint32_t>(sign.size())};
    auto report = builder_.sink().report(diag::foreign, where(span), sign);
    report.help_if(habit.help);
    found_.end = span.end;
    if (habit.meant == "\"") {
      const Span closing = closing_quote(text_, span);
      if (closing.size() == 0) return true;
      report.fix(where(span), "\"").fix(where(closing), "\"");
      found_.end = closing.end;
    } else if (sign == ";") {
      add_fix(report, ends_statement(text_, span.begin), where(span), "");
    } else if (!habit.meant.empty() && habit.meant != "deg") {
      const bool is_certain = is_certain_sign(text_, span);
      if (is_certain || sign != "!") {
        add_fix(report, is_certain, where(span), std::string(habit.meant));
      }
    }
    return true;
  }

  /// `=` where a value could go on.
  bool assignment() {
    if (char_at(text_, at_) != '=' || char_at(text_, at_ + 1) == '=') return false;
    builder_.poison_last_name();
    builder_.sink()
        .report(diag::foreign, where(found_), "=")
        .help("write `==` to compare, `:` for a property or an argument");
    return true;
  }

  bool single_quotes() {
    if (char_at(text_, at_) != '\'') return false;
    const std::size_t line_end = std::min(text_.find('\n', at_), text_.size());
    const std::size_t close = text_.substr(0, line_end).find('\'', at_ + 1);
    const bool is_closed = close != std::string_view::npos;
    const Span span{at_, is_closed ? static_cast<std::uint32_t>(close + 1) : at_ + 1};
    auto report = builder_.sink().report(diag::foreign, where(span), text(span));
    report.help("strings stand in double quotes");
    const Span content{span.begin + 1, span.end - 1};
    if (is_closed && is_plain_string(text(content))) {
      report.fix(where(span), fmt::format("\"{}\"", text(content)));
    }
    return true;
  }

  /// `center:` with the next property, or nothing, behind it.
  bool missing_value(Wanted wanted) {
    if (wanted != Wanted::LabeledValue) return false;
    const std::uint32_t next = skip_blanks(text_, found_.end);
    const bool is_label = is_letter(char_at(text_, at_)) && char_at(text_, next) == ':';
    const bool is_end =
        found_.size() == 0 || text(found_) == "}" || text(found_) == "," || text(found_) == ")";
    if (!is_label && !is_end) return false;
    // The label stands in front of the colon that was read last.
    const SyntaxNode& owner = builder_.nodes()[builder_.nodes().size() - 2];
    const Span label{owner.begin, owner.begin + owner.head};
    builder_.sink().report(diag::no_value, where(label), text(label));
    return true;
  }

  std::uint32_t stray_block() {
    builder_.poison_last_statement();
    builder_.sink()
        .report(diag::stray_block, where(found_))
        .help("an object is `kind { … }` or `kind name { … }`, a statement and not a value");
    return found_.end;
  }

  Resumption word_statement() {
    const std::uint32_t next = skip_space(text_, found_.end);
    const char c = char_at(text_, next);
    const Span name = found_;
    if (word() == "scene" && is_digit(c)) return version(next);
    if (word() == "else" || word() == "then") {
      builder_.sink().report(diag::expected, where(name),
                             fmt::format("a statement, found `{}`; it belongs to an `if`", word()));
      return {name.end};
    }
    const auto habit = find_habit(HabitPlace::StatementWord, word());
    if (habit && c != '=' && c != ':') {
      is_on_next_line_ = false;
      report_expected("a statement").help_if(habit->help);
      return {name.end};
    }
    if (c == '=' && char_at(text_, next + 1) != '=' && char_at(text_, next + 1) != '>') {
      auto report = builder_.sink().report(diag::foreign, where({next, next + 1}), "=");
      if (builder_.in_object) {
        report.help("a property is `name: value`");
        add_fix(report, is_property_name(text(name)), where({name.end, next + 1}), ":");
      } else {
        report.help("a value gets its name by `let name = value`")
            .unsafe_fix(where({name.begin, name.begin}), "let ");
      }
      return {next + 1};
    }
    if (c == '(') return {call_statement(next)};
    if (c == '.' && next == name.end) {  // `file.ring(n: 3)`
      const std::uint32_t end = end_of_path(name.end);
      const std::uint32_t open = skip_blanks(text_, end);
      if (char_at(text_, open) == '(') {
        found_.end = end;
        return {call_statement(open)};
      }
    }
    if (is_digit(last_char()) && (c == ',' || c == '}')) {
      builder_.poison_last_statement();
      builder_.sink()
          .report(diag::foreign, where(name), word())
          .help(fmt::format("units are {}", fmt::join(kUnits, ", ")));
      return {name.end};
    }
    found_ = token_at(text_, next);
    is_on_next_line_ = text_.substr(name.end, next - name.end).find('\n') != std::string_view::npos;
    builder_.end_token(name.end);
    auto report = report_expected(fmt::format("`:` or `{{` after `{}`", text(name)));
    if (builder_.in_object && lacks_colon(text(name), next)) {
      report.fix(where({name.end, name.end}), ":");
    } else if (builder_.in_object && char_at(text_, next) == '}') {
      report.help(fmt::format("a property is `name: value`, such as `color: {}`", text(name)));
    }
    return {name.end};
  }

  /// Whether the name is that of a property and `at`, in its line, begins its value: one that is
  /// complete, not the first of several words.
  bool lacks_colon(std::string_view name, std::uint32_t at) const {
    if (is_on_next_line_ || !is_property_name(name)) return false;
    const char c = text_[at];
    const bool opens = c == '(' || c == '[';
    const std::uint32_t end = opens         ? end_of_bracket(text_, at)
                              : c == '#'    ? end_of_identifier_rest(at + 1)
                              : is_digit(c) ? end_of_number(at)
                                            : token_at(text_, at).end;
    const bool is_whole = opens || c == '"' || c == '#' || is_digit(c) || is_letter(c);
    if (!is_whole || end == at) return false;
    const std::uint32_t next = skip_blanks(text_, end);
    const char behind = char_at(text_, next);
    if (is_letter(c) && behind == '(' && next == end) return true;
    const bool goes_on = std::string_view("*/^+").find(behind) != std::string_view::npos ||
                         text_.substr(next).starts_with("..");
    if (is_digit(c) && behind != '\0' && goes_on) return true;
    return behind == ',' || behind == '}' || behind == '\n' || behind == '\0' || behind == '/';
  }
  std::uint32_t end_of_identifier_rest(std::uint32_t at) const {
    while (is_idchar(char_at(text_, at))) ++at;
    return at;
  }
  std::uint32_t end_of_number(std::uint32_t at) const {
    while (is_idchar(char_at(text_, at)) || char_at(text_, at) == '.' ||
           char_at(text_, at) == '%') {
      ++at;
    }
    return at;
  }

  /// `scene 1` that is not the first statement.
  Resumption version(std::uint32_t number) {
    const std::uint32_t end = token_at(text_, number).end;
    if (builder_.has_version) {
      builder_.sink()
          .report(diag::expected, where({found_.begin, end}),
                  fmt::format("a statement, found `{}`", text({found_.begin, end})))
          .help("the version stands once, at the beginning of the file")
          .unsafe_fix(where({found_.begin, end}), "");
    }
    return here(end);
  }

  /// Past the names behind the first one of a path.
  std::uint32_t end_of_path(std::uint32_t at) const {
    while (char_at(text_, at) == '.' && is_letter(char_at(text_, at + 1))) {
      at = end_of_identifier(text_, at + 1);
    }
    return at;
  }

  /// Whether `name(…)` is a property without its colon: a space is between them, or the language
  /// has the property.
  bool lacks_colon(Span name, std::uint32_t open) const {
    if (open > name.end) return text(name).find('.') == std::string_view::npos;
    return std::ranges::any_of(all_kinds(), [&](const Kind& kind) {
      return std::ranges::find(kind.properties, text(name), &Property::name) !=
             kind.properties.end();
    });
  }

  /// A name, or a path, with a parenthesis behind it.
  std::uint32_t call_statement(std::uint32_t open) {
    const Span name = found_;
    const bool is_known = is_kind(word());
    const std::uint32_t end = end_of_bracket(text_, open);
    const bool is_labeled = end > open && has_labels({open + 1, end - 1});
    const bool holds_objects = builder_.in_group || !builder_.in_object;
    if (builder_.in_object && !is_labeled && !(holds_objects && is_known) &&
        lacks_colon(name, open)) {
      found_ = {open, open + 1};
      is_on_next_line_ = false;
      auto report = report_expected(fmt::format("`:` after `{}`", text(name)));
      report.help("a property is `name: value`");
      add_fix(report, is_property_name(text(name)), where({name.end, name.end}), ":");
      return name.end;
    }
    auto report = builder_.sink().report(diag::call_as_statement, where(name), word());
    const bool may_be_kind = is_known || word().find('.') != std::string_view::npos;
    if (!is_known || !holds_objects) {
      report.help("a call is a value, and a value stands behind `name:` or `let name =`");
    }
    if (!may_be_kind || !holds_objects) return name.end;
    report.help(fmt::format("an object is `{} {{ … }}`", word()));
    if (is_labeled && is_known) {
      report.fix(where({name.end, end}), fmt::format(" {{ {} }}", text({open + 1, end - 1})));
    }
    return name.end;
  }

  /// Whether it is a kind of object, of the language or of the file.
  bool is_kind(std::string_view name) const {
    const auto kinds = all_kinds();
    if (std::any_of(kinds.begin(), kinds.end(),
                    [&](const Kind& kind) { return kind.name == name; })) {
      return true;
    }
    if (!builder_.def_names) builder_.def_names = find_def_names();
    return builder_.def_names->contains(name);
  }

  std::unordered_set<std::string_view> find_def_names() const {
    constexpr std::string_view kDef = "def";
    std::unordered_set<std::string_view> names;
    for (std::size_t at = text_.find(kDef); at != std::string_view::npos;
         at = text_.find(kDef, at + 1)) {
      const auto end = static_cast<std::uint32_t>(at + kDef.size());
      const std::uint32_t name = skip_blanks(text_, end);
      if (name == end || !is_first_of_line(text_, static_cast<std::uint32_t>(at))) continue;
      names.insert(text({name, end_of_identifier(text_, name)}));
    }
    return names;
  }

  /// Whether each of the arguments has a label.
  bool has_labels(Span arguments) const {
    bool awaits_label = true;
    for (std::uint32_t i = skip_space(text_, arguments.begin); i < arguments.end;) {
      if (awaits_label) {
        const std::uint32_t colon = skip_space(text_, end_of_identifier(text_, i));
        if (!is_letter(text_[i]) || char_at(text_, colon) != ':') return false;
      }
      awaits_label = text_[i] == ',';
      const std::uint32_t behind = end_of_part(i);
      i = skip_space(text_, behind);
    }
    return arguments.size() > 0;
  }

  TreeBuilder& builder_;
  std::string_view text_;
  std::uint32_t at_;
  Span found_;
  bool is_on_next_line_ = false;  ///< what was found does not stand in the line of the last token
};

}  // namespace

void diagnose_expected(TreeBuilder& builder, std::uint32_t at, Expectation expectation) {
  Diagnosis(builder, at).expected(expectation);
}

Resumption diagnose_statement(TreeBuilder& builder, std::uint32_t at) {
  return Diagnosis(builder, at).statement();
}

namespace {

/// Whether the text has the word after something other than a number: as a name, however declared.
bool is_name_in(std::string_view text, std::string_view word) {
  TokenReader reader(text);
  TokenKind before = TokenKind::End;
  for (Token token = reader.next(); token.kind != TokenKind::End; token = reader.next()) {
    if (is_trivia(token.kind)) continue;
    const std::string_view written = text.substr(token.span.begin, token.span.size());
    if (token.kind == TokenKind::Name && before != TokenKind::Number && written == word) {
      return true;
    }
    before = token.kind;
  }
  return false;
}

/// Only units of one letter are likely to be names.
bool may_be_name(TreeBuilder& builder, std::string_view unit) {
  if (unit != "m" && unit != "s") return false;
  std::optional<bool>& answer = builder.uses_as_name[unit == "s" ? 1 : 0];
  if (!answer) answer = is_name_in(builder.text(), unit);
  return *answer;
}

}  // namespace

std::uint32_t diagnose_separate_unit(TreeBuilder& builder, Span number) {
  const std::string_view text = builder.text();
  if (!is_digit(text[number.end - 1]) && text[number.end - 1] != '.') return number.end;
  constexpr std::string_view kDegree = "°";
  const std::uint32_t at = skip_blanks(text, number.end);
  const bool is_degree = text.substr(at).starts_with(kDegree);
  const Span unit = token_at(text, at);
  const std::string_view written = is_degree ? "deg" : text.substr(at, unit.size());
  if (!is_degree && (at == number.end || !is_one_of(written, kUnits))) return number.end;
  const std::uint32_t next = skip_blanks(text, unit.end);
  const char c = char_at(text, next);
  // `m:` is a property, `m {` and `m name {` an object, and `a % b` a remainder.
  const bool is_other = written == "%" ? is_idchar(c) || c == '('
                                       : c == ':' || c == '(' || looks_like_object(text, at);
  if (!is_degree && is_other) return number.end;
  const Location where = builder.location({number.begin, unit.end});
  const std::string fixed = fmt::format("{}{}", text.substr(number.begin, number.size()), written);
  if (is_degree) {
    builder.sink().report(diag::foreign, builder.location(unit), kDegree).fix(where, fixed);
  } else {
    auto report = builder.sink().report(diag::separate_unit, where, written);
    // `2 s 3` lacks more than that, and `s` may be a name.
    const bool is_end = std::string_view(",)]}\n\r*/^<>=!&|;").find(c) != std::string_view::npos ||
                        c == '+' || c == '-' || next >= text.size() || is_letter(c);
    const bool is_sum = (c == '+' || c == '-') && written == "%";
    const bool is_word = is_letter(c) && !is_one_of(word_at(text, next), kJoints) &&
                         !looks_like_statement(text, next);
    add_fix(report, is_end && !is_sum && !is_word && !may_be_name(builder, written), where, fixed);
  }
  return unit.end;
}

// The header

namespace {

/// Where the line `scene N` begins that stands behind other statements; npos if there is none.
std::size_t find_version(std::string_view text, std::uint32_t from) {
  for (std::size_t at = text.find("scene ", from); at != std::string_view::npos;
       at = text.find("scene ", at + 1)) {
    const auto begin = static_cast<std::uint32_t>(at);
    const std::uint32_t number = skip_blanks(text, begin + 5);
    if (is_first_of_line(text, begin) && is_digit(char_at(text, number))) return at;
  }
  return std::string_view::npos;
}

/// Whether the word is `scene` but for capitals, or for one letter.
bool resembles_scene(std::string_view word) {
  return word.size() > 3 && nearest_name(word, std::span(&kScene, 1)).has_value();
}

}  // namespace

std::uint32_t skip_foreign_comments(TreeBuilder& builder, std::uint32_t at) {
  while (begins_foreign_comment(builder.text(), at)) {
    at = skip_space(builder.text(), foreign_comment(builder, at));
  }
  return at;
}

std::uint32_t diagnose_header(TreeBuilder& builder, std::uint32_t at) {
  const std::string_view text = builder.text();
  const Span found = token_at(text, at);
  const std::string_view word = text.substr(found.begin, found.size());
  const std::uint32_t next = skip_blanks(text, found.end);
  const bool has_number = is_digit(char_at(text, next));
  const auto missing = [&](Span span) {
    return builder.sink()
        .report(diag::missing_version, builder.location(span))
        .help("the first statement is `scene 1`");
  };

  if (word != kScene) {
    const std::string small = lower_case(word);
    const bool differs_by_case = small == kScene;
    if (word == "scene1") {
      missing(found).fix(builder.location(found), "scene 1");
      return skip_space(text, found.end);
    }
    if (has_number && (differs_by_case || resembles_scene(small))) {
      auto report = builder.sink().report(diag::expected, builder.location(found),
                                          fmt::format("`scene`, found `{}`", word));
      if (differs_by_case) report.fix(builder.location(found), std::string(kScene));
      if (!differs_by_case) report.suggest(kScene);
      return skip_space(text, token_at(text, next).end);
    }
    const std::size_t version = find_version(text, at);
    if (version == std::string_view::npos) {
      missing(found).fix(builder.location({at, at}), "scene 1\n");
      return at;
    }
    const auto begin = static_cast<std::uint32_t>(version);
    const std::uint32_t end = token_at(text, skip_blanks(text, begin + 5)).end;
    const Location later = builder.location({begin, end});
    builder.sink()
        .report(diag::missing_version, builder.location(found))
        .label(later, "this must be the first statement")
        .help(
            fmt::format("move `{}` to the beginning of the file", text.substr(begin, end - begin)))
        .unsafe_fix(builder.location({at, at}),
                    fmt::format("{}\n", text.substr(begin, end - begin)))
        .unsafe_fix(later, "");
    return at;
  }

  // `scene` without a number, or with one that is none of a version.
  const std::uint32_t version = skip_space(text, found.end);
  std::uint32_t end = version;
  while (is_idchar(char_at(text, end)) || char_at(text, end) == '.') ++end;
  if (end > version && text[version] == '1' && is_letter(char_at(text, version + 1))) {
    const std::uint32_t gap = version + 1;
    builder.sink()
        .report(diag::expected, builder.location({gap, gap}),
                fmt::format("a new line after `scene 1`, found `{}`", text.substr(gap, end - gap)))
        .unsafe_fix(builder.location({gap, gap}), "\n");
    return gap;
  }
  if (end > version && is_digit(text[version])) {
    const Location where = builder.location({version, end});
    builder.sink().report(diag::unsupported_version, where, text.substr(version, end - version));
    return skip_space(text, end);
  }
  const char mark = char_at(text, next);
  const std::uint32_t number = skip_blanks(text, next + 1);
  if ((mark == ':' || mark == '=') && is_digit(char_at(text, number))) {
    const Span all{found.begin, token_at(text, number).end};
    auto report = missing(all);
    if (text.substr(number, all.end - number) == "1") report.fix(builder.location(all), "scene 1");
    return skip_space(text, all.end);
  }
  auto report = missing(found);
  const bool is_alone = mark == '\0' || mark == '\n' || mark == '\r' || mark == '/';
  if (is_alone) report.fix(builder.location(found), "scene 1");
  return skip_space(text, found.end);
}

}  // namespace sdlc::lang
