#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A comment and how it stands in its line.
struct PlacedComment {
  Span span;
  CommentKind kind = CommentKind::Line;
  std::uint32_t breaks_before = 0;  ///< line ends between it and what stands in front of it
  bool ends_line = false;           ///< a line end follows, or the text's end

  bool has_own_line() const noexcept { return breaks_before > 0; }
};

struct Token {
  Span span;
  std::uint32_t breaks_before = 0;  ///< line ends between it and the token or comment before it
};

/// Reads the tokens of a text that was parsed without errors, and the comments in front of each.
class TokenReader {
 public:
  explicit TokenReader(const SyntaxTree& tree) : tree_(&tree) { seek(0); }

  /// Goes on with the first token or comment at or behind `at`.
  void seek(std::uint32_t at);

  /// The next token; empty at the end of the text.
  const Token& peek() const noexcept { return token_; }
  std::string_view peek_text() const noexcept { return tree_->text(token_.span); }
  bool is_at_end() const noexcept { return token_.span.size() == 0; }

  /// The comments in front of the next token that were not yet taken.
  bool has_comments() const noexcept { return next_comment_ < comments_.size(); }
  const PlacedComment& peek_comment() const noexcept { return comments_[next_comment_]; }
  /// How many of them stand in the line of the last token.
  std::size_t count_trailing_comments() const noexcept;
  const PlacedComment& comment(std::size_t n) const noexcept {
    return comments_[next_comment_ + n];
  }
  bool ends_with_line_end() const noexcept;
  PlacedComment take_comment() noexcept { return comments_[next_comment_++]; }

  /// Line ends in front of whatever comes next.
  std::uint32_t breaks_ahead() const noexcept {
    return has_comments() ? peek_comment().breaks_before : token_.breaks_before;
  }
  /// Whether a line ends in front of the next token.
  bool is_broken_ahead() const noexcept;

  /// Takes the token and the comments in front of it.
  Token take();
  /// Takes the token; the comments in front of it come before those behind it.
  Token lift();

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;  // no text is so long

  void read_gap();
  std::uint32_t read_comments(std::uint32_t breaks);
  void find_next_in_tree() noexcept;
  std::uint32_t count_breaks();

  const SyntaxTree* tree_;
  std::uint32_t at_ = 0;  // behind the next token
  std::span<const Comment> left_in_tree_;
  std::uint32_t next_in_tree_ = kNone;   // where the first of them begins
  std::vector<PlacedComment> comments_;  // in front of the next token
  std::size_t next_comment_ = 0;
  Token token_;
};

}  // namespace sdlc::lang
