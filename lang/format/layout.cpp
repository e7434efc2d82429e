#include "lang/format/layout.hpp"

#include <algorithm>

#include "lang/format/format.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

bool is_opener(std::string_view token) { return token == "{" || token == "(" || token == "["; }

/// Only strings and comments may contain non-ASCII characters.
std::uint32_t columns_of(std::string_view token) {
  const bool is_string = token.front() == '"';
  return static_cast<std::uint32_t>(is_string ? count_code_points(token) : token.size());
}

/// Whether the token is a number without a digit before its point: it begins with a point and is
/// neither `.` nor `..`.
bool lacks_zero(std::string_view token) {
  return token.size() > 1 && token[0] == '.' && token[1] != '.';
}

std::string_view without_trailing_spaces(std::string_view text) {
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

}  // namespace

// Building

void Layout::token(Span span) {
  const std::string_view text = source_.substr(span.begin, span.size());
  push(Kind::Token, span);
  widen(columns_of(text) + (lacks_zero(text) ? 1 : 0));
}

void Layout::open_group() {
  open_groups_.push_back(static_cast<std::uint32_t>(items_.size()));
  push(Kind::Group, {flat_width_, flat_width_});
}

void Layout::close_group() {
  const std::uint32_t index = open_groups_.back();
  open_groups_.pop_back();
  Item& group = items_[index];
  group.begin = flat_width_ - group.begin;
  if (group.is_broken) break_group();
  tails_.push_back({.group = index, .begin = tail_width_});
  push(Kind::EndGroup);
}

void Layout::break_group() noexcept {
  if (!open_groups_.empty()) items_[open_groups_.back()].is_broken = true;
}

void Layout::end_tails() noexcept {
  for (const Tail& tail : tails_) items_[tail.group].begin += tail_width_ - tail.begin;
  tails_.clear();
}

void Layout::line_comment(Span span, bool has_own_line) {
  push(Kind::LineComment, span);
  items_.back().has_own_line = has_own_line;
  items_.back().ends_line = true;
  break_group();
}

void Layout::block_comment(Span span, bool has_own_line, bool ends_line) {
  push(Kind::BlockComment, span);
  items_.back().has_own_line = has_own_line;
  items_.back().ends_line = ends_line;
  const std::string_view text = source_.substr(span.begin, span.size());
  if (has_own_line || ends_line || text.find('\n') != std::string_view::npos) break_group();
  widen(static_cast<std::uint32_t>(count_code_points(text)) + 1);
}

void Layout::clear() {
  end_tails();
  items_.clear();
  flat_width_ = tail_width_ = 0;
}

// Writing

void LayoutPrinter::print(Layout& layout) {
  layout.end_tails();
  for (const Item& item : layout.items_) {
    switch (item.kind) {
      case Kind::Token: put_token(item); break;
      case Kind::Space: has_space_ = true; break;
      case Kind::Line: line(false); break;
      case Kind::SoftLine: line(true); break;
      case Kind::BlankLine:
        if (line_breaks_ > 0) line_breaks_ = 2;
        break;
      case Kind::Group: open_group(item); break;
      case Kind::EndGroup: flat_.pop_back(); break;
      case Kind::Indent: indent_ += kFormatIndent; break;
      case Kind::Dedent: indent_ -= kFormatIndent; break;
      case Kind::Comma: put(","); break;
      case Kind::FlatComma:
        if (is_flat()) put(",");
        break;
      case Kind::BrokenComma:
        if (!is_flat()) put(",");
        break;
      case Kind::LineComment:
      case Kind::BlockComment: put_comment(item); break;
    }
  }
  layout.clear();
}

void LayoutPrinter::open_group(const Item& group) {
  const std::uint32_t column = line_breaks_ > 0 ? line_indent_ : column_ + (has_space_ ? 1 : 0);
  const bool fits = !group.is_broken && std::uint64_t{column} + group.begin <= kFormatWidth;
  flat_.push_back(is_flat() || fits);
}

void LayoutPrinter::line(bool is_soft) {
  if (!is_flat()) {
    line_breaks_ = std::max(line_breaks_, 1u);
    line_indent_ = indent_;
  } else if (!is_soft) {
    has_space_ = true;
  }
}

void LayoutPrinter::put_token(const Item& token) {
  const std::string_view text = source_.substr(token.begin, token.end - token.begin);
  if (lacks_zero(text)) put("0");
  put(text);
}

void LayoutPrinter::put_comment(const Item& comment) {
  const std::string_view text = source_.substr(comment.begin, comment.end - comment.begin);
  const bool is_line = comment.kind == Kind::LineComment;
  const bool was_after_opener = is_after_opener_;
  if (comment.has_own_line && line_breaks_ == 0) {
    // A line break where there is no other one.
    line_breaks_ = 1;
    line_indent_ = indent_ + kFormatIndent;
  } else if (line_breaks_ == 0 && is_line) {
    text_ += ' ';
    has_space_ = true;
  } else if (line_breaks_ == 0) {
    const bool is_inside = !text_.empty() && (text_.back() == '(' || text_.back() == '[');
    has_space_ = !(was_after_opener && is_inside);
  }
  has_only_comments_ = has_only_comments_ || line_breaks_ > 0;
  put_comment_text(is_line ? without_trailing_spaces(text) : text);
  // No empty line at the beginning of a block, also after a comment on the line of its brace.
  is_after_opener_ = was_after_opener && !comment.has_own_line;
  if (!comment.ends_line) {
    has_space_ = true;
    return;
  }
  line_breaks_ = 1;
  if (!has_only_comments_) line_indent_ = indent_ + kFormatIndent;
}

void LayoutPrinter::put_comment_text(std::string_view comment) {
  begin_text('/');
  std::size_t line_begin = 0;
  for (const char c : comment) {
    if (c == '\r') continue;  // only before a line feed
    text_ += c;
    if (c == '\n') line_begin = text_.size(), column_ = 0;
  }
  const std::string_view last =
      line_begin == 0 ? comment : std::string_view(text_).substr(line_begin);
  column_ += static_cast<std::uint32_t>(count_code_points(last));
}

void LayoutPrinter::begin_text(char first) {
  constexpr std::string_view kTight = ",:)]";
  if (line_breaks_ > 0) {
    const bool wants_blank = line_breaks_ > 1 && !is_after_opener_;
    if (!text_.empty()) text_.append(wants_blank ? 2 : 1, '\n');
    text_.append(line_indent_, ' ');
    column_ = line_indent_;
  } else if (has_space_ && kTight.find(first) == std::string_view::npos) {
    text_ += ' ';
    ++column_;
  }
  line_breaks_ = 0;
  has_space_ = false;
}

void LayoutPrinter::put(std::string_view text) {
  begin_text(text.front());
  text_ += text;
  column_ += columns_of(text);
  is_after_opener_ = is_opener(text);
  has_only_comments_ = false;
}

}  // namespace sdlc::lang
