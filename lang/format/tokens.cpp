#include "lang/format/tokens.hpp"

#include <algorithm>
#include <array>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

/// What a character can be part of, so that one look should do: most of the time goes into them.
enum CharacterClass : std::uint8_t { kMark, kBlank, kLineEnd, kIdchar };
constexpr std::array<CharacterClass, 256> kClasses = [] {
  std::array<CharacterClass, 256> classes{};
  for (unsigned c = 0; c < 128; ++c) {
    const bool is_idchar =
        is_ascii_letter(static_cast<char>(c)) || c == '_' || is_ascii_digit(static_cast<char>(c));
    if (is_idchar) classes[c] = kIdchar;
  }
  classes[' '] = classes['\t'] = classes['\r'] = kBlank;
  classes['\n'] = kLineEnd;
  return classes;
}();
CharacterClass class_of(char c) noexcept { return kClasses[static_cast<unsigned char>(c)]; }
bool is_idchar(char c) noexcept { return class_of(c) == kIdchar; }

char char_at(std::string_view text, std::size_t at) { return at < text.size() ? text[at] : '\0'; }

std::size_t end_of_number(std::string_view text, std::size_t at) {
  for (;; ++at) {
    while (is_idchar(char_at(text, at))) ++at;
    const char c = char_at(text, at);
    const bool is_point = c == '.' && is_ascii_digit(char_at(text, at + 1));
    // No unit ends in `e`.
    const bool is_sign = (c == '+' || c == '-') && (text[at - 1] == 'e' || text[at - 1] == 'E');
    if (c != '%' && !is_point && !is_sign) return at;
  }
}

std::size_t end_of_string(std::string_view text, std::size_t at) {
  while (text[at] != '"') at += text[at] == '\\' ? 2 : 1;
  return at + 1;
}

std::size_t end_of_mark(std::string_view text, std::size_t at) {
  const char c = text[at], next = char_at(text, at + 1);
  const bool is_comparison = (c == '=' || c == '!' || c == '<' || c == '>') && next == '=';
  const bool is_double = is_comparison || (c == '.' && next == '.');
  return at + (is_double ? 2 : 1);
}

/// Behind the token that begins at `at`. Precondition: there is one, and nothing is wrong with it.
std::size_t end_of_token(std::string_view text, std::size_t at) {
  const char c = text[at];
  if (is_ascii_digit(c) || (c == '.' && is_ascii_digit(char_at(text, at + 1)))) {
    return end_of_number(text, at + 1);
  }
  if (is_idchar(c) || c == '#') {
    do ++at;
    while (is_idchar(char_at(text, at)));
    return at;
  }
  if (c == '"') return end_of_string(text, at + 1);
  return end_of_mark(text, at);
}

}  // namespace

void TokenReader::seek(std::uint32_t at) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (at == 0 && tree_->file().text().starts_with(kByteOrderMark)) at = kByteOrderMark.size();
  at_ = at;
  const auto comments = tree_->comments();
  const auto is_before = [](const Comment& comment, std::uint32_t place) {
    return comment.span.begin < place;
  };
  left_in_tree_ = {std::lower_bound(comments.begin(), comments.end(), at, is_before),
                   comments.end()};
  find_next_in_tree();
  comments_.clear();
  next_comment_ = 0;
  read_gap();
  if (at == 0 && has_comments()) comments_[0].breaks_before = 1;
}

std::uint32_t TokenReader::count_breaks() {
  const std::string_view text = tree_->file().text();
  std::uint32_t breaks = 0;
  std::uint32_t at = at_;
  for (; at < text.size(); ++at) {
    const CharacterClass c = class_of(text[at]);
    if (c != kBlank && c != kLineEnd) break;
    breaks += c == kLineEnd ? 1 : 0;
  }
  at_ = at;
  return breaks;
}

void TokenReader::read_gap() {
  const std::string_view text = tree_->file().text();
  std::uint32_t breaks = count_breaks();
  if (at_ == next_in_tree_) breaks = read_comments(breaks);
  token_ = {.span = {at_, at_}, .breaks_before = breaks};
  if (at_ < text.size()) at_ = static_cast<std::uint32_t>(end_of_token(text, at_));
  token_.span.end = at_;
}

/// Those that begin here, `breaks` line ends behind what stands in front of them; returns the line
/// ends behind them.
std::uint32_t TokenReader::read_comments(std::uint32_t breaks) {
  const std::size_t size = tree_->file().text().size();
  while (at_ == next_in_tree_) {
    const Comment& comment = left_in_tree_.front();
    left_in_tree_ = left_in_tree_.subspan(1);
    find_next_in_tree();
    const bool follows_line = !comments_.empty() && comments_.back().ends_line;
    at_ = comment.span.end;
    const std::uint32_t breaks_before = follows_line ? std::max(breaks, 1u) : breaks;
    breaks = count_breaks();
    const bool ends_line = breaks > 0 || at_ == size || comment.kind != CommentKind::Block;
    comments_.push_back({.span = comment.span,
                         .kind = comment.kind,
                         .breaks_before = breaks_before,
                         .ends_line = ends_line});
  }
  return breaks;
}

void TokenReader::find_next_in_tree() noexcept {
  next_in_tree_ = left_in_tree_.empty() ? kNone : left_in_tree_.front().span.begin;
}

std::size_t TokenReader::count_trailing_comments() const noexcept {
  std::size_t count = 0;
  while (next_comment_ + count < comments_.size() && !comment(count).has_own_line()) ++count;
  return count;
}

bool TokenReader::ends_with_line_end() const noexcept {
  return has_comments() && comments_.back().ends_line;
}

bool TokenReader::is_broken_ahead() const noexcept {
  if (token_.breaks_before > 0) return true;
  for (std::size_t i = next_comment_; i < comments_.size(); ++i) {
    if (comments_[i].has_own_line() || comments_[i].ends_line) return true;
  }
  return false;
}

Token TokenReader::take() {
  const Token taken = token_;
  comments_.clear();
  next_comment_ = 0;
  read_gap();
  return taken;
}

Token TokenReader::lift() {
  const Token taken = token_;
  const std::size_t before = comments_.size();
  read_gap();
  const bool has_more = comments_.size() > before;
  const std::uint32_t breaks = has_more ? comments_[before].breaks_before : token_.breaks_before;
  if (before > 0 && breaks > 0) comments_[before - 1].ends_line = true;
  return taken;
}

}  // namespace sdlc::lang
