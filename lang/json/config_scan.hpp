#pragma once

#include <cstdint>
#include <string_view>

#include "lang/text/ascii.hpp"
#include "lang/token/token_reader.hpp"

/// Looking at a config that is no JSON, without the grammar: where things end, in other languages'
/// spellings too.
namespace sdlc::lang {

constexpr bool is_one_of(char c, std::string_view any) noexcept {
  return c != '\0' && any.find(c) != std::string_view::npos;
}
/// Of a word or number.
constexpr bool is_word(char c) noexcept {
  return is_ascii_letter(c) || is_ascii_digit(c) || is_one_of(c, "_.+-$");
}

/// All places are bytes of the text. Nothing is remembered but the text, which must outlive this.
class ConfigScan {
 public:
  explicit ConfigScan(std::string_view text) noexcept : text_(text) {}

  std::string_view text() const noexcept { return text_; }
  /// NUL behind the end.
  char at(std::size_t i) const noexcept { return i < text_.size() ? text_[i] : '\0'; }

  /// Behind spaces and tabs, and behind line ends as well.
  std::uint32_t skip_blanks(std::uint32_t i) const noexcept;
  std::uint32_t skip_lines(std::uint32_t i) const noexcept;
  bool ends_line(std::uint32_t i) const noexcept;
  /// Bytes of the space at `i` that JSON does not have, such as a no-break space; 0: none.
  std::uint32_t foreign_blank(std::uint32_t i) const noexcept;

  /// Whether a string begins here, in straight, single or curly quotes.
  bool begins_string(std::uint32_t i) const noexcept;
  std::uint32_t quote_size(std::uint32_t i) const noexcept { return at(i) == '\xE2' ? 3 : 1; }
  /// Behind the closing quote of the string at `i`; 0 where the line ends before.
  std::uint32_t end_of_string(std::uint32_t i) const noexcept;
  /// Of a string that is never closed: brackets and commas at the end of its line are not its own.
  std::uint32_t end_of_unclosed(std::uint32_t begin) const noexcept;

  bool begins_word(std::uint32_t i) const noexcept;
  std::uint32_t end_of_word(std::uint32_t i) const noexcept;
  /// Whether a colon follows in the line.
  bool is_label_end(std::uint32_t i) const noexcept { return at(skip_blanks(i)) == ':'; }
  /// Whether the value that ends at `i` has an end: a comma, a bracket, the end of the line.
  bool is_value_end(std::uint32_t i) const noexcept {
    return ends_line(i) || is_one_of(at(i), ",}]");
  }
  /// Whether the `#` at `i` begins a colour of the web, such as #ff8800, and nothing else.
  bool is_web_color(std::uint32_t i) const noexcept;

 private:
  bool is_curly(std::uint32_t i) const noexcept;
  Token token_at(std::uint32_t i) const noexcept { return json_token(text_, i); }

  std::string_view text_;
};

}  // namespace sdlc::lang
