#include "lang/syntax/layout.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

#include "lang/syntax/habits.hpp"
#include "lang/syntax/scan.hpp"

namespace sdlc::lang {
namespace {

template <std::size_t kSize>
bool is_one_of(std::string_view word, const std::array<std::string_view, kSize>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

constexpr auto kDeclarations =
    std::to_array<std::string_view>({"let", "fn", "def", "param", "import", "include", "assert"});
/// Words behind which an expression must go on, and words that carry one on.
constexpr auto kJoints =
    std::to_array<std::string_view>({"and", "or", "not", "in", "then", "else", "if", "as"});

/// Whether one letter was left out, typed twice or wrongly, or swapped with the next.
bool is_one_slip(std::string_view written, std::string_view word) {
  if (written == word || word.size() < 2) return false;
  const auto mismatch = std::mismatch(written.begin(), written.end(), word.begin(), word.end());
  const std::string_view a(mismatch.first, written.end()), b(mismatch.second, word.end());
  if (a.size() == b.size()) {
    const bool is_swapped =
        a.size() > 1 && a[0] == b[1] && a[1] == b[0] && a.substr(2) == b.substr(2);
    return is_swapped || a.substr(1) == b.substr(1);
  }
  return a.size() > b.size() ? a.substr(1) == b : a == b.substr(1);
}

/// Splits the text into tokens, each known by itself.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::vector<LayoutToken> run() {
    while (skip_blanks_and_comments()) read();
    return std::move(tokens_);
  }

 private:
  bool skip_blanks_and_comments() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      const std::uint32_t behind = end_of_comment(text_, at_);
      if (c == '\n') {
        ++line_;
        indent_ = skip_blanks(text_, at_ + 1) - (at_ + 1);
        is_first_ = true;
        ++at_;
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++at_;
      } else if (c == '#' && !begins_color()) {
        at_ = static_cast<std::uint32_t>(std::min(text_.find('\n', at_), text_.size()));
      } else if (behind > at_) {
        line_ += static_cast<std::uint32_t>(
            std::count(text_.begin() + at_, text_.begin() + behind, '\n'));
        at_ = behind;
      } else {
        return true;
      }
    }
    return false;
  }

  /// Whether the `#` begins a colour, not a comment by habit.
  bool begins_color() const {
    const std::uint32_t size = end_of_word(at_ + 1) - at_ - 1;
    return is_first_ ? size == 3 || size == 6 : size > 0;
  }

  void read() {
    const char c = text_[at_];
    const std::uint32_t begin = at_;
    if (c == '"') return add(begin, end_of_written_string(), LayoutKind::Value);
    if (is_letter(c)) return read_word();
    const bool is_number = is_digit(c) || (c == '.' && is_digit(char_at(text_, at_ + 1)));
    if (is_number) return add(begin, end_of_number(), LayoutKind::Value);
    if (c == '#') return add(begin, end_of_word(at_ + 1), LayoutKind::Value);
    if (c == ',') return add(begin, at_ + 1, LayoutKind::Comma);
    const bool opens = c == '(' || c == '[' || c == '{';
    const bool closes = c == ')' || c == ']' || c == '}';
    add(begin, end_of_sign(),
        opens    ? LayoutKind::Open
        : closes ? LayoutKind::Close
                 : LayoutKind::Operator);
    if (opens || closes) tokens_.back().bracket = c;
  }

  void read_word() {
    const std::uint32_t begin = at_;
    std::uint32_t end = end_of_identifier(text_, begin);
    while (char_at(text_, end) == '.' && is_letter(char_at(text_, end + 1))) {
      end = end_of_identifier(text_, end + 1);
    }
    const std::uint32_t colon = skip_blanks(text_, end);
    const bool is_declared = !tokens_.empty() && word_of(tokens_.back()) == "param";
    if (char_at(text_, colon) == ':' && !is_declared) {
      add(begin, colon + 1, LayoutKind::Label);
    } else {
      add(begin, end, LayoutKind::Value);
    }
  }

  /// `==` and the like are one sign, and so are those of other languages, and a character of
  /// several bytes.
  std::uint32_t end_of_sign() const {
    const std::string_view rest = text_.substr(at_);
    std::size_t size = token_at(text_, at_).size();
    for (const std::string_view sign : {"==", "!=", "<=", ">="}) {
      if (rest.starts_with(sign)) size = 2;
    }
    for (const Habit& habit : kHabits) {
      if (rest.starts_with(habit.text)) size = std::max(size, habit.text.size());
    }
    return at_ + static_cast<std::uint32_t>(size);
  }

  std::string_view word_of(const LayoutToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }
  std::uint32_t end_of_word(std::uint32_t at) const {
    while (is_idchar(char_at(text_, at))) ++at;
    return at;
  }
  std::uint32_t end_of_number() const {
    std::uint32_t end = at_;
    while (is_idchar(char_at(text_, end)) || char_at(text_, end) == '%' ||
           (char_at(text_, end) == '.' && char_at(text_, end + 1) != '.')) {
      ++end;
    }
    return end;
  }
  /// A string that is never closed ends where its reader goes on.
  std::uint32_t end_of_written_string() const {
    const std::uint32_t end = end_of_string(text_, at_);
    return end > at_ + 1 && text_[end - 1] == '"' ? end : end_of_unclosed_string(text_, at_);
  }

  void add(std::uint32_t begin, std::uint32_t end, LayoutKind kind) {
    tokens_.push_back({.begin = begin,
                       .end = end,
                       .line = line_,
                       .indent = indent_,
                       .kind = kind,
                       .is_first = is_first_});
    is_first_ = false;
    at_ = end;
  }

  std::string_view text_;
  std::vector<LayoutToken> tokens_;
  std::uint32_t at_ = 0;
  std::uint32_t line_ = 0;
  std::uint32_t indent_ = 0;
  bool is_first_ = true;
};

/// Finds pairs of brackets of the wrong kind, and makes them those that were meant: braces around
/// arguments, parentheses around a block.
class PairMarker {
 public:
  PairMarker(std::string_view text, std::vector<LayoutToken>& tokens)
      : text_(text), tokens_(tokens) {}

  void run() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == LayoutKind::Open) open.push_back(i);
      if (tokens_[i].kind != LayoutKind::Close || open.empty()) continue;
      if (is_pair(tokens_[open.back()].bracket, tokens_[i].bracket)) check(open.back(), i);
      open.pop_back();
    }
  }

 private:
  static bool is_pair(char open, char close) {
    return (open == '(' && close == ')') || (open == '[' && close == ']') ||
           (open == '{' && close == '}');
  }

  void check(std::size_t open, std::size_t close) {
    if (open < 2 || !is_name(open - 1)) return;
    bool is_one_line = tokens_[open].line == tokens_[close].line;
    for (std::size_t i = open + 1; i < close; ++i) {
      is_one_line = is_one_line && tokens_[i].bracket != '{';
    }
    const bool are_arguments =
        (tokens_[open].bracket == '{' && is_one_line && is_value(open, close)) ||
        (tokens_[open].bracket == '[' && is_label(open + 1));
    if (are_arguments) return set(open, close, "(", ")");
    const bool begins_line =
        tokens_[open - 1].is_first || (tokens_[open - 2].is_first && is_name(open - 2));
    const bool has_lines = is_label(open + 1) && tokens_[open + 1].is_first;
    if (tokens_[open].bracket == '(' && begins_line && has_lines) set(open, close, "{", "}");
  }

  void set(std::size_t open, std::size_t close, std::string_view opening,
           std::string_view closing) {
    tokens_[open].meant = opening;
    tokens_[open].bracket = opening[0];
    tokens_[close].meant = closing;
    tokens_[close].bracket = closing[0];
  }

  /// Whether the name in front of the brace stands where a value does.
  bool is_value(std::size_t open, std::size_t close) const {
    const LayoutToken& before = tokens_[open - 2];
    if (before.kind == LayoutKind::Label || before.bracket == '(' || before.bracket == '[') {
      return true;
    }
    const bool is_list = word_of(before) == "in";
    return is_list && close + 1 < tokens_.size() && tokens_[close + 1].bracket == '{';
  }

  bool is_label(std::size_t i) const {
    return i < tokens_.size() && tokens_[i].kind == LayoutKind::Label;
  }
  bool is_name(std::size_t i) const {
    return tokens_[i].kind == LayoutKind::Value && is_letter(text_[tokens_[i].begin]) &&
           !is_one_of(word_of(tokens_[i]), kJoints);
  }
  std::string_view word_of(const LayoutToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }

  std::string_view text_;
  std::vector<LayoutToken>& tokens_;
};

/// Finds out what each token is among its neighbours.
class Marker {
 public:
  Marker(std::string_view text, std::vector<LayoutToken>& tokens) : text_(text), tokens_(tokens) {}

  void run() {
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      LayoutToken& token = tokens_[at_];
      if (token.meant.empty()) token.meant = meant();
      token.is_call = token.meant == ":" && inside_.back() == 'c';
      token.continues = continues();
      const bool was_header = is_header_ && is_new_line();
      if (was_header) is_header_ = false;
      mark_statement();
      token.continues = continues();
      if (token.kind == LayoutKind::Open) mark_opening();
      if (token.kind == LayoutKind::Comma) token.is_stray = is_stray_comma();
      if (text_of(&token) == "=") token.defines = true;
      token.is_apart = is_apart();
      follow_brackets();
      token.wanted = was_header ? '{' : wanted();
      token.may_open = may_open();
      token.is_callable = token.kind == LayoutKind::Value && is_name(&token);
    }
  }

 private:
  // Neighbours, of which there may be none

  const LayoutToken* near(std::ptrdiff_t n) const {
    const auto index = static_cast<std::ptrdiff_t>(at_) + n;
    const bool is_there = index >= 0 && index < static_cast<std::ptrdiff_t>(tokens_.size());
    return is_there ? &tokens_[static_cast<std::size_t>(index)] : nullptr;
  }
  std::string_view text_of(const LayoutToken* token) const {
    if (token == nullptr) return {};
    if (!token->meant.empty()) return token->meant;
    return text_.substr(token->begin, token->end - token->begin);
  }
  static bool is(const LayoutToken* token, LayoutKind kind) {
    return token != nullptr && token->kind == kind;
  }
  static bool is_bracket(const LayoutToken* token, char bracket) {
    return token != nullptr && token->bracket == bracket;
  }
  bool is_word(const LayoutToken* token) const {
    return (is(token, LayoutKind::Value) || is(token, LayoutKind::Statement)) &&
           is_letter(text_[token->begin]);
  }
  bool is_joint(const LayoutToken* token) const {
    return is_word(token) && is_one_of(text_of(token), kJoints);
  }
  bool is_name(const LayoutToken* token) const {
    return is_word(token) && !is_joint(token) && !is_one_of(text_of(token), kDeclarations) &&
           text_of(token) != "for";
  }
  /// Whether an expression is behind the token, not a statement.
  bool awaits_value(const LayoutToken* token) const {
    return is(token, LayoutKind::Operator) || is(token, LayoutKind::Label) || is_joint(token) ||
           is_bracket(token, '(') || is_bracket(token, '[');
  }
  /// Whether a statement may begin at the n-th token from here, as far as those before it go.
  bool may_begin(std::ptrdiff_t n) const {
    const LayoutToken* before = near(n - 1);
    if (before == nullptr) return true;
    if (awaits_value(before)) return false;
    return near(n)->is_first || is(before, LayoutKind::Comma) || is_bracket(before, '{') ||
           is_bracket(before, '}');
  }

  // Misspelt words

  /// The word of the language that the token was probably meant to be: one that is but a slip of
  /// the pen away, where nothing else makes sense.
  std::string_view meant() const {
    const LayoutToken* token = near(0);
    if (text_of(token) == "=") return meant_by_equals();
    if (is(token, LayoutKind::Operator)) return meant_by_sign();
    if (!is_name(token) || token->kind == LayoutKind::Label) return {};
    const auto first_of = [&](std::initializer_list<std::string_view> words) {
      const auto found = std::find_if(words.begin(), words.end(), [&](std::string_view word) {
        return is_one_slip(text_of(token), word);
      });
      return found == words.end() ? std::string_view() : *found;
    };
    const LayoutToken *before = near(-1), *next = near(1), *behind = near(2);
    if (next == nullptr || next->is_first) return {};
    if (is_bracket(before, '}')) {
      if (is_bracket(next, '{')) return first_of({"else"});
      const std::string_view word = text_of(token);
      if (word == "elif" || word == "elseif" || word == "elsif") return "else if";
    }
    if (may_begin(0)) {
      if (is_string(next)) return first_of({"import", "include"});
      if (is(next, LayoutKind::Label) && is_assigned(1)) return first_of({"param"});
      if (!is_name(next)) return {};
      if (text_of(behind) == "=") return first_of({"let", "param"});
      if (is_bracket(behind, '(') && behind->begin == next->end) return first_of({"fn", "def"});
      if (text_of(behind) == "in") return first_of({"for"});
      return {};
    }
    if (token->is_first || before->line != token->line) return {};
    const bool is_loop = text_of(near(-2)) == "for";
    if (is_loop) return first_of({"in"});
    if (is_string(before) && text_of(near(-2)) == "import") return first_of({"as"});
    const bool is_behind_value = is(before, LayoutKind::Value) || is(before, LayoutKind::Close);
    const bool is_before_value = is(next, LayoutKind::Value) || is(next, LayoutKind::Open);
    if (!is_behind_value || !is_before_value || is_bracket(next, '{')) return {};
    return first_of({"then", "else", "and", "or"});
  }

  /// What `=` stands for where nothing is defined.
  std::string_view meant_by_equals() const {
    const LayoutToken* before = near(-2);
    const bool is_behind_name = !inside_.empty() && is_name(near(-1));
    const bool is_argument = is(before, LayoutKind::Comma) || is_bracket(before, '(');
    if (is_behind_name && inside_.back() == 'c' && is_argument) return ":";
    if (is_if_ || is_assert_) return "==";
    return is_behind_name && inside_.back() == 'o' && may_begin(-1) ? ":" : std::string_view();
  }

  /// What a sign of other languages stands for.
  std::string_view meant_by_sign() const {
    const std::string_view sign = text_of(near(0));
    if (sign == ";") {
      const bool is_inside = !inside_.empty() && is_separator(inside_.back()) && !is_header_;
      return is_inside ? "," : "";
    }
    if (sign == "&&") return " and ";
    if (sign == "||") return " or ";
    const Habit* habit = find_habit(sign);
    // What is part of a number or string is told by whoever reads that.
    const bool is_part =
        habit != nullptr && (habit->replacement == "\"" || habit->replacement == "deg");
    return habit == nullptr || is_part ? std::string_view() : habit->replacement;
  }
  static bool is_separator(char inside) { return inside == 'c' || inside == 'h' || inside == '('; }

  /// Notes what the tokens behind this one stand in: an object, another block, a call, the head of
  /// a definition, or another parenthesis.
  void follow_brackets() {
    const LayoutToken& token = tokens_[at_];
    if (token.kind == LayoutKind::Open) {
      inside_ += token.bracket == '{' ? (is_object_ ? 'o' : 'b')
                 : token.is_head      ? 'h'
                 : token.is_call      ? 'c'
                 : is_loop()          ? 'f'
                                      : '(';
    } else if (token.kind == LayoutKind::Close && !inside_.empty()) {
      inside_.pop_back();
    } else if (token.kind == LayoutKind::Comma && (inside_.empty() || inside_.back() == 'b')) {
      is_assert_ = false;
    }
    if (is_bracket(&token, '{')) is_if_ = is_object_ = false;
  }

  /// Whether the parenthesis here is that of a `for` from elsewhere.
  bool is_loop() const { return text_of(near(-1)) == "for"; }

  bool is_string(const LayoutToken* token) const {
    return is(token, LayoutKind::Value) && text_[token->begin] == '"';
  }
  /// Whether a type and `=` stand behind the n-th token.
  bool is_assigned(std::ptrdiff_t n) const {
    return is_name(near(n + 1)) && text_of(near(n + 2)) == "=";
  }

  // Statements

  void mark_statement() {
    LayoutToken& token = tokens_[at_];
    if (is_bracket(&token, '{')) is_header_ = false;
    if (!is_word(&token)) return;
    const std::string_view word = text_of(&token);
    if (word == "then") is_if_ = false;
    if (word == "if") is_if_ = true;
    if (is_one_of(word, kDeclarations)) {
      is_if_ = false;
      is_assert_ = is_message_near_ = word == "assert";
      token.kind = LayoutKind::Statement;
      is_header_ = word == "def";
    } else if (word == "for" && is_word(near(1))) {
      token.kind = LayoutKind::Statement;
      is_header_ = true;
    } else if (word == "if" && may_begin(0) && !is_choice()) {
      token.kind = LayoutKind::Statement;
      is_header_ = true;
    } else if (word == "else" || word == "else if") {
      is_if_ = word == "else if";
      is_header_ = is_bracket(near(-1), '}') || is_bracket(near(1), '{');
    } else if (is_object()) {
      token.kind = LayoutKind::Statement;
      is_object_ = true;
    }
  }

  /// Whether the `if` here is one with `then`, a value.
  bool is_choice() const {
    constexpr std::ptrdiff_t kFar = 100;
    for (std::ptrdiff_t n = 1; n < kFar && near(n) != nullptr; ++n) {
      if (text_of(near(n)) == "then") return true;
      if (is_bracket(near(n), '{') || is_one_of(text_of(near(n)), kDeclarations)) return false;
    }
    return false;
  }

  /// Whether a block follows, with or without a name in front of it.
  bool is_object() const {
    if (is_header_ || !is_name(near(0))) return false;
    if (is_bracket(near(1), '{'))
      return !(is_name(near(-1)) && is(near(-1), LayoutKind::Statement));
    return is_name(near(1)) && near(1)->line == near(0)->line && is_bracket(near(2), '{');
  }

  bool continues() const {
    const LayoutToken* token = near(0);
    if (is(token, LayoutKind::Operator) || is(token, LayoutKind::Comma) ||
        is(token, LayoutKind::Open) || awaits_value(near(-1))) {
      return true;
    }
    const std::string_view word = text_of(token);
    if (is_joint(token) && word != "if" && word != "not") return true;
    // Behind a comma a block has labels and statements only.
    const bool is_block_part = is(token, LayoutKind::Label) || is(token, LayoutKind::Statement);
    return is(near(-1), LayoutKind::Comma) && !is_block_part;
  }

  // Brackets

  void mark_opening() {
    LayoutToken& token = tokens_[at_];
    const LayoutToken* before = near(-1);
    token.is_call = token.bracket == '(' && is_name(before);
    token.is_head = token.bracket == '(' && is_name(before) && declares(near(-2));
    token.defines = token.bracket == '{';
    const bool has_header = is(before, LayoutKind::Value) || is(before, LayoutKind::Statement) ||
                            is_bracket(before, ')') || is_bracket(before, ']');
    token.is_stray = token.bracket == '{' && !has_header;
  }

  bool is_stray_comma() const {
    const LayoutToken* behind = near(1);
    if (behind == nullptr || behind->is_first || is(behind, LayoutKind::Close)) return false;
    if (is_message_near_ || is(behind, LayoutKind::Label)) return false;
    // A statement may be an object, whose kind is a name.
    const LayoutToken* third = near(2);
    const bool is_object = is_name(behind) && (is_bracket(third, '{') || is_name(third));
    return !is_object && !is_one_of(text_of(behind), kDeclarations) && !is_joint(behind);
  }

  bool is_new_line() const {
    const LayoutToken* token = near(0);
    return token->is_first && !token->continues && !is(token, LayoutKind::Close) &&
           !is(near(-1), LayoutKind::Comma);
  }

  char wanted() const {
    if (near(-1) == nullptr || is(near(0), LayoutKind::Open)) return '\0';
    const bool may_be_inside = is_new_line() || is(near(0), LayoutKind::Label);
    if (may_be_inside && is_object_head()) return '{';
    return lacks_parenthesis() ? '(' : '\0';
  }

  /// Whether one name or two in front of this token are the head of an object.
  bool is_object_head() const {
    if (!is_name(near(-1))) return false;
    if (may_begin(-1)) return true;
    return is_name(near(-2)) && may_begin(-2) && near(-2)->line == near(-1)->line;
  }

  /// Whether parameters follow behind the name that is next.
  bool declares(const LayoutToken* token) const {
    return is(token, LayoutKind::Statement) && (text_of(token) == "fn" || text_of(token) == "def");
  }

  bool lacks_parenthesis() const {
    const LayoutToken* token = near(0);
    if (is(token, LayoutKind::Label)) {
      const bool is_second = is(near(-1), LayoutKind::Label) && !token->is_first;
      if (is_second || declares(near(-1))) return true;
    }
    if (declares(near(-2)) && is_name(near(-1))) return true;
    // A name in the place of a value, and a number behind it.
    const bool is_number = is_digit(text_[token->begin]) && !token->is_first;
    return is_number && is_name(near(-1)) && awaits_value(near(-2));
  }

  /// Whether something is missing between the token and the value in front of it.
  bool is_apart() const {
    const LayoutToken *token = near(0), *before = near(-1);
    if (before == nullptr || before->end == token->begin) return false;
    const bool is_end =
        is(before, LayoutKind::Value) || is_bracket(before, ')') || is_bracket(before, ']');
    if (!is_end || is_joint(before) || is_joint(token)) return false;
    if (is(token, LayoutKind::Label)) return true;
    if (is_bracket(token, '(')) return !is_name(before);
    if (!is(token, LayoutKind::Value)) return false;
    // `2 m` is a mistake of another kind.
    const bool is_unit =
        is_name(token) && !is_bracket(near(1), '(') && !is(near(1), LayoutKind::Value);
    return !is_digit(text_[before->begin]) || !is_unit;
  }

  bool may_open() const {
    const LayoutToken* token = near(0);
    const LayoutToken* before = near(-1);
    if (is(token, LayoutKind::Label)) return is_name(before) && awaits_value(near(-2));
    const bool is_value = is(token, LayoutKind::Value) || text_of(token) == "-";
    if (!is_value || before == nullptr) return false;
    const std::string_view word = text_of(before);
    return is(before, LayoutKind::Label) || word == "in" || word == "=" || word == "*" ||
           word == "/" || word == "+";
  }

  std::string_view text_;
  std::vector<LayoutToken>& tokens_;
  std::size_t at_ = 0;
  bool is_header_ = false;        ///< what is read is the head of a block
  bool is_if_ = false;            ///< likewise, of an `if`
  bool is_object_ = false;        ///< likewise, of an object
  bool is_assert_ = false;        ///< what is read is the condition of an assertion
  bool is_message_near_ = false;  ///< the last declaration was one
  std::string inside_;            ///< the brackets that are open, by what they are
};

}  // namespace

std::vector<LayoutToken> scan_layout(std::string_view text) {
  std::vector<LayoutToken> tokens = Scanner(text).run();
  PairMarker(text, tokens).run();
  Marker(text, tokens).run();
  return tokens;
}

namespace {

/// Goes through the text with its brackets as they are mended.
class MarkSearch {
 public:
  MarkSearch(std::span<const LayoutToken> tokens, BracketRepair& repair)
      : tokens_(tokens), repair_(repair) {}

  void run() {
    std::vector<BracketFault> faults = std::exchange(repair_.faults, {});
    auto fault = faults.begin();
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      bool is_surplus = false, is_sound = true;
      for (; fault != faults.end() && fault->token == at_; ++fault) {
        is_sound = false;
        is_surplus = is_surplus || fault->kind == BracketFault::Surplus;
        if (fault->kind == BracketFault::MissingOpen) open_.push_back({.bracket = '?'});
        if (fault->kind == BracketFault::MissingClose && !open_.empty()) open_.pop_back();
        is_surplus = is_surplus || fault->kind == BracketFault::Swapped;
        if (fault->kind == BracketFault::Swapped && open_.size() > 1) open_.pop_back();
        repair_.faults.push_back(*fault);
      }
      if (!is_surplus) read(tokens_[at_], is_sound);
    }
    repair_.faults.insert(repair_.faults.end(), fault, faults.end());
    std::sort(repair_.uncertain.begin(), repair_.uncertain.end());
    const auto repeated = std::unique(repair_.uncertain.begin(), repair_.uncertain.end());
    repair_.uncertain.erase(repeated, repair_.uncertain.end());
  }

 private:
  struct Open {
    char bracket = '\0';
    std::uint32_t token = 0;
    std::uint32_t commas = 0;
    bool is_plain = false;  ///< neither a call nor the head of a definition
    bool is_call = false;
    bool has_labels = false;
    bool has_fault = false;
  };

  void read(const LayoutToken& token, bool is_sound) {
    const bool is_parenthesis =
        !open_.empty() && (open_.back().bracket == '(' || open_.back().bracket == '[');
    if (is_parenthesis && is_sound) look(token);
    if (token.kind == LayoutKind::Open) {
      const bool is_plain = token.bracket == '(' && !token.is_call && !token.is_head;
      open_.push_back({.bracket = token.bracket,
                       .token = at_,
                       .is_plain = is_plain,
                       .is_call = token.is_call && !token.is_head});
    } else if (token.kind == LayoutKind::Close && !open_.empty()) {
      if (open_.back().has_fault) repair_.uncertain.push_back(at_);
      open_.pop_back();
    }
  }

  void look(const LayoutToken& token) {
    Open& open = open_.back();
    if (token.is_apart && at_ != open.token + 1) add(BracketFault::MissingMark, mark_before(open));
    if (token.kind == LayoutKind::Comma) ++open.commas;
    if (token.kind == LayoutKind::Label) open.has_labels = true;
    const bool is_pair = token.kind == LayoutKind::Close && open.is_plain && open.commas == 1 &&
                         tokens_[at_ - 1].kind != LayoutKind::Comma;
    if (is_pair && !open.has_fault) add(BracketFault::MissingThird, ',');
  }

  /// A colon behind what may be the name of an argument; else a comma.
  char mark_before(Open& open) const {
    const LayoutToken &first = tokens_[at_ - 1], &before = tokens_[at_ - 2];
    const bool is_label = open.is_call && first.is_callable &&
                          (before.kind == LayoutKind::Comma || before.kind == LayoutKind::Open);
    if (!is_label) ++open.commas;
    return is_label ? ':' : ',';
  }

  void add(BracketFault::Kind kind, char mark) {
    Open& open = open_.back();
    open.has_fault = true;
    repair_.faults.push_back({.kind = kind, .bracket = mark, .token = at_, .partner = open.token});
  }

  std::span<const LayoutToken> tokens_;
  BracketRepair& repair_;
  std::uint32_t at_ = 0;
  std::vector<Open> open_;
};

}  // namespace

void find_missing_marks(std::span<const LayoutToken> tokens, BracketRepair& repair) {
  MarkSearch(tokens, repair).run();
}

}  // namespace sdlc::lang
