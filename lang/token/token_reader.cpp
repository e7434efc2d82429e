#include "lang/token/token_reader.hpp"

namespace sdlc::lang {

std::uint32_t skip_space(std::string_view text, std::uint32_t at) noexcept {
  return TokenReader(text, at).next_solid().span.begin;
}

Span token_at(std::string_view text, std::uint32_t at) noexcept {
  return scene_token(text, at).span;
}

std::uint32_t end_of_unclosed_string(std::string_view text, Span string) noexcept {
  const std::size_t last = text.find_last_not_of(" \t\r)]},", string.end - 1);
  return static_cast<std::uint32_t>(last + 1);
}

}  // namespace sdlc::lang
