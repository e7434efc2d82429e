#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Bytes of the longest text that is repaired. Longer ones are hardly written by hand.
inline constexpr std::size_t kMaxRepairedText = std::size_t{256} << 10;

/// A part of a text and what replaces it.
struct Edit {
  Span span;
  std::string text;
};

/// A text after repairs, which maps its bytes to those of its source. Edits are applied in rounds:
/// each round counts the bytes of the text before it.
class RepairedText {
 public:
  explicit RepairedText(std::string_view source)
      : text_(source), part_{0, static_cast<std::uint32_t>(source.size())} {}

  const std::string& text() const noexcept { return text_; }
  /// The part of the text that repairs read and edit: all of it, unless set_part() was called.
  Span part() const noexcept { return part_; }
  /// Precondition: each end of the part is one of the text or the first token of a line.
  void set_part(Span part) noexcept { part_ = part; }
  /// Whether anything was edited or reported.
  bool is_changed() const noexcept { return !rounds_.empty() || !reported_.empty(); }

  /// Makes the edits, which are inside the part. One that begins inside another is dropped; of
  /// several insertions at one place the order is kept.
  void apply(std::vector<Edit> edits);

  /// Suppresses further reports of a part of the source.
  void note_reported(Span source) { reported_.push_back(source); }
  /// Whether the place in this text is in a part that note_reported() was called for.
  bool is_reported(std::uint32_t at) const noexcept;

  /// The place in the source of a place in this text.
  std::uint32_t in_source(std::uint32_t at) const noexcept;
  /// Text removed next to the span is not part of it.
  Span in_source(Span span) const noexcept;
  /// Whether the byte was written by an edit and has no counterpart in the source.
  bool is_added(std::uint32_t at) const noexcept;

 private:
  /// The replacement of one edit: a part of the new text for a part of the old.
  struct Piece {
    Span before, after;
  };
  using Round = std::vector<Piece>;

  static const Piece* piece_at(const Round& round, std::uint32_t at) noexcept;
  static std::uint32_t before(const Round& round, std::uint32_t at) noexcept;
  static std::uint32_t end_before(const Round& round, std::uint32_t end) noexcept;

  std::string text_;
  Span part_;
  std::vector<Round> rounds_;
  std::vector<Span> reported_;
};

}  // namespace sdlc::lang
