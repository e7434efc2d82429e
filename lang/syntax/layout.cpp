#include "lang/syntax/layout.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "lang/syntax/foreign_signs.hpp"
#include "lang/syntax/foreign_words.hpp"
#include "lang/syntax/layout_tokens.hpp"
#include "lang/syntax/vocabulary.hpp"
#include "lang/syntax/wrong_pairs.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

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

/// What brackets enclose.
enum class Inside : std::uint8_t {
  Object,  ///< the properties of an object
  Block,   ///< statements
  Head,    ///< the parameters of a definition
  Call,    ///< arguments
  Loop,    ///< the head of a `for` from elsewhere
  Value,   ///< a point, a list or a part of a formula
};

/// Finds out what each token is among its neighbours.
class Marker {
 public:
  Marker(std::string_view text, std::vector<LayoutToken>& tokens) : text_(text), tokens_(tokens) {}

  void run() {
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      LayoutToken& token = tokens_[at_];
      if (token.meant.empty()) token.meant = meant();
      token.is_call = token.meant == ":" && inside_.back() == Inside::Call;
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
           is_letter(text_of(token)[0]);
  }
  bool is_joint(const LayoutToken* token) const {
    return is_word(token) && is_one_of(text_of(token), kJoints);
  }
  bool is_name(const LayoutToken* token) const {
    return is_word(token) && !is_joint(token) && !is_one_of(text_of(token), kDeclarationWords) &&
           text_of(token) != "for";
  }
  /// Whether an expression is behind the token, not a statement.
  bool awaits_value(const LayoutToken* token) const {
    return (is(token, LayoutKind::Operator) && !is_semicolon(token)) ||
           is(token, LayoutKind::Label) || is_joint(token) || is_bracket(token, '(') ||
           is_bracket(token, '[');
  }
  bool is_semicolon(const LayoutToken* token) const {
    return token != nullptr && char_at(text_, token->begin) == ';';
  }
  /// Whether a statement may begin at the n-th token from here, as far as those before it go.
  bool may_begin(std::ptrdiff_t n) const {
    const LayoutToken* before = near(n - 1);
    if (before == nullptr) return true;
    if (awaits_value(before)) return false;
    return near(n)->is_first || is(before, LayoutKind::Comma) || is_semicolon(before) ||
           is_bracket(before, '{') || is_bracket(before, '}');
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
      if (const std::string_view word = meant_by_word(); !word.empty()) return word;
      if (is_string(next)) return first_of({"import", "include"});
      if (is(next, LayoutKind::Label) && is_assigned(1)) return first_of({"param"});
      if (!is_name(next)) return {};
      if (text_of(behind) == "=") return first_of({"let", "param"});
      if (is_bracket(behind, '(') && behind->begin == next->end) return first_of({"fn", "def"});
      if (text_of(behind) == "in") return first_of({"for"});
      return {};
    }
    if (token->is_first || before->line != token->line) return {};
    const bool is_loop = text_of(near(-2)) == "for" && is_name(before);
    if (is_loop) return first_of({"in"});
    if (is_string(before) && text_of(near(-2)) == "import") return first_of({"as"});
    const bool is_behind_value = is(before, LayoutKind::Value) || is(before, LayoutKind::Close);
    const bool is_before_value = is(next, LayoutKind::Value) || is(next, LayoutKind::Open);
    if (!is_behind_value || !is_before_value || is_bracket(next, '{')) return {};
    return first_of({"then", "else", "and", "or"});
  }

  /// What a word that begins statements elsewhere stands for.
  std::string_view meant_by_word() const {
    const ForeignWord* word = find_foreign_word(text_of(near(0)));
    if (word == nullptr || !is_name(near(1))) return {};
    const std::string_view behind = text_of(near(2));
    const bool is_there = (word->kind == ForeignWord::Value && behind == "=") ||
                          (word->kind == ForeignWord::Function && behind == "(") ||
                          (word->kind == ForeignWord::Loop && behind == "in");
    return is_there ? word->meant : std::string_view();
  }

  /// What `=` stands for where nothing is defined.
  std::string_view meant_by_equals() const {
    const LayoutToken* before = near(-2);
    const bool is_behind_name = !inside_.empty() && is_name(near(-1));
    const bool is_argument = is(before, LayoutKind::Comma) || is_bracket(before, '(');
    if (is_behind_name && inside_.back() == Inside::Call && is_argument) return ":";
    if (is_if_ || is_assert_) return "==";
    return is_behind_name && inside_.back() == Inside::Object && may_begin(-1) ? ":"
                                                                               : std::string_view();
  }

  /// What a sign of other languages stands for.
  std::string_view meant_by_sign() const {
    const std::string_view sign = text_of(near(0));
    if (sign == ";") {
      const bool is_loop = !inside_.empty() && inside_.back() == Inside::Loop;
      if (is_loop || is_header_) return {};
      return !inside_.empty() && has_commas(inside_.back()) ? "," : " ";
    }
    if (sign == "&&") return " and ";
    if (sign == "||") return " or ";
    const ForeignSign* foreign = find_foreign_sign(sign);
    // What is part of a number or string is told by whoever reads that.
    const bool is_part =
        foreign != nullptr && (foreign->replacement == "\"" || foreign->replacement == "deg");
    return foreign == nullptr || is_part ? std::string_view() : foreign->replacement;
  }
  static bool has_commas(Inside inside) {
    return inside == Inside::Call || inside == Inside::Head || inside == Inside::Value;
  }

  /// Notes what the tokens behind this one stand in: an object, another block, a call, the head of
  /// a definition, or another parenthesis.
  void follow_brackets() {
    const LayoutToken& token = tokens_[at_];
    if (token.kind == LayoutKind::Open) {
      inside_.push_back(token.bracket == '{' ? (is_object_ ? Inside::Object : Inside::Block)
                        : token.is_head      ? Inside::Head
                        : token.is_call      ? Inside::Call
                        : is_loop()          ? Inside::Loop
                                             : Inside::Value);
    } else if (token.kind == LayoutKind::Close && !inside_.empty()) {
      inside_.pop_back();
    } else if (token.kind == LayoutKind::Comma &&
               (inside_.empty() || inside_.back() == Inside::Block)) {
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
    if (is_one_of(word, kDeclarationWords)) {
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
      if (is_bracket(near(n), '{') || is_one_of(text_of(near(n)), kDeclarationWords)) return false;
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
    return !is_object && !is_one_of(text_of(behind), kDeclarationWords) && !is_joint(behind);
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
    const bool is_number = is_digit(char_at(text_, token->begin)) && !token->is_first;
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
  std::vector<Inside> inside_;    ///< the brackets that are open, by what they are
};

}  // namespace

TokenLayout scan_layout(std::string_view text) {
  TokenLayout layout{.tokens = layout_tokens(text), .foreign = {}};
  layout.foreign = mark_foreign_phrases(text, layout.tokens);
  mark_wrong_pairs(text, layout.tokens);
  Marker(text, layout.tokens).run();
  return layout;
}

}  // namespace sdlc::lang
