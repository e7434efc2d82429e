#include "lang/syntax/recovery.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "lang/syntax/scan.hpp"
#include "lang/syntax/vocabulary.hpp"

namespace sdlc::lang {
namespace {

enum class Beginning : std::uint8_t {
  None,
  Property,   ///< `name:`, which an argument looks like too
  Statement,  ///< what can stand in no bracket
};

/// What kind of statement the line's first token at `at` looks like the beginning of.
Beginning classify(std::string_view text, std::uint32_t at) {
  const std::uint32_t end = end_of_identifier(text, at);
  if (end == at) return Beginning::None;
  const std::string_view word = text.substr(at, end - at);
  const std::uint32_t next = skip_blanks(text, end);
  const char c = char_at(text, next);
  if (c == ':' || (c == '=' && char_at(text, next + 1) != '=')) return Beginning::Property;
  if (is_one_of(word, kStatementWords)) {
    return word == "if" ? Beginning::Property : Beginning::Statement;
  }
  if (c == '{') return Beginning::Statement;
  // No expression goes on with a literal: this is a property that lacks its colon.
  if (next > end && (c == '"' || c == '#' || is_digit(c))) return Beginning::Property;
  const std::uint32_t name_end = end_of_identifier(text, next);
  const bool is_named = name_end > next && char_at(text, skip_blanks(text, name_end)) == '{';
  return is_named ? Beginning::Statement : Beginning::None;
}

/// Whether the line's first token at `at` is not a part of the line before.
bool may_begin_statement(std::string_view text, std::uint32_t at) {
  const std::string_view word = text.substr(at, end_of_identifier(text, at) - at);
  return !word.empty() && !is_one_of(word, kLinkWords);
}

/// The first token of the line that begins at `at`, behind the comments in front of it; one that is
/// never closed is a token.
std::uint32_t first_of_line(std::string_view text, std::uint32_t at) {
  while (true) {
    at = skip_blanks(text, at);
    const std::uint32_t behind = end_of_comment(text, at);
    if (behind == at || behind == text.size()) return at;
    at = behind;
  }
}

}  // namespace

std::uint32_t next_statement(std::string_view text, std::uint32_t from, RecoveryOptions options) {
  constexpr std::uint32_t kNowhere = 0xFFFFFFFF;
  // Behind an open bracket a line `name:` may be an argument or the next property; what follows
  // tells.
  constexpr std::uint32_t kLookahead = 4096;

  std::string open(options.open - (options.open_block && options.open > 0 ? 1 : 0), '(');
  if (options.open_block) open += '{';
  std::size_t open_blocks = options.open_block ? 1 : 0;
  std::uint32_t property = kNowhere;

  // Where to go on if a statement begins at `at`, the first token of a line.
  const auto at_line = [&](std::uint32_t at) {
    const Beginning beginning = classify(text, at);
    if (beginning == Beginning::None) {
      const bool is_next = open.empty() && indent_of_line(text, at) <= options.indent;
      return is_next && may_begin_statement(text, at) ? at : kNowhere;
    }
    if (open.empty()) return at;
    if (open_blocks > 0) return kNowhere;
    if (beginning == Beginning::Statement || !options.is_patient) return std::min(property, at);
    property = std::min(property, at);
    return kNowhere;
  };

  const auto size = static_cast<std::uint32_t>(text.size());
  // The place itself may be the beginning of the next line's statement.
  if (is_first_of_line(text, from)) {
    if (const std::uint32_t found = at_line(from); found != kNowhere) return found;
  }
  for (std::uint32_t at = from; at < size;) {
    if (property != kNowhere && at - property > kLookahead) return property;
    const std::uint32_t behind = end_of_opaque(text, at);
    if (behind > at) {
      // A comment that is never closed is worth an error of its own.
      const bool is_comment = text[at] == '/' && text[at + 1] == '*';
      if (is_comment && behind == size && !text.ends_with("*/")) return at;
      at = behind;
      continue;
    }
    const char c = text[at];
    if (c == '\n') {
      at = first_of_line(text, at + 1);
      if (const std::uint32_t found = at_line(at); found != kNowhere) return found;
    } else if (c == '(' || c == '[' || c == '{') {
      open += c == '{' ? '{' : '(';
      open_blocks += c == '{';
      ++at;
    } else if (c == ')' || c == ']') {
      if (!open.empty() && open.back() == '(') open.pop_back();
      if (open.empty()) property = kNowhere;
      ++at;
    } else if (c == '}') {
      if (open_blocks == 0) return std::min(property, at);
      open.resize(open.rfind('{'));
      --open_blocks;
      ++at;
    } else if (c == ',' && open.empty()) {
      const std::uint32_t next = skip_blanks(text, at + 1);
      if (classify(text, next) == Beginning::Property) return next;
      ++at;
    } else {
      at = std::max(at + 1, end_of_identifier(text, at));
    }
  }
  return std::min(property, size);
}

bool looks_like_statement(std::string_view text, std::uint32_t at) {
  return classify(text, at) != Beginning::None;
}

bool looks_like_object(std::string_view text, std::uint32_t at) {
  std::uint32_t end = end_of_identifier(text, at);
  while (char_at(text, end) == '.' && is_letter(char_at(text, end + 1))) {
    end = end_of_identifier(text, end + 1);
  }
  const std::uint32_t next = skip_blanks(text, end);
  if (char_at(text, next) == '{') return true;
  const std::uint32_t name_end = end_of_identifier(text, next);
  return name_end > next && char_at(text, skip_blanks(text, name_end)) == '{';
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
