#include "lang/token/lines.hpp"

namespace sdlc::lang {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }

}  // namespace

std::uint32_t skip_blanks(std::string_view text, std::uint32_t at) noexcept {
  while (at < text.size() && is_blank(text[at])) ++at;
  return at;
}

std::uint32_t line_begin(std::string_view text, std::uint32_t at) noexcept {
  if (at == 0) return 0;
  const std::size_t newline = text.rfind('\n', at - 1);
  return newline == std::string_view::npos ? 0 : static_cast<std::uint32_t>(newline + 1);
}

std::uint32_t indent_of_line(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t begin = line_begin(text, at);
  return skip_blanks(text, begin) - begin;
}

bool is_first_of_line(std::string_view text, std::uint32_t at) noexcept {
  while (at > 0 && is_blank(text[at - 1])) --at;
  return at == 0 || text[at - 1] == '\n';
}

}  // namespace sdlc::lang
