#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

/// A comment and its place in its line.
struct PlacedComment {
  Span span;
  bool is_block = false;
  std::uint32_t breaks_before = 0;  ///< line ends between it and the token or comment before it
  bool ends_line = false;           ///< a line end follows, or the text's end

  bool has_own_line() const noexcept { return breaks_before > 0; }
};

struct PlacedToken {
  Span span;
  std::uint32_t breaks_before = 0;  ///< line ends between it and the token or comment before it
};

/// The tokens of a text without trivia, and the comments before each. Precondition: the text has no
/// syntax errors.
class PlacedTokens {
 public:
  explicit PlacedTokens(std::string_view text) : reader_(text) { seek(0); }

  /// Continues with the first token or comment from `at` on.
  void seek(std::uint32_t at);
  /// The same, skipping comments on the line of `at`; returns the begin of the first item.
  std::uint32_t seek_line(std::uint32_t at);

  /// The next token; empty at the end of the text.
  const PlacedToken& peek() const noexcept { return token_; }
  std::string_view peek_text() const noexcept {
    return reader_.text().substr(token_.span.begin, token_.span.size());
  }
  bool is_at_end() const noexcept { return token_.span.size() == 0; }

  /// Whether there are untaken comments before the next token.
  bool has_comments() const noexcept { return next_comment_ < comments_.size(); }
  const PlacedComment& peek_comment() const noexcept { return comments_[next_comment_]; }
  /// The number of them on the line of the last token.
  std::size_t count_trailing_comments() const noexcept;
  const PlacedComment& comment(std::size_t n) const noexcept {
    return comments_[next_comment_ + n];
  }
  bool ends_with_line_end() const noexcept;
  PlacedComment take_comment() noexcept { return comments_[next_comment_++]; }

  /// Line ends before the next comment or token.
  std::uint32_t breaks_ahead() const noexcept {
    return has_comments() ? peek_comment().breaks_before : token_.breaks_before;
  }
  /// Whether a line ends before the next token.
  bool is_broken_ahead() const noexcept;

  /// Takes the token and the comments before it.
  PlacedToken take();
  /// Takes the token alone: the comments before it join those after it.
  PlacedToken lift();

 private:
  void read_gap();

  TokenReader reader_;                   // after the next token
  std::vector<PlacedComment> comments_;  // before the next token
  std::size_t next_comment_ = 0;
  PlacedToken token_;
};

}  // namespace sdlc::lang
