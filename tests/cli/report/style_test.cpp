#include "cli/report/style.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

using Colors = std::map<std::string, std::string>;

/// The variables in the light or the dark scheme.
Colors colors_of(bool is_dark) {
  static const std::regex kVariable(
      "--([a-z0-9-]+): light-dark\\(#([0-9a-f]{6}), #([0-9a-f]{6})\\)");
  const std::string sheet(style_sheet());
  Colors colors;
  for (std::sregex_iterator it(sheet.begin(), sheet.end(), kVariable), end; it != end; ++it) {
    colors[(*it)[1]] = (*it)[is_dark ? 3 : 2];
  }
  return colors;
}

/// Relative luminance as defined by WCAG 2.2.
double luminance(const std::string& color) {
  const auto channel = [&](std::size_t at) {
    const double code = std::stoi(color.substr(at, 2), nullptr, 16) / 255.0;
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * channel(0) + 0.7152 * channel(2) + 0.0722 * channel(4);
}

double contrast(const std::string& a, const std::string& b) {
  const auto [low, high] = std::minmax({luminance(a), luminance(b)});
  return (high + 0.05) / (low + 0.05);
}

TEST(StyleSheet, TextHasContrastOnEachBackground) {
  for (const bool is_dark : {false, true}) {
    const Colors colors = colors_of(is_dark);
    for (const char* text : {"ink", "soft", "accent", "better", "worse"}) {
      EXPECT_GE(contrast(colors.at(text), colors.at("page")), 4.5) << is_dark << " " << text;
    }
    EXPECT_GE(contrast(colors.at("ink"), colors.at("panel")), 4.5) << is_dark;
    EXPECT_GE(contrast(colors.at("ink"), colors.at("note")), 4.5) << is_dark;
  }
}

TEST(StyleSheet, DrawingsHaveContrastWithThePage) {
  for (const bool is_dark : {false, true}) {
    const Colors colors = colors_of(is_dark);
    for (const char* drawn : {"s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "front"}) {
      EXPECT_GE(contrast(colors.at(drawn), colors.at("page")), 3) << is_dark << " " << drawn;
    }
  }
}

}  // namespace
}  // namespace sdlc::cli
