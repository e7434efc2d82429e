#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// The page of docs/explain for a code such as "E104": Markdown with a wrong and a right example.
/// nullopt if there is no such page.
std::optional<std::string_view> explanation(std::string_view code);

/// Diagnostics with a common prefix of their codes.
struct DiagnosticFamily {
  std::string_view prefix;
  std::string_view title;
};

inline constexpr std::array<DiagnosticFamily, 7> kDiagnosticFamilies{{
    {"E0", "Syntax"},
    {"E1", "Names"},
    {"E2", "Types and values"},
    {"E3", "Limits and files"},
    {"W4", "The picture will not be as intended"},
    {"W5", "How the picture is made"},
    {"S6", "Style"},
}};

}  // namespace sdlc::lang
