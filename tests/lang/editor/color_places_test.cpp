#include "lang/editor/color_places.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/value/colors.hpp"
#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

std::string codes_of(const lang::ColorPlace& place) {
  std::string text;
  for (const double component : place.displayed()) {
    text += (text.empty() ? "" : " ") + std::to_string(std::lround(component * 255));
  }
  return text;
}

/// Each colour as its text and codes.
std::vector<std::string> colors_in(const std::string& text) {
  MarkedScene scene("scene 1\n" + text);
  std::vector<std::string> texts;
  for (const lang::ColorPlace& place : lang::colors_of(scene.view(), 0)) {
    texts.push_back(std::string(scene.view().file(0).text(place.where)) + " = " + codes_of(place));
  }
  return texts;
}

std::vector<std::string> presentations(const std::string& color, std::array<int, 3> codes) {
  MarkedScene scene("scene 1\nlet a = " + color + "\n");
  const auto places = lang::colors_of(scene.view(), 0);
  if (places.size() != 1) return {"no colour"};
  EXPECT_TRUE(lang::color_at(scene.view(), 0, places[0].where).has_value());
  return lang::color_presentations(scene.view(), 0, places[0],
                                   {codes[0] / 255.0, codes[1] / 255.0, codes[2] / 255.0});
}

std::string first(const std::string& color, std::array<int, 3> codes) {
  return presentations(color, codes).at(0);
}

TEST(ColorPlaces, AreLiteralsNamesAndConstructors) {
  EXPECT_THAT(colors_in("let a = [#fc0, #0a0B0c, tomato, rgb(1, g: 2, b: 3), linear(1, 0, 0.5),\n"
                        "linear255(r: 255, b: 0, g: 0), hsl(120deg, 100%, 25%), kelvin(6500)]\n"),
              ElementsAre("#fc0 = 255 204 0", "#0a0B0c = 10 11 12", "tomato = 255 99 71",
                          "rgb(1, g: 2, b: 3) = 1 2 3", "linear(1, 0, 0.5) = 255 0 188",
                          "linear255(r: 255, b: 0, g: 0) = 255 0 0",
                          "hsl(120deg, 100%, 25%) = 0 128 0", "kelvin(6500) = 255 249 254"));
}

TEST(ColorPlaces, AreNotNamesOfTheScene) {
  EXPECT_THAT(colors_in("let red = 1\nfn rgb(r, g, b) = r\nlet a = red\nlet b = rgb(1, 2, 3)\n"
                        "let c = pi\nlet d = tan(3deg)\nfn f(tan) = tan\nsphere blue {}\n"),
              IsEmpty());
}

TEST(ColorPlaces, AreNotCallsWithWrongOrComputedArguments) {
  EXPECT_THAT(
      colors_in("let x = 1\nlet a = [rgb(x, 2, 3), rgb(1, 2), rgb(1, 2, 300), rgb(1, 2, -3),"
                " hsl(120, 1, 1), linear(-1, 0, 0), rgb(1, 2, 3, 4), rgb(r: 1, r: 2, g: 3),"
                " rgb(1, 2, q: 3), rgb(1deg, 2, 3)]\nlet b = rgb(1, 2, 3\n"),
      IsEmpty());
}

TEST(ColorPlaces, BrighterThanWhiteKeepTheirIntensity) {
  EXPECT_THAT(colors_in("let a = linear(4, 2, 0)\n"), ElementsAre("linear(4, 2, 0) = 255 188 0"));
  EXPECT_THAT(presentations("linear(4, 2, 0)", {255, 255, 0}), ElementsAre("linear(4, 4, 0)"));
  EXPECT_THAT(presentations("linear255(1020, 0, 0)", {0, 0, 255}),
              ElementsAre("linear255(0, 0, 1020)"));
}

TEST(ColorPresentations, KeepTheSpellingOfHex) {
  EXPECT_EQ(first("#fc0", {255, 204, 17}), "#fc1");
  EXPECT_EQ(first("#fc0", {255, 204, 18}), "#ffcc12");
  EXPECT_EQ(first("#FC0", {255, 204, 171}), "#FFCCAB");
  EXPECT_EQ(first("#FC0", {255, 204, 170}), "#FCA");
  EXPECT_EQ(first("#ffcc00", {255, 255, 255}), "#ffffff");
}

TEST(ColorPresentations, OfNamesAreNamesOrHex) {
  EXPECT_EQ(first("tomato", {255, 0, 0}), "red");
  EXPECT_EQ(first("tomato", {255, 1, 0}), "#ff0100");
  EXPECT_THAT(presentations("#f00", {255, 99, 71}), Contains("tomato"));
  EXPECT_THAT(presentations("tomato", {1, 2, 3}), ElementsAre("#010203", "rgb(1, 2, 3)"));
}

TEST(ColorPresentations, DoNotUseNamesThatTheSceneHides) {
  EXPECT_THAT(presentations("tomato\nlet red = 1\nfn rgb(r, g, b) = r", {255, 0, 0}),
              ElementsAre("#ff0000"));
  EXPECT_THAT(presentations("#fc0\nfn red(r) = r", {255, 0, 0}),
              ElementsAre("#f00", "red", "#ff0000", "rgb(255, 0, 0)"));
}

TEST(ColorPresentations, KeepLabelsCommentsAndUnchangedNumbers) {
  EXPECT_EQ(first("rgb(r: 120, b: 1.5e1, /* c */ g: 0.0)", {130, 0, 15}),
            "rgb(r: 130, b: 1.5e1, /* c */ g: 0.0)");
  EXPECT_EQ(first("linear(0.25, 1, 0.50)", {255, 255, 188}), "linear(1, 1, 0.50)");
  EXPECT_EQ(first("hsl(hue: 0.5turn, saturation: 1, lightness: 50%)", {255, 0, 0}),
            "hsl(hue: 0turn, saturation: 1, lightness: 50%)");
  EXPECT_EQ(first("hsl(20deg, 100%, 50%)", {51, 51, 51}), "hsl(20deg, 0%, 20%)");
}

TEST(ColorPresentations, OfTheSameColourAreItsText) {
  EXPECT_THAT(presentations("rgb(1_2, 2, 3)", {12, 2, 3}), ElementsAre("rgb(1_2, 2, 3)"));
  EXPECT_THAT(presentations("kelvin(6500)", {255, 249, 254}), ElementsAre("kelvin(6500)"));
}

TEST(ColorPresentations, HaveThePickedColourInEverySpelling) {
  for (const char* old : {"#000", "tan", "rgb(1, 2, 3)", "hsl(0.1rad, 10%, 0.5)",
                          "linear(0.1, 20%, 0)", "linear255(3, 3, 3)", "kelvin(2700)"}) {
    for (int code = 0; code < 256; code += 5) {
      const std::array<int, 3> codes{code, 255 - code, code * code % 256};
      const std::string text = first(old, codes);
      MarkedScene scene("scene 1\nlet a = " + text + "\n");
      const auto places = lang::colors_of(scene.view(), 0);
      ASSERT_EQ(places.size(), 1u) << old << " " << text;
      EXPECT_EQ(codes_of(places[0]), std::to_string(codes[0]) + " " + std::to_string(codes[1]) +
                                         " " + std::to_string(codes[2]))
          << text;
    }
  }
}

TEST(ColorPresentations, ClampWhatIsNoColour) {
  MarkedScene scene("scene 1\nlet a = #fc0\n");
  const auto place = lang::colors_of(scene.view(), 0).at(0);
  EXPECT_EQ(lang::color_presentations(scene.view(), 0, place, {2, -1, std::nan("")}).at(0), "#f00");
}

TEST(ConfigColors, AreTheValuesOfColourKeys) {
  const std::string text =
      "{\"background\": [255, 127.5, 0], \"spheres\": [{\"origin\": [1, 2, 3], \"material\":\n"
      "{\"type\": \"emissive\", \"color\": [510,\n 0, 255]}}, {\"color\": [1, 2]}, {\"color\": [1, "
      "2, "
      "-3]}], \"image\": {\"color\": [";
  const auto places = lang::colors_of_config(text);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(text.substr(places[0].where.begin, places[0].where.size()), "[255, 127.5, 0]");
  EXPECT_EQ(codes_of(places[0]), "255 188 0");
  EXPECT_EQ(codes_of(places[1]), "255 0 188");
  EXPECT_THAT(lang::config_color_presentations(text, places[0], {0, 188 / 255.0, 1}),
              ElementsAre("[0, 127.5, 255]"));
  EXPECT_THAT(lang::config_color_presentations(text, places[1], {1, 1, 0}),
              ElementsAre("[510,\n 510, 0]"));
}

}  // namespace
}  // namespace sdlc::test
