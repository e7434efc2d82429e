#include <algorithm>
#include <utility>

#include "lang/repair/json_syntax.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/text/ascii.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

class JsonTokens {
 public:
  explicit JsonTokens(std::string_view text) : text_(text), reader_(text, 0, SourceFormat::Json) {}

  TokenList run() {
    for (Token token = reader_.next(); token.kind != TokenKind::End; token = reader_.next()) {
      if (token.kind == TokenKind::UnclosedComment) return {text_, {}};
      const bool is_color = char_at(text_, token.span.begin) == '#' && begins_color(token.span);
      if (is_trivia(token.kind) && !is_color) {
        skip(token);
      } else {
        add(token, is_color);
      }
    }
    return {text_, std::move(tokens_)};
  }

 private:
  void skip(const Token& token) {
    line_ += static_cast<std::uint32_t>(std::ranges::count(reader_.text(token), '\n'));
    if (token.kind != TokenKind::LineEnd) return;
    indent_ = skip_blanks(text_, token.span.end) - token.span.end;
    is_first_ = true;
  }

  std::uint32_t end_of_word(std::uint32_t at, bool (*is_part)(char)) const {
    while (at < text_.size() && is_part(text_[at])) ++at;
    return at;
  }
  static bool is_word(char c) {
    return is_ascii_letter(c) || is_ascii_digit(c) ||
           std::string_view("_.+-$").find(c) != std::string_view::npos;
  }

  /// Whether the comment is rather a colour of the web, such as #ff8800.
  bool begins_color(Span comment) const {
    const bool wants_value = !tokens_.empty() && (tokens_.back().kind == TokenClass::Label ||
                                                  tokens_.back().kind == TokenClass::Comma ||
                                                  tokens_.back().bracket == '[');
    const std::uint32_t end = end_of_word(comment.begin + 1, is_hex_digit);
    const std::uint32_t digits = end - comment.begin - 1;
    const char next = char_at(text_, skip_blanks(text_, end));
    const bool is_size = digits == 3 || digits == 4 || digits == 6 || digits == 8;
    return wants_value && is_size &&
           std::string_view("\0\n,}]", 5).find(next) != std::string_view::npos;
  }

  void add(const Token& token, bool is_color) {
    Span span = token.span;
    const char c = text_[span.begin];
    if (const std::uint32_t end = end_of_slipped_key(span.begin); end != 0) {
      return push({span.begin, end}, TokenClass::Label, '\0');
    }
    if (is_color) span.end = end_of_word(span.begin + 1, is_hex_digit);
    if (is_string(token.kind)) span.end = end_of_string(token);
    // Only the second quote is there: `key": 5` and `value",`.
    const bool has_quote = is_name(token.kind) && char_at(text_, span.end) == '"' &&
                           ends_text(skip_blanks(text_, span.end + 1));
    if (has_quote) ++span.end;
    const bool is_key = (is_name(token.kind) || is_string(token.kind)) && !is_color;
    const std::uint32_t next = skip_blanks(text_, span.end);
    const bool is_label = is_key && (char_at(text_, next) == ':' || char_at(text_, next) == '=');
    if (is_label) span.end = next + 1;
    const bool is_bracket = token.kind == TokenKind::Open || token.kind == TokenKind::Close;
    push(span,
         is_label                          ? TokenClass::Label
         : token.kind == TokenKind::Open   ? TokenClass::Open
         : token.kind == TokenKind::Close  ? TokenClass::Close
         : c == ','                        ? TokenClass::Comma
         : is_operator(token) && !is_color ? TokenClass::Operator
                                           : TokenClass::Value,
         is_bracket ? c : '\0');
  }

  void push(Span span, TokenClass kind, char bracket) {
    tokens_.push_back({.begin = span.begin,
                       .end = span.end,
                       .line = line_,
                       .indent = indent_,
                       .kind = kind,
                       .bracket = bracket,
                       .is_first = is_first_});
    is_first_ = false;
    reader_.seek(span.end);
  }

  /// The end of a key with misplaced quotes, as in `""key":`, `k"ey":` and `"ke"y:`; 0 if none
  /// is at `at`.
  std::uint32_t end_of_slipped_key(std::uint32_t at) const {
    if (!tokens_.empty() && tokens_.back().kind == TokenClass::Label) return 0;
    const std::uint32_t end = end_of_word(at, [](char c) { return c == '"' || is_word(c); });
    const std::string_view key = text_.substr(at, end - at);
    const std::uint32_t colon = skip_blanks(text_, end);
    const bool has_quotes = std::ranges::count(key, '"') >= 2 && key.size() > 3;
    const bool is_sound = key.starts_with('"') && key.find('"', 1) == key.size() - 1;
    return has_quotes && !is_sound && char_at(text_, colon) == ':' ? colon + 1 : 0;
  }

  bool ends_text(std::uint32_t at) const {
    return std::string_view("\0\n:,}]", 6).find(char_at(text_, at)) != std::string_view::npos;
  }

  bool is_operator(const Token& token) const {
    const char c = text_[token.span.begin];
    const bool is_alone = ends_text(skip_blanks(text_, token.span.end));
    const bool is_sign = token.span.size() == 1 && (c == '-' || c == '+' || c == '.') && !is_alone;
    return token.kind == TokenKind::Mark || is_sign ||
           (token.kind == TokenKind::Unknown && !is_repair_mark(c));
  }

  /// The end of the string; where a quote is missing, where it was probably meant to end.
  std::uint32_t end_of_string(const Token& token) const {
    const std::uint32_t begin = token.span.begin, end = token.span.end;
    const std::uint32_t word_end = end_of_word(begin + 1, is_word);
    const std::uint32_t colon = skip_blanks(text_, word_end);
    const bool wants_key = tokens_.empty() || tokens_.back().kind != TokenClass::Label;
    const bool is_key = wants_key && word_end > begin + 1 && char_at(text_, colon) == ':';
    if (token.kind == TokenKind::UnclosedString) {
      if (is_key) return word_end;
      const bool ends_key = char_at(text_, skip_blanks(text_, begin + 1)) == ':';
      if (ends_key) return begin + 1;  // of a key with a line end in it
      return begin + static_cast<std::uint32_t>(
                         text_.substr(begin, end - begin).find_last_not_of(" \t\r,]}") + 1);
    }
    if (!is_word(char_at(text_, end))) return end;
    // `"key: "value"`: the quote is that of what follows.
    if (is_key) return word_end;
    // `"value, "key":`: the quote is that of the next key.
    const std::uint32_t next = end_of_word(end, is_word);
    const std::size_t last = text_.find_last_not_of(" \t", end - 2);
    const bool precedes_key = char_at(text_, next) == '"' &&
                              char_at(text_, skip_blanks(text_, next + 1)) == ':' &&
                              text_[last] == ',' && last > begin + 1;
    return precedes_key ? static_cast<std::uint32_t>(last) : end;
  }

  std::string_view text_;
  TokenReader reader_;
  std::vector<RepairToken> tokens_;
  std::uint32_t line_ = 0, indent_ = 0;
  bool is_first_ = true;
};

}  // namespace

TokenList json_tokens(std::string_view text) { return JsonTokens(text).run(); }

}  // namespace sdlc::lang
