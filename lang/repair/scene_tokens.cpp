#include <algorithm>
#include <utility>

#include "lang/repair/habits.hpp"
#include "lang/repair/tokens.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

class SceneTokens {
 public:
  /// The tokens from `begin`, a line's first token, to the end of the text.
  SceneTokens(std::string_view text, std::uint32_t begin)
      : text_(text), reader_(text, begin), indent_(indent_of_line(text, begin)) {}

  TokenList run() {
    for (Token token = reader_.next(); token.kind != TokenKind::End; token = reader_.next()) {
      if (is_trivia(token.kind)) {
        skip(token);
      } else if (is_foreign_comment(token.span)) {
        const std::uint32_t end = line_end(token.span.begin);
        foreign_comments_.push_back({token.span.begin, end});
        reader_.seek(end);
      } else {
        add(token);
      }
    }
    return {text_, std::move(tokens_), std::move(foreign_comments_)};
  }

 private:
  void skip(const Token& token) {
    const std::string_view space = reader_.text(token);
    line_ += static_cast<std::uint32_t>(std::ranges::count(space, '\n'));
    if (token.kind != TokenKind::LineEnd) return;
    indent_ = skip_blanks(text_, token.span.end) - token.span.end;
    is_first_ = true;
  }

  std::uint32_t line_end(std::uint32_t at) const {
    return static_cast<std::uint32_t>(std::min(text_.find('\n', at), text_.size()));
  }

  /// Whether a comment of another language begins here: `# text`, or `-- text` at the beginning of
  /// a line. But `#fff` is a colour, and `#declare name =` is a declaration.
  bool is_foreign_comment(Span token) const {
    const std::string_view rest = text_.substr(token.begin);
    if (is_first_ && rest.starts_with("--")) return true;
    if (rest[0] != '#' || wants_value()) return false;
    const std::size_t digits = token.size() - 1;
    if (!is_first_) return digits == 0;
    if (digits == 3 || digits == 6) return false;
    const std::string_view word = rest.substr(0, token.size());
    if (word != "#declare" && word != "#local") return true;
    TokenReader ahead(text_, token.end);
    const Token name = ahead.next_in_line(), sign = ahead.next_in_line();
    return name.kind != TokenKind::Name || ahead.text(sign) != "=";
  }

  bool wants_value() const {
    const TokenClass last = tokens_.empty() ? TokenClass::End : tokens_.back().kind;
    return last == TokenClass::Label || last == TokenClass::Operator;
  }

  void add(const Token& token) {
    Span span = token.span;
    switch (token.kind) {
      case TokenKind::Open: return push(span, TokenClass::Open, text_[span.begin]);
      case TokenKind::Close: return push(span, TokenClass::Close, text_[span.begin]);
      case TokenKind::Name:
      case TokenKind::ForeignName: return add_word(span);
      case TokenKind::UnclosedString: span.end = end_of_unclosed_string(text_, span); break;
      case TokenKind::Mark:
      case TokenKind::Unknown: return add_sign(span);
      default: break;
    }
    push(span, TokenClass::Value);
  }

  /// Adds a name or a dotted name such as `file.name`. A label includes the colon after it.
  void add_word(Span span) {
    const auto is_dot_before_name = [&] {
      return char_at(text_, span.end) == '.' && is_letter(char_at(text_, span.end + 1));
    };
    while (is_dot_before_name()) span.end = token_at(text_, span.end + 1).end;
    const std::uint32_t colon = skip_blanks(text_, span.end);
    const bool is_declared = !tokens_.empty() && word_of(tokens_.back()) == "param";
    const bool is_label = char_at(text_, colon) == ':' && !is_declared;
    if (is_label) span.end = colon + 1;
    push(span, is_label ? TokenClass::Label : TokenClass::Value);
  }

  /// Adds a comma or an operator. An operator of another language, such as `&&`, is one token.
  void add_sign(Span span) {
    if (text_[span.begin] == ',') return push(span, TokenClass::Comma);
    const std::string_view rest = text_.substr(span.begin);
    const std::size_t size = rest.starts_with("..") ? 2 : span.size();
    const auto sign = std::max(size, foreign_sign_at(rest).size());
    push({span.begin, span.begin + static_cast<std::uint32_t>(sign)}, TokenClass::Operator);
  }

  std::string_view word_of(const RepairToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }

  void push(Span span, TokenClass kind, char bracket = '\0') {
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

  std::string_view text_;
  TokenReader reader_;
  std::vector<RepairToken> tokens_;
  std::vector<Span> foreign_comments_;
  std::uint32_t line_ = 0, indent_;
  bool is_first_ = true;
};

}  // namespace

TokenList scene_tokens(const RepairedText& text) {
  const Span part = text.part();
  return SceneTokens(std::string_view(text.text()).substr(0, part.end), part.begin).run();
}

}  // namespace sdlc::lang
