#include <string>

#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

Json document(const TestClient& client, const std::string& name) {
  return {{"textDocument", {{"uri", client.uri(name)}}},
          {"options", {{"tabSize", 8}, {"insertSpaces", false}}}};
}

TEST(FormatRequests, FormatATextWithoutRegardToTabs) {
  TestClient client;
  client.open("a.scene", "scene 1\r\nlet  s=\"\U0001F600\"  // x\r\nsphere {\r\nradius:1}\r\n");
  const Json edits = client.result("textDocument/formatting", document(client, "a.scene"));
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"), edits),
            "scene 1\r\nlet s = \"\U0001F600\"  // x\r\nsphere {\r\n  radius: 1\r\n}\r\n");
  client.change("a.scene", "scene 1\nlet s = 1\n");
  EXPECT_EQ(client.result("textDocument/formatting", document(client, "a.scene")), Json::array());
}

TEST(FormatRequests, FormatTheLinesOfARange) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet  a=1\nlet  b=2\nlet  c=3\n");
  Json params = document(client, "a.scene");
  params["range"] = {{"start", {{"line", 2}, {"character", 3}}},
                     {"end", {{"line", 3}, {"character", 0}}}};
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"),
                                    client.result("textDocument/rangeFormatting", params)),
            "scene 1\nlet  a=1\nlet b = 2\nlet  c=3\n");
}

TEST(FormatRequests, FormatWhatWasTyped) {
  TestClient client;
  const Json caret = client.open_marked("a.scene", "scene 1\nlet  a=1\nsphere {radius:1}|\n");
  Json params = document(client, "a.scene");
  params["position"] = caret;
  params["ch"] = "}";
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"),
                                    client.result("textDocument/onTypeFormatting", params)),
            "scene 1\nlet  a=1\nsphere { radius: 1 }\n");
}

TEST(FormatRequests, SayWhyATextIsNotFormatted) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet  a=\n");
  const Answer refused = client.ask("textDocument/formatting", document(client, "a.scene"));
  EXPECT_EQ(refused.error.at("code"), -32803);
  EXPECT_NE(refused.error.at("message").get<std::string>().find("`a.scene` was not formatted"),
            std::string::npos);
  Json params = document(client, "a.scene");
  params["position"] = {{"line", 2}, {"character", 0}};
  params["ch"] = "\n";
  EXPECT_EQ(client.result("textDocument/onTypeFormatting", params), Json::array());
  client.open("old.json", "{}");
  EXPECT_TRUE(client.ask("textDocument/formatting", document(client, "old.json")).result.is_null());
  EXPECT_FALSE(
      client.ask("textDocument/formatting", document(client, "none.scene")).error.is_null());
}

}  // namespace
}  // namespace sdlc::test
