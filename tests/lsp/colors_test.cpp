#include <string>

#include <gtest/gtest.h>

#include "tests/lsp/ranges.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

constexpr auto kColors = "textDocument/documentColor";
constexpr auto kPresentations = "textDocument/colorPresentation";

Json color(double red, double green, double blue) {
  return {{"red", red}, {"green", green}, {"blue", blue}, {"alpha", 1}};
}

Json params_of(TestClient& client, const std::string& name) {
  return {{"textDocument", {{"uri", client.uri(name)}}}};
}

TEST(ColorRequests, FindColoursInUtf16Positions) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = [\"😀\", #fff, red]\n");
  EXPECT_EQ(client.result(kColors, params_of(client, "a.scene")),
            Json::array({{{"range", range_in_line(1, 15, 19)}, {"color", color(1, 1, 1)}},
                         {{"range", range_in_line(1, 21, 24)}, {"color", color(1, 0, 0)}}}));
}

TEST(ColorRequests, PresentAPickedColourAsAnEdit) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = rgb(r: 1,\n  g: 2, b: 3)\n");
  Json params = params_of(client, "a.scene");
  params["color"] = color(1, 0, 0);
  params["range"] = client.result(kColors, params).at(0).at("range");
  const Json found = client.result(kPresentations, params);
  EXPECT_EQ(found.at(0),
            Json({{"label", "rgb(r: 255,   g: 0, b: 0)"},
                  {"textEdit",
                   {{"range", params["range"]}, {"newText", "rgb(r: 255,\n  g: 0, b: 0)"}}}}));
  EXPECT_EQ(found.at(1).at("label"), "red");
}

TEST(ColorRequests, OfAChangedTextHaveNoPresentation) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1\n");
  Json params = params_of(client, "a.scene");
  params["color"] = color(1, 0, 0);
  params["range"] = range_in_line(1, 8, 20);
  EXPECT_EQ(client.result(kPresentations, params), Json::array());
}

TEST(ColorRequests, WorkInConfigs) {
  TestClient client;
  client.open("c.json", "{\n\"background\": [255, 0, 0]\n}");
  Json params = params_of(client, "c.json");
  EXPECT_EQ(client.result(kColors, params),
            Json::array({{{"range", range_in_line(1, 14, 25)}, {"color", color(1, 0, 0)}}}));
  params["range"] = range_in_line(1, 14, 25);
  params["color"] = color(0, 1, 0);
  EXPECT_EQ(client.result(kPresentations, params).at(0).at("label"), "[0, 255, 0]");
}

TEST(ColorRequests, OfALongLineTakeOnePass) {
  std::string text = "{\"spheres\": [";
  for (int i = 0; i < 20'000; ++i) text += "{\"material\": {\"color\": [1, 2, 3]}}, ";
  TestClient client;
  client.open("c.json", text);
  EXPECT_EQ(client.result(kColors, params_of(client, "c.json")).size(), 20'000u);
}

}  // namespace
}  // namespace sdlc::test
