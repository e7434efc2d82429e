#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/ranges.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

constexpr auto kHover = "textDocument/hover";

const Json kMarkdown{
    {"textDocument", {{"hover", {{"contentFormat", Json::array({"markdown", "plaintext"})}}}}}};

TEST(HoverRequest, AnswersInTheFormatOfTheClient) {
  const std::string text = "scene 1\nlet a = 2 * pi\nlet b = \"😀\" + str(|a)\n";
  TestClient markdown(kMarkdown);
  const Json at = markdown.open_marked("a.scene", text);
  EXPECT_EQ(markdown.result_at(kHover, "a.scene", at),
            Json({{"contents",
                   {{"kind", "markdown"},
                    {"value",
                     "```scene\nlet a = 2 * pi\n```\n\nValue: `6.283185307179586`\n\n"
                     "Type: `number`"}}},
                  {"range", range_in_line(2, 19, 20)}}));
  TestClient plain;
  plain.open_marked("a.scene", text);
  EXPECT_EQ(plain.result_at(kHover, "a.scene", at).at("contents"),
            Json({{"kind", "plaintext"},
                  {"value", "let a = 2 * pi\n\nValue: 6.283185307179586\n\nType: number"}}));
}

TEST(HoverRequest, SeesImportedTextsThatAreOpen) {
  TestClient client;
  client.open("l.scene", "scene 1\nlet a = 1 + 1\n");
  const Json at = client.open_marked("a.scene", "scene 1\nimport \"l.scene\" as l\nlet b = l.|a\n");
  EXPECT_THAT(client.result_at(kHover, "a.scene", at).dump(), testing::HasSubstr("Value: 2"));
  client.change("l.scene", "scene 1\nlet a = 1 + 2\n");
  EXPECT_THAT(client.result_at(kHover, "a.scene", at).dump(), testing::HasSubstr("Value: 3"));
}

TEST(HoverRequest, DescribesTheKeysOfConfigs) {
  TestClient client;
  const Json at = client.open_marked("c.json", "{\n\"camera\": {\"vf|ov\": 40}}");
  EXPECT_THAT(client.result_at(kHover, "c.json", at).dump(),
              testing::HasSubstr("The vertical angle of view"));
}

TEST(HoverRequest, IsNullWhereThereIsNothingToSay) {
  TestClient client;
  const Json at = client.open_marked("a.scene", "scene 1\n|\n");
  EXPECT_EQ(client.result_at(kHover, "a.scene", at), nullptr);
}

TEST(HoverRequest, DescribesTheKeysOfAConfig) {
  TestClient client;
  const Json at = client.open_marked("a.json", R"({"rendering": {"wi|dth": 1}})");
  const Json hover = client.result_at(kHover, "a.json", at);
  EXPECT_THAT(hover.at("contents").dump(), testing::HasSubstr("Width of the picture"));
  EXPECT_EQ(hover.at("range").at("start").at("character"), 15);
}

TEST(HoverRequest, RefusesWrongParameters) {
  TestClient client;
  client.open("a.scene", "scene 1\n");
  EXPECT_EQ(client.ask(kHover, client.at("a.scene", "here")).error.at("code"), -32602);
  EXPECT_EQ(client.ask(kHover, client.at("b.scene", {})).error.at("code"), -32602);
}

}  // namespace
}  // namespace sdlc::test
