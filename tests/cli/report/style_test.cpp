#include "cli/report/style.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

using Colors = std::map<std::string, std::string>;

/// The variables of the first :root after a given text.
Colors colors_after(const std::string& text) {
  const std::string sheet(style_sheet());
  const std::size_t begin = sheet.find(":root {", sheet.find(text));
  const std::string block = sheet.substr(begin, sheet.find('}', begin) - begin);
  static const std::regex kVariable("--([a-z0-9-]+): #([0-9a-f]{6})");
  Colors colors;
  for (std::sregex_iterator it(block.begin(), block.end(), kVariable), end; it != end; ++it) {
    colors[(*it)[1]] = (*it)[2];
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

const std::array<std::string, 3> kMedia{":root", "prefers-color-scheme: dark", "@media print"};

TEST(StyleSheet, TextHasContrastOnEachBackground) {
  for (const std::string& medium : kMedia) {
    const Colors colors = colors_after(medium);
    for (const char* text : {"ink", "soft", "accent", "better", "worse"}) {
      EXPECT_GE(contrast(colors.at(text), colors.at("page")), 4.5) << medium << " " << text;
    }
    EXPECT_GE(contrast(colors.at("ink"), colors.at("panel")), 4.5) << medium;
    EXPECT_GE(contrast(colors.at("ink"), colors.at("note")), 4.5) << medium;
  }
}

TEST(StyleSheet, DrawingsHaveContrastWithThePage) {
  for (const std::string& medium : kMedia) {
    const Colors colors = colors_after(medium);
    for (const char* drawn : {"s0", "s1", "s2", "s3", "s4", "s5", "s6", "s7", "front"}) {
      EXPECT_GE(contrast(colors.at(drawn), colors.at("page")), 3) << medium << " " << drawn;
    }
  }
}

TEST(StyleSheet, EachMediumSetsTheSameColors) {
  const Colors light = colors_after(kMedia[0]);
  for (const std::string& medium : kMedia) {
    const Colors colors = colors_after(medium);
    EXPECT_TRUE(std::ranges::equal(light, colors, {}, &Colors::value_type::first,
                                   &Colors::value_type::first))
        << medium;
  }
}

}  // namespace
}  // namespace sdlc::cli
