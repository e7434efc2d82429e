#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// What a text consists of and where it may be broken into lines, after Oppen ("Prettyprinting",
/// TOPLAS 2(4), 1980) and Wadler ("A prettier printer", 2003): tokens, and groups whose line breaks
/// are all taken or none is. A group stands on one line if it fits there together with what cannot
/// be parted from its end, and if nothing in it ends a line. Time is linear: how wide a group is
/// becomes known while it is built.
class Layout {
 public:
  /// The tokens are those of `source`.
  explicit Layout(std::string_view source) : source_(source) {}

  void token(Span span);
  void space() { push(Kind::Space), widen(1); }
  /// Where the group may be broken; a space otherwise.
  void line() { end_tails(), push(Kind::Line), widen(1); }
  /// The same; nothing otherwise.
  void soft_line() { end_tails(), push(Kind::SoftLine); }
  /// The next line is preceded by an empty one, if it begins one.
  void blank_line() { push(Kind::BlankLine); }

  void open_group();
  void close_group();
  /// The innermost open group, and so those around it, do not stand on one line.
  void break_group() noexcept;

  void indent() { push(Kind::Indent); }
  void dedent() { push(Kind::Dedent); }

  void comma() { push(Kind::Comma), widen(1); }
  /// A comma where the innermost group stands on one line.
  void flat_comma() { push(Kind::FlatComma), ++flat_width_; }
  /// A comma where it does not.
  void broken_comma() { push(Kind::BrokenComma), ++tail_width_; }

  /// A `//` comment that stands behind something, or alone in its line.
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
    std::uint32_t begin =
        0;  ///< in the source; of a group: columns at its beginning, later its width
    std::uint32_t end = 0;
  };

  /// A group that is closed, while it is not known what cannot be parted from its end.
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
  std::uint32_t flat_width_ = 0;  ///< of all so far, on one line
  std::uint32_t tail_width_ = 0;  ///< the same, the groups with line breaks broken
};

/// Writes layouts, one behind the other.
class LayoutPrinter {
 public:
  /// `indent`: columns in front of what is not indented.
  LayoutPrinter(std::string_view source, std::uint32_t indent)
      : source_(source), indent_(indent), line_indent_(indent) {}

  /// Makes room for so many bytes.
  void reserve(std::size_t size) { text_.reserve(size); }

  /// Writes what the layout holds and empties it. Precondition: no group is open.
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
  // What is between the last text and the next is settled when that comes.
  std::uint32_t line_breaks_ = 0;
  std::uint32_t line_indent_;  // of the line that begins then
  bool has_space_ = false;
  bool is_behind_opener_ = true;
  bool has_only_comments_ = true;  // the line so far
};

}  // namespace sdlc::lang
