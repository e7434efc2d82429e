#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lang/text/bracket_repair.hpp"

namespace sdlc::lang {

/// Whether each bracket of a text, told by its tokens, closes the one before it that is open.
bool has_matching_brackets(std::span<const LayoutToken> tokens);

/// A text with what is missing added and what is too much blanked. It knows where in the text it
/// was made of its bytes are.
class MendedText {
 public:
  MendedText(std::string_view source, std::span<const LayoutToken> tokens,
             const BracketRepair& repair);

  const std::string& text() const noexcept { return text_; }
  /// The place in the source of a place in this text.
  std::uint32_t in_source(std::uint32_t at) const noexcept;
  bool is_added(std::uint32_t at) const noexcept;
  /// Whether the bracket ends a pair that perhaps should end elsewhere.
  bool is_uncertain(std::uint32_t at) const noexcept;

 private:
  void copy_to(std::uint32_t end);
  void add(std::string_view what);
  void correct(const LayoutToken& token);
  void repair_bracket(const BracketFault& fault);

  std::string_view source_;
  std::span<const LayoutToken> tokens_;
  std::uint32_t copied_ = 0;  ///< bytes of the source
  std::string text_;
  std::vector<std::uint32_t> added_, uncertain_;  ///< bytes of this text
};

}  // namespace sdlc::lang
