#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/recovery.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/schema/type_names.hpp"
#include "lang/syntax/tree_builder.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/utf8.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kComputedList =
    "a computed list is `[x^2 for x in list]`, with conditions at the end: `… if x > 0]`";

/// Reports what the grammar expected and did not find. Mistakes that need knowledge of other
/// languages are repaired before (lang/repair).
class Diagnosis {
 public:
  Diagnosis(TreeBuilder& builder, std::uint32_t at)
      : builder_(builder), text_(builder.text()), at_(at), found_(token_at(text_, at)) {
    const std::uint32_t end = std::min(builder.token_end(), at);
    is_on_next_line_ = text_.substr(end, at - end).find('\n') != std::string_view::npos;
  }

  void expected(Expectation expectation) {
    const Wanted wanted = expectation.wanted;
    if (missing_value(wanted)) return;
    // After a comma the bracket does not close yet.
    const bool follows_comma = last_char() == ',';
    auto report =
        report_expected(follows_comma && ends_values(wanted) ? "a value" : expectation.words);
    explain(report, wanted);
    if (is_in_computed_list()) builder_.poison_since(builder_.opener + 1);
    if (!is_closing(wanted)) return;
    report.label(where({builder_.opener, builder_.opener + 1}), "opened here");
    if (wanted == Wanted::GroupEnd && commas_in_group() > 1) {
      report.help("a point has three values");
    } else if (wanted != Wanted::ClausesEnd && !follows_comma && begins_separate_value() &&
               !looks_like_statement(text_, at_)) {
      if (!is_on_next_line_) builder_.poison_last_name();
      const std::uint32_t end = builder_.token_end();
      report.help("separate values with commas");
      if (end < at_) report.unsafe_fix(where({end, end}), ",");
    }
  }

  Resumption statement() {
    if (builder_.is_reported(at_)) {
      if (!is_on_next_line_) builder_.poison_last_statement();
      return {found_.end};
    }
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
    if (!is_on_next_line_ && last_char() != ',' && begins_value()) {
      builder_.poison_last_statement();  // perhaps this is a part of it
    }
    if (is_letter(c)) return word_statement();
    is_on_next_line_ = false;
    report_expected("a statement");
    return {c == '#' ? end_of_identifier(text_, at_ + 1) : found_.end};
  }

 private:
  static bool is_closing(Wanted wanted) {
    return ends_values(wanted) || wanted == Wanted::GroupEnd || wanted == Wanted::IndexEnd ||
           wanted == Wanted::ClausesEnd || wanted == Wanted::PatternEnd;
  }
  static bool ends_values(Wanted wanted) {
    return wanted == Wanted::ParametersEnd || wanted == Wanted::ArgumentsEnd ||
           wanted == Wanted::ListEnd;
  }

  /// Adds what to write instead, if the token suggests it.
  void explain(DiagnosticBuilder& report, Wanted wanted) {
    const char c = char_at(text_, at_);
    switch (wanted) {
      case Wanted::FunctionIs:
        if (c == '{') report.help_if(kFunction);
        [[fallthrough]];
      case Wanted::Is:
        if (c == ':') fix_colon(report);
        break;
      case Wanted::Type:
        if (begins_value()) {
          const std::uint32_t colon = builder_.token_end() - 1;
          report.help("a default follows `=`").unsafe_fix(where({colon, colon + 1}), "=");
        }
        break;
      case Wanted::Name:
        if (c == '(') report.help_if(kNoLoop);
        if (!is_ascii(c)) report.help_if(kNameLetters);
        if (is_one_of(word(), kReservedWords)) {
          report.help(fmt::format("`{}` is a word of the language and cannot be a name", word()));
        }
        break;
      case Wanted::In:
        if (c == '=') report.help_if(kNoLoop);
        if (word() == "of") {
          report.fix(where(found_), "in");
        } else if (text_.substr(0, builder_.token_end()).ends_with(" in")) {
          report.help("a name comes before `in`: `for x in list`");
        } else if (begins_value() && !is_on_next_line_) {
          report.unsafe_fix(where({at_, at_}), "in ");
        }
        break;
      case Wanted::LetIn: explain_let_in(report); break;
      case Wanted::SecondName:
        report.help("a name alone needs no parentheses");
        if (c == ')') {
          report.fix(where({builder_.opener, builder_.opener + 1}), "").fix(where(found_), "");
        }
        break;
      case Wanted::LoopBlock: explain_loop_block(report); break;
      case Wanted::ArgumentsEnd:
      case Wanted::GroupEnd:
        if (word() == "for" && !is_on_next_line_) report.help_if(kComputedList);
        break;
      case Wanted::ListEnd: explain_list_end(report); break;
      case Wanted::ClausesEnd: explain_clauses_end(report); break;
      case Wanted::Block: explain_block(report); break;
      case Wanted::SecondOperand: report.help("write `a < b and b < c`"); break;
      case Wanted::FileName:
        report.help("a file name is a string, known without evaluating anything");
        break;
      default: break;
    }
  }

  void explain_block(DiagnosticBuilder& report) {
    if (char_at(text_, at_) == ':') report.help("a block is in braces");
    if (word() == "then") report.help("`if … then …` is a value; a statement is `if … { … }`");
  }

  // Comprehensions

  /// Names in it may be those of a loop that could not be read.
  bool is_in_computed_list() const {
    if (builder_.brackets == 0) return false;
    if (word() == "for" && !is_on_next_line_) return true;
    if (text_[builder_.opener] != '[') return false;
    if (word() == "in" || word() == "if" || word() == "|") return !is_on_next_line_;
    const auto nodes = builder_.nodes();
    for (auto node = nodes.rbegin(); node != nodes.rend() && node->begin > builder_.opener;
         ++node) {
      if (node->kind == SyntaxKind::ForClause) return true;
    }
    return false;
  }

  /// `a: x for x in xs`, which lacks the brackets.
  void explain_loop_block(DiagnosticBuilder& report) {
    explain_block(report);
    const auto nodes = builder_.nodes();
    const auto loop = std::find_if(nodes.rbegin(), nodes.rend(), [](const SyntaxNode& node) {
      return node.kind == SyntaxKind::For;
    });
    if (loop == nodes.rend()) return;
    const std::string_view before = text_.substr(0, loop->begin);
    const std::size_t last = before.find_last_not_of(" \t");
    const bool follows_value =
        last != std::string_view::npos && std::string_view("\n{},").find(before[last]) > 3;
    if (!follows_value) return;
    report.help_if(kComputedList);
    builder_.poison_last_statement();
    builder_.node(builder_.size() - 1 - static_cast<NodeIndex>(loop - nodes.rbegin())).kind =
        SyntaxKind::Error;
  }

  /// `[for x in xs x]`, `[x in xs]`, `[x | x <- xs]`, `[x if c for x in xs]`
  void explain_list_end(DiagnosticBuilder& report) {
    if (is_on_next_line_) return;
    if (word() != "for" && word() != "in" && word() != "if" && word() != "|") return;
    report.help_if(kComputedList);
    TokenReader tokens(text_, found_.end);
    const Token second = tokens.next_solid(), third = tokens.next_solid();
    if (word() == "|" && text_.substr(third.span.begin).starts_with("<-")) {
      report.fix(where(found_), "for").fix(where({third.span.begin, third.span.begin + 2}), "in");
    } else if (word() == "in" && is_letter(char_at(text_, builder_.opener + 1))) {
      const Span name{builder_.opener + 1, end_of_identifier(text_, builder_.opener + 1)};
      if (name.end != builder_.token_end()) return;
      report.unsafe_fix(where({at_, at_}), fmt::format("for {} ", text(name)));
    } else if (word() == "if") {
      move_condition(report, second.span.begin);
    }
  }

  /// The condition at `begin` comes before its `for`: it moves to the end of the list.
  void move_condition(DiagnosticBuilder& report, std::uint32_t begin) {
    TokenReader tokens(text_, begin);
    int depth = 0;
    Span condition{begin, begin};
    std::uint32_t loop = 0;
    for (Token token = tokens.next_solid(); token.kind != TokenKind::End;
         token = tokens.next_solid()) {
      const std::string_view word = tokens.text(token);
      if (depth == 0 && word == "else") report.help("a choice is `if … then … else …`");
      if (depth == 0 && (word == "else" || word == "then")) return;
      if (depth == 0 && word == "for" && loop == 0) loop = token.span.begin;
      if (loop == 0) condition.end = token.span.end;
      depth += (token.kind == TokenKind::Open) - (token.kind == TokenKind::Close);
      if (depth >= 0) continue;
      if (loop == 0 || word != "]") return;
      const std::uint32_t end = token.span.begin;
      report.fix(where({at_, loop}), "")
          .fix(where({end, end}), fmt::format(" if {}", text(condition)));
      return;
    }
  }

  /// `[x for x in xs,]` and `[x for x in xs if c else y]`
  void explain_clauses_end(DiagnosticBuilder& report) {
    const bool is_comma = char_at(text_, at_) == ',';
    if (word() == "else") {
      report.help("an `if` after `for` only selects; `[if c then x else y for x in list]` chooses");
    } else if (is_comma && char_at(text_, skip_space(text_, found_.end)) == ']') {
      report.fix(where(found_), "");
    } else if (is_comma) {
      report.help("a computed list has one value before its `for`");
    }
  }

  /// A comma before the next name, or the `in` before the value, is missing.
  void explain_let_in(DiagnosticBuilder& report) {
    report.help("a value with local names is `let a = 1, b = 2 in a + b`");
    if (is_on_next_line_ || !begins_value()) return;
    const std::uint32_t end = builder_.token_end();
    const std::uint32_t next = skip_blanks(text_, found_.end);
    const bool is_name = is_letter(char_at(text_, at_)) && char_at(text_, next) == '=' &&
                         char_at(text_, next + 1) != '=';
    if (is_name) {
      report.unsafe_fix(where({end, end}), ",");
    } else if (end < at_) {
      report.unsafe_fix(where({end, end}), " in");
    }
  }

  /// `let a: 1` and `let a := 1`; if a type follows, the value is missing.
  void fix_colon(DiagnosticBuilder& report) {
    const bool is_assignment = char_at(text_, found_.end) == '=';
    const Span sign{found_.begin, found_.end + (is_assignment ? 1 : 0)};
    const Span next = token_at(text_, skip_blanks(text_, sign.end));
    if (!is_type_name(text(next))) report.fix(where(sign), "=");
  }

  /// The commas of the parenthesis around this place.
  std::size_t commas_in_group() const {
    std::size_t commas = 0;
    int depth = 0;
    TokenReader tokens(text_, builder_.opener + 1);
    for (Token token = tokens.next(); token.span.begin < at_; token = tokens.next()) {
      depth += (token.kind == TokenKind::Open) - (token.kind == TokenKind::Close);
      commas += depth == 0 && tokens.text(token) == ",";
    }
    return commas;
  }

  /// Continues with the statement after the spaces at `end`.
  Resumption here(std::uint32_t end) const { return {skip_blanks(text_, end), true}; }
  Location where(Span span) const { return builder_.location(span); }
  std::string_view text(Span span) const { return text_.substr(span.begin, span.size()); }
  std::string_view word() const { return text(found_); }
  char last_char() const {
    const std::uint32_t end = builder_.token_end();
    return end == 0 ? '\0' : text_[end - 1];
  }

  bool begins_value() const {
    const char c = char_at(text_, at_);
    return is_idchar(c) || (c != '\0' && std::string_view("\"#[(-.").find(c) < 6);
  }

  /// Whether the word or sign can only begin a value: a comma may be missing before it.
  bool begins_separate_value() const {
    return begins_value() && !is_one_of(word(), kJoints) && word() != "for";
  }

  std::string found_text() const {
    if (is_on_next_line_) return "the end of the line";
    if (found_.size() == 0) return "the end of the file";
    if (builder_.is_added(found_.begin)) return "the end of the block";
    const std::string_view token = text(found_);
    return fmt::format("`{}`",
                       token.size() <= 40 ? token : token.substr(0, decode_utf8(token).size));
  }

  /// What is missing at the end of a line is reported there, not at the first token of the next.
  DiagnosticBuilder report_expected(std::string_view words) {
    const std::uint32_t end = builder_.token_end();
    const Span place = is_on_next_line_ || found_.size() == 0 ? Span{end, end} : found_;
    return builder_.sink().report(diag::expected, where(place),
                                  fmt::format("{}, found {}", words, found_text()));
  }

  /// `center:` followed by the next property or nothing.
  bool missing_value(Wanted wanted) {
    if (wanted != Wanted::LabeledValue) return false;
    const std::uint32_t next = skip_blanks(text_, found_.end);
    const bool is_label = is_letter(char_at(text_, at_)) && char_at(text_, next) == ':';
    const bool is_end =
        found_.size() == 0 || text(found_) == "}" || text(found_) == "," || text(found_) == ")";
    if (!is_label && !is_end) return false;
    // The node before the error marker owns the last label.
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
    const Span name = found_;
    if (word() == "scene" && is_digit(char_at(text_, next))) return version(next);
    if (word() == "else" || word() == "then") {
      builder_.sink().report(diag::expected, where(name),
                             fmt::format("a statement, found `{}`; it belongs to an `if`", word()));
      return {name.end};
    }
    if (const auto habit = find_habit(HabitPlace::StatementWord, word())) {
      is_on_next_line_ = false;
      report_expected("a statement").help_if(habit->help);
      return {name.end};
    }
    if (char_at(text_, next) == '(') {
      builder_.sink()
          .report(diag::call_as_statement, where(name), word())
          .help("a call is a value; a value follows `name:` or `let name =`");
      return {name.end};
    }
    found_ = token_at(text_, next);
    if (builder_.is_reported(found_.begin)) return {name.end};
    is_on_next_line_ = text_.substr(name.end, next - name.end).find('\n') != std::string_view::npos;
    builder_.end_token(name.end);
    auto report = report_expected(fmt::format("`:` or `{{` after `{}`", text(name)));
    if (builder_.in_object && char_at(text_, next) == '}') {
      report.help(fmt::format("a property is `name: value`, such as `color: {}`", text(name)));
    }
    return {name.end};
  }

  /// `scene 1` that is not the first statement.
  Resumption version(std::uint32_t number) {
    const Span version{found_.begin, token_at(text_, number).end};
    if (builder_.has_version) {
      builder_.sink()
          .report(diag::expected, where(version),
                  fmt::format("a statement, found `{}`", text(version)))
          .help("the version is given once, at the beginning of the file")
          .unsafe_fix(where(version), "");
    }
    return here(version.end);
  }

  TreeBuilder& builder_;
  std::string_view text_;
  std::uint32_t at_;
  Span found_;
  bool is_on_next_line_ = false;  ///< whether a line ends before the found token
};

}  // namespace

void diagnose_expected(TreeBuilder& builder, std::uint32_t at, Expectation expectation) {
  if (!builder.is_reported(at)) Diagnosis(builder, at).expected(expectation);
}

Resumption diagnose_statement(TreeBuilder& builder, std::uint32_t at) {
  return Diagnosis(builder, at).statement();
}

}  // namespace sdlc::lang
