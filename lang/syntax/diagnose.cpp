#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "lang/syntax/habits.hpp"
#include "lang/syntax/recovery.hpp"
#include "lang/syntax/scan.hpp"
#include "lang/syntax/tree_builder.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kUnits =
    std::to_array<std::string_view>({"deg", "rad", "turn", "mm", "ms", "cm", "km", "m", "s", "%"});

class Diagnosis {
 public:
  Diagnosis(TreeBuilder& builder, std::uint32_t at)
      : builder_(builder), text_(builder.text()), at_(at), found_(token_at(text_, at)) {
    const std::uint32_t end = std::min(builder.token_end(), at);
    is_on_next_line_ = text_.substr(end, at - end).find('\n') != std::string_view::npos;
  }

  void expected(std::string_view words) {
    if (separate_unit() || habit() || single_quotes() || missing_value(words)) return;
    const bool goes_on = words.starts_with("a block") || words.starts_with("`then`") ||
                         words.starts_with("`,` and a message") || words.ends_with("`)`") ||
                         words.ends_with("`]`");
    if (goes_on && assignment()) return;
    const bool wants_is = words.starts_with("`=`");
    // Behind a comma the bracket does not close yet.
    const bool behind_comma = words.starts_with("`,` or") && at_ > 0 && last_char() == ',';
    auto report = report_expected(behind_comma ? "a value" : words);
    if (wants_is && char_at(text_, at_) == ':') report.fix(where(found_), "=");
    if (words == "a type after `:`" && is_value(char_at(text_, at_))) {
      const std::uint32_t colon = builder_.token_end() - 1;
      report.help("a default follows `=`").unsafe_fix(where({colon, colon + 1}), "=");
    }
    if (words == "a block in braces" && word() == "then") {
      report.help("`if … then …` is a value; a statement is `if … { … }`");
    }
    if (words == "one comparison, not a chain") report.help("write `a < b and b < c`");
    if (words.ends_with("`)`") || words.ends_with("`]`")) {
      report.label(where({builder_.opener, builder_.opener + 1}), "opened here");
      const std::uint32_t end = builder_.token_end();
      const bool is_next_value = is_value(char_at(text_, at_)) && !looks_like_statement(text_, at_);
      if (!behind_comma && is_next_value) {
        if (!is_on_next_line_) builder_.poison_last_name();
        report.help("commas stand between values").fix(where({end, end}), ",");
      }
    }
    if (words.ends_with("in quotes after `import`") ||
        words.ends_with("in quotes after `include`")) {
      report.help("a file name is a string, known without evaluating anything");
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
    const bool is_comment = is_first_of_line(text_, at_) || !is_idchar(char_at(text_, at_ + 1));
    if (c == '#' && is_comment) return here(hash_comment());
    if (c == ';' && habit()) return here(found_.end);
    if (separate_unit() || habit() || assignment()) {
      builder_.poison_last_statement();
      return {found_.end};
    }
    poison_what_goes_on();
    if (is_letter(c)) return {word_statement()};
    is_on_next_line_ = false;
    report_expected("a statement");
    return {c == '#' ? end_of_identifier(text_, at_ + 1) : found_.end};
  }

 private:
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
    return fmt::format("`{}`", token.size() <= 40 ? token : token.substr(0, 1));
  }

  /// What is missing at the end of a line is reported there, not at whatever the next line begins
  /// with.
  DiagnosticBuilder report_expected(std::string_view words) {
    const std::uint32_t end = builder_.token_end();
    const Span place = is_on_next_line_ || found_.size() == 0 ? Span{end, end} : found_;
    return builder_.sink().report(diag::expected, where(place),
                                  fmt::format("{}, found {}", words, found_text()));
  }

  /// The reader stops inside some of the habits: behind the first `*` of `**`, the second `=` of
  /// `===`.
  bool habit() {
    for (std::uint32_t read = std::min<std::uint32_t>(2, at_);; --read) {
      const std::string_view rest = text_.substr(std::min<std::size_t>(at_ - read, text_.size()));
      const auto found = std::find_if(kHabits.begin(), kHabits.end(), [&](const Habit& habit) {
        return habit.text.size() > read && rest.starts_with(habit.text);
      });
      const bool is_known =
          found != kHabits.end() && !(found->text == "!" && rest.starts_with("!="));
      if (is_known) return report_habit(*found, at_ - read);
      if (read == 0) return false;
    }
  }

  bool report_habit(const Habit& habit, std::uint32_t begin) {
    const Span span{begin, begin + static_cast<std::uint32_t>(habit.text.size())};
    auto report = builder_.sink().report(diag::foreign, where(span), habit.text);
    report.help(std::string(habit.help));
    if (!habit.replacement.empty() || habit.deletes) {
      report.fix(where(span), std::string(habit.replacement));
    }
    found_.end = span.end;
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
    if (is_closed) {
      report.fix(where(span), fmt::format("\"{}\"", text({span.begin + 1, span.end - 1})));
    }
    return true;
  }

  /// `2 m`, `40 °` and the like: a number, a blank, a unit.
  bool separate_unit() {
    const std::string_view unit = text(found_);
    const std::uint32_t end = builder_.token_end();
    const bool is_unit = std::find(kUnits.begin(), kUnits.end(), unit) != kUnits.end();
    if (!is_unit || end == 0 || end >= at_ || !is_digit(text_[end - 1])) return false;
    if (unit == "%" && is_idchar(char_at(text_, skip_blanks(text_, found_.end)))) return false;
    std::uint32_t begin = end;
    while (begin > 0 &&
           (is_digit(text_[begin - 1]) || text_[begin - 1] == '.' || text_[begin - 1] == '_')) {
      --begin;
    }
    if (begin > 0 && is_letter(text_[begin - 1])) return false;
    const Span number{begin, end};
    builder_.sink()
        .report(diag::separate_unit, where({begin, found_.end}), unit)
        .fix(where({begin, found_.end}), fmt::format("{}{}", text(number), unit));
    return true;
  }

  /// `center:` with the next property, or nothing, behind it.
  bool missing_value(std::string_view words) {
    if (words != "a value after `:`") return false;
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

  std::uint32_t hash_comment() {
    const auto end = static_cast<std::uint32_t>(std::min(text_.find('\n', at_), text_.size()));
    builder_.sink()
        .report(diag::foreign, where({at_, at_ + 1}), "#")
        .help("comments begin with `//`")
        .fix(where({at_, at_ + 1}), "//");
    return end;
  }

  std::uint32_t word_statement() {
    const std::uint32_t next = skip_space(text_, found_.end);
    const char c = char_at(text_, next);
    const Span name = found_;
    if (word() == "else" || word() == "then") {
      builder_.sink().report(diag::expected, where(name),
                             fmt::format("a statement, found `{}`; it belongs to an `if`", word()));
      return name.end;
    }
    if (c == '=' && char_at(text_, next + 1) != '=') {
      auto report = builder_.sink().report(diag::foreign, where({next, next + 1}), "=");
      if (builder_.in_object) {
        report.help("a property is `name: value`").fix(where({name.end, next + 1}), ":");
      } else {
        report.help("a value gets its name by `let name = value`")
            .unsafe_fix(where({name.begin, name.begin}), "let ");
      }
      return next + 1;
    }
    if (c == '(') {
      const std::uint32_t end = end_of_bracket(text_, next);
      auto report = builder_.sink().report(diag::call_as_statement, where(name), word());
      report.help(fmt::format("an object is `{} {{ … }}`", word()));
      if (end > next) {
        report.fix(where({name.end, end}), fmt::format(" {{ {} }}", text({next + 1, end - 1})));
      }
      return name.end;
    }
    if (is_digit(last_char()) && (c == ',' || c == '}')) {
      builder_.poison_last_statement();
      builder_.sink()
          .report(diag::foreign, where(name), word())
          .help(fmt::format("units are {}", fmt::join(kUnits, ", ")));
      return name.end;
    }
    found_ = token_at(text_, next);
    is_on_next_line_ = text_.substr(name.end, next - name.end).find('\n') != std::string_view::npos;
    builder_.end_token(name.end);
    auto report = report_expected(fmt::format("`:` or `{{` after `{}`", text(name)));
    if (is_value(c) && builder_.in_object) report.fix(where({name.end, name.end}), ":");
    return name.end;
  }

  TreeBuilder& builder_;
  std::string_view text_;
  std::uint32_t at_;
  Span found_;
  bool is_on_next_line_ = false;  ///< what was found does not stand in the line of the last token
};

}  // namespace

void diagnose_expected(TreeBuilder& builder, std::uint32_t at, std::string_view words) {
  Diagnosis(builder, at).expected(words);
}

Resumption diagnose_statement(TreeBuilder& builder, std::uint32_t at) {
  return Diagnosis(builder, at).statement();
}

std::uint32_t diagnose_header(TreeBuilder& builder, std::uint32_t at) {
  const std::string_view text = builder.text();
  const Span found = token_at(text, at);
  if (text.substr(found.begin, found.size()) != "scene") {
    builder.sink()
        .report(diag::missing_version, builder.location(found))
        .help("the first statement is `scene 1`")
        .fix(builder.location({at, at}), "scene 1\n");
    return at;
  }
  // `scene` without a number, or with one that is none of a version.
  const std::uint32_t version = skip_space(text, found.end);
  std::uint32_t end = version;
  while (is_idchar(char_at(text, end)) || char_at(text, end) == '.') ++end;
  if (end > version && is_digit(text[version])) {
    const Location where = builder.location({version, end});
    builder.sink().report(diag::unsupported_version, where, text.substr(version, end - version));
    return skip_space(text, end);
  }
  builder.sink()
      .report(diag::missing_version, builder.location(found))
      .help("the first statement is `scene 1`")
      .fix(builder.location(found), "scene 1");
  return skip_space(text, found.end);
}

}  // namespace sdlc::lang
