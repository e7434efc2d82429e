#include "lang/syntax/layout_scanner.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <utility>

#include "lang/syntax/foreign_signs.hpp"
#include "lang/syntax/scan.hpp"

namespace sdlc::lang {
namespace {

/// Splits the text into tokens.
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
      } else if ((c == '#' && !begins_color() && !begins_definition()) || begins_dashes()) {
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

  /// `#declare name =`, which is no comment.
  bool begins_definition() const {
    if (!is_first_) return false;
    const std::uint32_t end = end_of_word(at_ + 1), name = skip_blanks(text_, end);
    const std::string_view word = text_.substr(at_, end - at_);
    const std::uint32_t sign = skip_blanks(text_, end_of_identifier(text_, name));
    return (word == "#declare" || word == "#local") && name > end && sign > name &&
           char_at(text_, sign) == '=' && char_at(text_, sign + 1) != '=';
  }

  /// Whether this line is a comment of another language.
  bool begins_dashes() const { return is_first_ && text_.substr(at_).starts_with("--"); }

  void read() {
    const char c = text_[at_];
    const std::uint32_t begin = at_;
    if (c == '"') return add(begin, end_of_written_string(), LayoutKind::Value);
    if (end_of_written_name(at_) > at_) return read_word();
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
    std::uint32_t end = end_of_written_name(begin);
    while (char_at(text_, end) == '.' && is_letter(char_at(text_, end + 1))) {
      end = end_of_written_name(end + 1);
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
    for (const ForeignSign& sign : kForeignSigns) {
      if (rest.starts_with(sign.text)) size = std::max(size, sign.text.size());
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
  /// Behind the name at `at`, with the letters that no name has.
  std::uint32_t end_of_written_name(std::uint32_t at) const {
    std::uint32_t end = at;
    while (is_idchar(char_at(text_, end)) || is_foreign_letter(text_, end)) {
      if (end == at && is_digit(text_[end])) return at;
      end = is_idchar(text_[end]) ? end + 1 : token_at(text_, end).end;
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

}  // namespace

std::vector<LayoutToken> scan_tokens(std::string_view text) { return Scanner(text).run(); }

}  // namespace sdlc::lang
