#pragma once

#include <cstdint>
#include <string_view>

namespace sdlc::lang {

/// The end of the spaces, tabs and carriage returns at `at`.
std::uint32_t skip_blanks(std::string_view text, std::uint32_t at) noexcept;

/// Where the line begins that `at` is in.
std::uint32_t line_begin(std::string_view text, std::uint32_t at) noexcept;
/// Bytes of space at the beginning of the line that `at` is in.
std::uint32_t indent_of_line(std::string_view text, std::uint32_t at) noexcept;
/// Whether the line has only space before `at`.
bool is_first_of_line(std::string_view text, std::uint32_t at) noexcept;

}  // namespace sdlc::lang
