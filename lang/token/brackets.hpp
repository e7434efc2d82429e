#pragma once

#include <cstdint>
#include <string_view>

namespace sdlc::lang {

/// The end of the bracket that matches the one at `at`, whatever its kind; `at` if none does.
std::uint32_t end_of_bracket(std::string_view text, std::uint32_t at) noexcept;

}  // namespace sdlc::lang
