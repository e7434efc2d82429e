#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The tokens of a text and its possible line breaks, after Oppen ("Prettyprinting", TOPLAS 2(4),
/// 1980) and Wadler ("A prettier printer", 2003). Either all line breaks of a group are taken, or
/// none. A group is on one line if it fits there together with the unbreakable text after it, and
/// if nothing in it ends a line. Takes linear time: widths of groups are computed while they are
/// built.
class Layout {
 public:
  /// The tokens are those of `source`.
  explicit Layout(std::string_view source) : source_(source) {}

  void token(Span span);
  void space() { push(Kind::Space), widen(1); }
  /// A possible line break; a space if the group is on one line.
  void line() { end_tails(), push(Kind::Line), widen(1); }
  /// A possible line break; nothing if the group is on one line.
  void soft_line() { end_tails(), push(Kind::SoftLine); }
  /// An empty line before the next line, if a line begins here.
  void blank_line() { push(Kind::BlankLine); }

  void open_group();
  void close_group();
  /// Breaks the innermost open group, and thereby those around it.
  void break_group() noexcept;

  void indent() { push(Kind::Indent); }
  void dedent() { push(Kind::Dedent); }

  void comma() { push(Kind::Comma), widen(1); }
  /// A comma if the innermost group is on one line.
  void flat_comma() { push(Kind::FlatComma), ++flat_width_; }
  /// A comma if the innermost group is broken.
  void broken_comma() { push(Kind::BrokenComma), ++tail_width_; }

  /// A `//` comment, after other text or on its own line.
  void line_comment(Span span, bool has_own_line);
  void block_comment(Span span, bool has_own_line, bool ends_line);

 private:
  friend class LayoutPrinter;

  enum class Kind : std::uint8_t {
    Token,
    Space,
    Line,
    SoftLine,
    BlankLine,
    Group,
    EndGroup,
    Indent,
    Dedent,
    Comma,
    FlatComma,
    BrokenComma,
    LineComment,
    BlockComment,
  };

  struct Item {
    Kind kind = Kind::Token;
    bool is_broken = false;                        ///< of a group
    bool has_own_line = false, ends_line = false;  ///< of a comment
    std::uint32_t begin = 0;  ///< in the source; of a group: first its column, then its width
    std::uint32_t end = 0;
  };

  /// A closed group while the width of the unbreakable text after it is unknown.
  struct Tail {
    std::uint32_t group = 0, begin = 0;
  };

  void push(Kind kind, Span span = {}) {
    items_.push_back({.kind = kind, .begin = span.begin, .end = span.end});
  }
  void widen(std::uint32_t columns) noexcept { flat_width_ += columns, tail_width_ += columns; }
  void end_tails() noexcept;
  void clear();

  std::string_view source_;
  std::vector<Item> items_;
  std::vector<std::uint32_t> open_groups_;
  std::vector<Tail> tails_;
  std::uint32_t flat_width_ = 0;  ///< of all items on one line
  std::uint32_t tail_width_ = 0;  ///< of all items with all groups broken
};

/// Writes layouts one after the other.
class LayoutPrinter {
 public:
  /// `indent`: columns before unindented text.
  LayoutPrinter(std::string_view source, std::uint32_t indent)
      : source_(source), indent_(indent), line_indent_(indent) {}

  /// Reserves memory for the text.
  void reserve(std::size_t size) { text_.reserve(size); }

  /// Writes the layout and clears it. Precondition: no group is open.
  void print(Layout& layout);
  std::string take_text() { return std::move(text_); }

 private:
  using Item = Layout::Item;
  using Kind = Layout::Kind;

  void open_group(const Item& group);
  void line(bool is_soft);
  void put_token(const Item& token);
  void put_comment(const Item& comment);
  void put_comment_text(std::string_view comment);
  void begin_text(char first);
  void put(std::string_view text);
  bool is_flat() const noexcept { return !flat_.empty() && flat_.back(); }

  std::string_view source_;
  std::string text_;
  std::vector<bool> flat_;  // of the open groups
  std::uint32_t indent_;
  std::uint32_t column_ = 0;
  // Pending spaces and line breaks, written before the next text.
  std::uint32_t line_breaks_ = 0;
  std::uint32_t line_indent_;  // of the next line
  bool has_space_ = false;
  bool is_after_opener_ = true;
  bool has_only_comments_ = true;  // the current line
};

}  // namespace sdlc::lang
