#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// What docs/explain tells about the diagnostic with this code, such as "E104": a page of Markdown
/// with a wrong and a right example. Nothing where there is no such page.
std::optional<std::string_view> explanation(std::string_view code);

/// "unknown property"
std::string title_of(const DiagnosticInfo& info);

/// Diagnostics whose codes begin alike.
struct DiagnosticFamily {
  std::string_view prefix;
  std::string_view title;
};

inline constexpr std::array<DiagnosticFamily, 7> kDiagnosticFamilies{{
    {"E0", "Syntax"},
    {"E1", "Names"},
    {"E2", "Types and values"},
    {"E3", "Limits and files"},
    {"W4", "The picture will not be what was meant"},
    {"W5", "How the picture is made"},
    {"S6", "Style"},
}};

}  // namespace sdlc::lang
