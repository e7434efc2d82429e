#include "lang/repair/recovery.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "lang/repair/vocabulary.hpp"
#include "lang/schema/schema.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// Signs after which a value goes on.
constexpr auto kContinued = std::to_array<std::string_view>(
    {"=", ":", ",", "+", "-", "*", "/", "^", "..", "==", "!=", "<", "<=", ">", ">="});

enum class Beginning : std::uint8_t {
  None,
  Property,   ///< `name:`, which an argument looks like too
  Statement,  ///< cannot be inside parentheses
};

/// The kind of statement that begins with the first token of a line, which `tokens` reads next.
Beginning classify(TokenReader tokens) {
  const Token name = tokens.next();
  if (!is_name(name.kind)) return Beginning::None;
  const Token next = tokens.next_in_line();
  const std::string_view word = tokens.text(name), sign = tokens.text(next);
  const char c = char_at(sign, 0);
  if (sign == ":" || sign == "=") return Beginning::Property;
  if (is_one_of(word, kStatementWords)) {
    return word == "if" ? Beginning::Property : Beginning::Statement;
  }
  if (sign == "{") return Beginning::Statement;
  // No expression goes on with a literal: this is a property that lacks its colon.
  const bool is_apart = next.span.begin > name.span.end;
  if (is_apart && (is_string(next.kind) || c == '#' || is_digit(c))) {
    return Beginning::Property;
  }
  const bool is_named = is_name(next.kind) && tokens.text(tokens.next_in_line()) == "{";
  return is_named ? Beginning::Statement : Beginning::None;
}

/// Searches the tokens from a place on for the next statement.
class StatementSearch {
 public:
  StatementSearch(std::string_view text, std::uint32_t from, RecoveryOptions options)
      : tokens_(text, from),
        options_(options),
        open_(options.open - (options.open_block && options.open > 0 ? 1 : 0), '('),
        open_blocks_(options.open_block ? 1 : 0),
        is_first_(is_first_of_line(text, from)) {
    if (options.open_block) open_ += '{';
  }

  std::uint32_t run() {
    for (;;) {
      const Token token = tokens_.next();
      const std::uint32_t at = token.span.begin;
      if (token.kind == TokenKind::End) return std::min(property_, at);
      if (property_ != kNowhere && at - property_ > kLookahead) return property_;
      // A comment that is never closed is worth an error of its own.
      if (token.kind == TokenKind::UnclosedComment) return at;
      if (token.kind == TokenKind::LineEnd) is_first_ = true;
      if (is_trivia(token.kind)) continue;
      if (std::exchange(is_first_, false)) {
        if (const std::uint32_t found = at_line(token); found != kNowhere) return found;
      }
      if (const std::uint32_t found = read(token); found != kNowhere) return found;
    }
  }

 private:
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFF;
  // After an open bracket a line `name:` may be an argument or the next property: look ahead for
  // the closing bracket.
  static constexpr std::uint32_t kLookahead = 4096;

  /// Where to go on if a statement begins with the first token of a line.
  std::uint32_t at_line(const Token& token) {
    const std::uint32_t at = token.span.begin;
    const Beginning beginning = classify(from(at));
    if (beginning == Beginning::None) {
      const bool may_begin =
          open_.empty() && is_name(token.kind) && !is_one_of(tokens_.text(token), kLinkWords);
      return may_begin && indent_of_line(tokens_.text(), at) <= options_.indent ? at : kNowhere;
    }
    if (open_.empty()) return at;
    if (open_blocks_ > 0) return kNowhere;
    if (beginning == Beginning::Statement || !options_.is_patient) return std::min(property_, at);
    property_ = std::min(property_, at);
    return kNowhere;
  }

  std::uint32_t read(const Token& token) {
    switch (tokens_.text()[token.span.begin]) {
      case '{':
        ++open_blocks_;
        open_ += '{';
        break;
      case '(':
      case '[': open_ += '('; break;
      case ')':
      case ']':
        if (!open_.empty() && open_.back() == '(') open_.pop_back();
        if (open_.empty()) property_ = kNowhere;
        break;
      case '}':
        if (open_blocks_ == 0) return std::min(property_, token.span.begin);
        open_.resize(open_.rfind('{'));
        --open_blocks_;
        break;
      case ',': {
        const std::uint32_t next = skip_blanks(tokens_.text(), token.span.end);
        if (open_.empty() && classify(from(next)) == Beginning::Property) return next;
        break;
      }
      default: break;
    }
    return kNowhere;
  }

  TokenReader from(std::uint32_t at) const { return TokenReader(tokens_.text(), at); }

  TokenReader tokens_;
  RecoveryOptions options_;
  std::string open_;  ///< the brackets that are open: `{`, or `(` for the others
  std::size_t open_blocks_;
  bool is_first_;                      ///< no token of the line has been read
  std::uint32_t property_ = kNowhere;  ///< what may be the next one, inside an open bracket
};

}  // namespace

std::uint32_t next_statement(std::string_view text, std::uint32_t from, RecoveryOptions options) {
  return StatementSearch(text, from, options).run();
}

bool looks_like_statement(std::string_view text, std::uint32_t at) {
  return classify(TokenReader(text, at)) != Beginning::None;
}

bool looks_like_object(std::string_view text, std::uint32_t at) {
  std::uint32_t end = end_of_identifier(text, at);
  while (char_at(text, end) == '.' && is_letter(char_at(text, end + 1))) {
    end = end_of_identifier(text, end + 1);
  }
  TokenReader tokens(text, end);
  Token next = tokens.next_in_line();
  if (is_name(next.kind)) {
    // `k sphere {`: the end of a value, and an object.
    const bool is_kind = std::ranges::count(all_kinds(), tokens.text(next), &Kind::name) > 0;
    if (is_kind) return false;
    next = tokens.next_in_line();
  }
  return tokens.text(next) == "{";
}

bool has_in(std::string_view text, std::uint32_t at) {
  constexpr std::uint32_t kLookahead = 4096;  // a text of mistakes is not read again and again
  TokenReader tokens(text.substr(0, std::min<std::size_t>(text.size(), at + kLookahead)), at);
  std::uint32_t open = 0, lets = 0, loops = 0;
  bool ends_value = false, is_first = false;
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (token.kind == TokenKind::LineEnd) is_first = true;
    if (is_trivia(token.kind)) continue;
    const std::string_view word = tokens.text(token);
    const bool begins_line = std::exchange(is_first, false) && open == 0;
    // `in 10` would otherwise look like a statement with a number for a name.
    const auto looks_like_next = word == "in" ? looks_like_object : looks_like_statement;
    if (begins_line && ends_value && looks_like_next(text, token.span.begin)) return false;
    if (token.kind == TokenKind::Open) ++open;
    if (token.kind == TokenKind::Close && open-- == 0) return false;
    ends_value = is_name(token.kind)
                     ? !is_one_of(word, kJoints) && word != "let"
                     : !is_one_of(word, kContinued) && token.kind != TokenKind::Open;
    if (open > 0) continue;
    lets += word == "let";
    loops += word == "for";
    if (word != "in") continue;
    if (loops > 0) {
      --loops;
    } else if (--lets == 0) {
      return true;
    }
  }
  return text.size() - at > kLookahead;
}

Span trim(std::string_view text, Span span) noexcept {
  const auto is_blank = [&](std::uint32_t at) {
    return text[at] == ' ' || text[at] == '\t' || text[at] == '\n' || text[at] == '\r';
  };
  while (span.begin < span.end && is_blank(span.end - 1)) --span.end;
  while (span.begin < span.end && is_blank(span.begin)) ++span.begin;
  return span;
}

}  // namespace sdlc::lang
