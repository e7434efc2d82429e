#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"

/// The tokens of a broken text, as far as its repair needs them.
namespace sdlc::lang {

enum class TokenClass : std::uint8_t {
  Open,
  Close,
  Comma,
  Label,  ///< a name, or a string of JSON, with the colon after it
  Value,  ///< a word or a literal
  Operator,
  End,  ///< after the last token
};

struct RepairToken {
  std::uint32_t begin = 0, end = 0;
  std::uint32_t line = 0;
  std::uint32_t indent = 0;  ///< of its line
  TokenClass kind = TokenClass::End;
  char bracket = '\0';   ///< of Open and Close
  bool is_first = true;  ///< of its line

  Span span() const noexcept { return {begin, end}; }
};

/// The tokens of a text or of a part of it, without its comments. Every index is valid: those
/// outside the text give an empty token of the class End.
class TokenList {
 public:
  TokenList(std::string_view text, std::vector<RepairToken> tokens,
            std::vector<Span> foreign_comments = {});

  std::string_view text() const noexcept { return text_; }
  std::size_t size() const noexcept { return tokens_.size(); }
  /// Comments that begin with a sign of another language.
  const std::vector<Span>& foreign_comments() const noexcept { return foreign_comments_; }
  const RepairToken& operator[](std::size_t i) const noexcept {
    return i < tokens_.size() ? tokens_[i] : end_;
  }

  std::string_view written(std::size_t i) const noexcept {
    const RepairToken& token = (*this)[i];
    return text_.substr(token.begin, token.end - token.begin);
  }
  bool is(std::size_t i, TokenClass kind) const noexcept { return (*this)[i].kind == kind; }
  bool is(std::size_t i, std::string_view text) const noexcept { return written(i) == text; }
  bool is_bracket(std::size_t i, char bracket) const noexcept {
    return (*this)[i].bracket == bracket;
  }
  /// A word that is not part of a label, keywords included.
  bool is_word(std::size_t i) const noexcept;
  /// A word that can be a name.
  bool is_name(std::size_t i) const noexcept;
  bool is_number(std::size_t i) const noexcept;
  bool is_string(std::size_t i) const noexcept;
  /// Of a Label: the name without its colon.
  std::string_view label(std::size_t i) const noexcept;
  /// Whether nothing separates it from the token before.
  bool is_joined(std::size_t i) const noexcept;
  /// Whether it is in the line of the token before.
  bool is_same_line(std::size_t i) const noexcept { return i > 0 && !(*this)[i].is_first; }
  /// The bracket that matches the one at `i`; size() if none does.
  std::size_t partner(std::size_t i) const noexcept { return partners_[i]; }
  /// Whether each bracket closes the one before it that is open.
  bool has_matching_brackets() const noexcept { return has_matching_brackets_; }

  /// Whether an operand must follow the token at `i`.
  bool wants_operand(std::size_t i) const noexcept;
  /// Whether the token at `i` can be the first of a statement.
  bool may_begin_statement(std::size_t i) const noexcept;
  /// Whether the `let` at `i` begins a value: `radius: let a = 1 in a`.
  bool is_let_of_value(std::size_t i) const noexcept;
  /// Whether it is: a declaration, a `for`, an `if` with a block, or the kind of an object.
  bool begins_statement(std::size_t i) const noexcept;
  /// Whether an object begins: its kind, perhaps its name, and `{`.
  bool begins_object(std::size_t i) const noexcept;
  /// Whether the parenthesis at `i` holds parameters, not arguments.
  bool holds_parameters(std::size_t i) const noexcept;
  /// Whether it holds arguments or parameters.
  bool holds_arguments(std::size_t i) const noexcept;

 private:
  bool is_choice(std::size_t i) const noexcept;

  std::string_view text_;
  std::vector<RepairToken> tokens_;
  std::vector<Span> foreign_comments_;
  std::vector<std::uint32_t> partners_;
  bool has_matching_brackets_ = true;
  RepairToken end_;
};

/// The tokens of the part of a scene that is repaired. `#` begins a comment if it cannot begin a
/// colour, and `--` if it begins a line.
TokenList scene_tokens(const RepairedText& text);
/// The tokens of a config; none if a comment is never closed.
TokenList json_tokens(std::string_view text);

}  // namespace sdlc::lang
