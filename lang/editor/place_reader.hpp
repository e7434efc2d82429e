#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/editor/cursor_place.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

/// Follows the brackets and statements of a text, token by token.
class PlaceReader {
 public:
  /// Begins at the top level. `is_broken`: brackets are missing; lines that are not indented more
  /// than that of an open bracket are then outside of it.
  PlaceReader(std::string_view text, bool is_broken);

  /// Reads a token that is no trivia. `indent`: of its line if it is the first one there, else
  /// kNotFirst.
  void read(const Token& token, std::uint32_t indent);
  /// Closes brackets before a token with this indentation, which may be at the cursor.
  void leave_lines(std::uint32_t indent, char first);

  std::vector<OpenBracket>& brackets() noexcept { return brackets_; }

  static constexpr std::uint32_t kNotFirst = 0xFFFFFFFF;

 private:
  OpenBracket& top() noexcept { return brackets_.back(); }
  std::string_view next_after(const Token& token) const;

  void read_start(const Token& token);
  void begin_statement(const Token& token);
  void read_path(const Token& token);
  void read_declaration(const Token& token);
  void read_operand(const Token& token);
  void read_name_as_operand(const Token& token);
  void read_after_operand(const Token& token);
  void read_name_after_operand(const Token& token);
  bool begins_statement(const Token& token) const;
  bool read_link_word(std::string_view word);
  void read_comma();
  void open(OpenBracket::Role role, const Token& bracket, Span head = {});
  void open_block(const Token& bracket);
  void close(char bracket);
  void restart(const Token& token);
  void set_label(std::string_view label);
  static void end_statement(OpenBracket& bracket);

  std::string_view text_;
  bool is_broken_;
  bool is_first_ = true;      ///< the token is the first of its line
  std::uint32_t indent_ = 0;  ///< of the line
  std::vector<OpenBracket> brackets_;
  std::size_t deeper_ = 0;  ///< brackets that are open inside the innermost of `brackets_`
};

}  // namespace sdlc::lang
