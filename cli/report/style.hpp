#pragma once

#include <string_view>

namespace sdlc::cli {

/// The style sheet of the page: light and dark, on screen and on paper.
std::string_view style_sheet() noexcept;

}  // namespace sdlc::cli
