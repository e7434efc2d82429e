#include "lang/syntax/layout_tokens.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "lang/syntax/foreign_signs.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

class Classifier {
 public:
  explicit Classifier(std::string_view text) : text_(text), reader_(text) {}

  std::vector<LayoutToken> run() {
    for (Token token = reader_.next(); token.kind != TokenKind::End; token = reader_.next()) {
      if (is_trivia(token.kind)) {
        skip(token);
      } else if (begins_foreign_comment(token)) {
        const std::size_t line_end = std::min(text_.find('\n', token.span.begin), text_.size());
        reader_.seek(static_cast<std::uint32_t>(line_end));
      } else {
        read(token);
      }
    }
    return std::move(tokens_);
  }

 private:
  void skip(const Token& trivia) {
    if (trivia.kind == TokenKind::LineEnd) {
      ++line_;
      indent_ = skip_blanks(text_, trivia.span.end) - trivia.span.end;
      is_first_ = true;
    } else if (is_comment(trivia.kind)) {
      const std::string_view comment = reader_.text(trivia);
      line_ += static_cast<std::uint32_t>(std::count(comment.begin(), comment.end(), '\n'));
    }
  }

  /// `# …`, and `-- …` at the beginning of a line.
  bool begins_foreign_comment(const Token& token) const {
    const std::string_view rest = text_.substr(token.span.begin);
    if (rest[0] != '#') return is_first_ && rest.starts_with("--");
    const std::uint32_t digits = token.span.size() - 1;
    const bool is_color = is_first_ ? digits == 3 || digits == 6 : digits > 0;
    return !is_color && !begins_definition(token);
  }

  /// `#declare name =`, which is no comment.
  bool begins_definition(const Token& token) const {
    const std::string_view word = reader_.text(token);
    if (!is_first_ || (word != "#declare" && word != "#local")) return false;
    TokenReader ahead = reader_;
    const Token name = ahead.next_in_line(), sign = ahead.next_in_line();
    return name.kind == TokenKind::Name && reader_.text(sign) == "=";
  }

  void read(const Token& token) {
    const auto [begin, end] = token.span;
    switch (token.kind) {
      case TokenKind::Name:
      case TokenKind::ForeignName: return read_name(token);
      case TokenKind::UnclosedString:
        return add({begin, end_of_unclosed_string(text_, token.span)}, LayoutKind::Value);
      case TokenKind::String:
      case TokenKind::Number:
      case TokenKind::Color: return add(token.span, LayoutKind::Value);
      case TokenKind::Open:
      case TokenKind::Close:
        add(token.span, token.kind == TokenKind::Open ? LayoutKind::Open : LayoutKind::Close);
        tokens_.back().bracket = text_[begin];
        return;
      default:
        if (text_[begin] == ',') return add(token.span, LayoutKind::Comma);
        return add({begin, end_of_sign(token.span)}, LayoutKind::Operator);
    }
  }

  /// A path and the colon after it, which makes it a label. The colon of a param is followed by a
  /// type.
  void read_name(const Token& name) {
    std::uint32_t end = name.span.end;
    while (char_at(text_, end) == '.' && is_letter(char_at(text_, end + 1))) {
      end = scene_token(text_, end + 1).span.end;
    }
    const std::uint32_t colon = skip_blanks(text_, end);
    const bool is_declared = !tokens_.empty() && text_of(tokens_.back()) == "param";
    if (char_at(text_, colon) == ':' && !is_declared) {
      add({name.span.begin, colon + 1}, LayoutKind::Label);
    } else {
      add({name.span.begin, end}, LayoutKind::Value);
    }
  }

  std::uint32_t end_of_sign(Span token) const {
    std::size_t size = token.size();
    for (const ForeignSign& sign : kForeignSigns) {
      if (text_.substr(token.begin).starts_with(sign.text)) size = std::max(size, sign.text.size());
    }
    return token.begin + static_cast<std::uint32_t>(size);
  }

  std::string_view text_of(const LayoutToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }

  void add(Span span, LayoutKind kind) {
    tokens_.push_back({.begin = span.begin,
                       .end = span.end,
                       .line = line_,
                       .indent = indent_,
                       .kind = kind,
                       .is_first = is_first_});
    is_first_ = false;
    reader_.seek(span.end);
  }

  std::string_view text_;
  TokenReader reader_;
  std::vector<LayoutToken> tokens_;
  std::uint32_t line_ = 0;
  std::uint32_t indent_ = 0;
  bool is_first_ = true;
};

}  // namespace

std::vector<LayoutToken> layout_tokens(std::string_view text) { return Classifier(text).run(); }

}  // namespace sdlc::lang
