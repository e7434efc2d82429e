#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "lang/repair/repaired_text.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

inline constexpr std::string_view kJsonSpaces = " \t\r\n";

/// The text that is parsed: that of a file, or a repaired copy. The parser's spans are offsets in
/// it; diagnostics and the tape have spans of the file.
class ParsedText {
 public:
  /// `repaired` must outlive the object.
  ParsedText(const SourceFile& file, const std::optional<RepairedText>& repaired) noexcept
      : file_(file),
        repaired_(repaired ? &*repaired : nullptr),
        text_(repaired ? std::string_view(repaired->text()) : file.text()) {}

  const SourceFile& file() const noexcept { return file_; }
  std::string_view text() const noexcept { return text_; }
  std::string_view text(Span span) const { return text_.substr(span.begin, span.size()); }
  /// The character at the offset; NUL at the end.
  char operator[](std::size_t offset) const noexcept {
    return offset < text_.size() ? text_[offset] : '\0';
  }

  Span in_file(Span span) const { return repaired_ == nullptr ? span : repaired_->in_source(span); }
  Location at(Span span) const { return {&file_, in_file(span)}; }
  bool is_added(std::uint32_t offset) const {
    return repaired_ != nullptr && repaired_->is_added(offset);
  }
  /// Whether the character is in the file and not a mark of lang/repair.
  bool is_of_file(std::uint32_t mark) const {
    return file_.text()[in_file({mark, mark + 1}).begin] == text_[mark];
  }

  /// The last character of the file before the offset that is not one of `skipped`; NUL if none.
  char last_before(std::uint32_t offset, std::string_view skipped) const {
    const std::string_view before = file_.text().substr(0, in_file({offset, offset}).begin);
    const std::size_t last = before.find_last_not_of(skipped);
    return last == std::string_view::npos ? '\0' : before[last];
  }
  /// The empty span after the last token before the offset, where something is missing. It is
  /// searched in the file, because repairs may have removed that token from the parsed text.
  Location gap_before(std::uint32_t offset) const {
    const std::string_view before = file_.text().substr(0, in_file({offset, offset}).begin);
    const auto end = static_cast<std::uint32_t>(before.find_last_not_of(kJsonSpaces) + 1);
    return {&file_, {end, end}};
  }

 private:
  const SourceFile& file_;
  const RepairedText* repaired_;
  std::string_view text_;
};

}  // namespace sdlc::lang
