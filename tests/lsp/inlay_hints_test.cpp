#include <gtest/gtest.h>

#include "tests/lsp/ranges.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

Json hints_of(TestClient& client) {
  return client.result("textDocument/inlayHint",
                       {{"textDocument", {{"uri", client.uri("a.scene")}}},
                        {"range", {{"start", position_at(0, 0)}, {"end", position_at(9, 0)}}}});
}

constexpr auto kText = "scene 1\nlet a = 1 + 1\nlet b = rgb(1, g: 2, b: 3)\n";

TEST(InlayHintRequest, HasNothingByDefault) {
  TestClient client;
  client.open("a.scene", kText);
  EXPECT_EQ(hints_of(client), Json::array());
}

TEST(InlayHintRequest, ShowsValuesAndNamesOfArguments) {
  TestClient client(Json::object(), {{"inlayHints", true}});
  client.open("a.scene", kText);
  EXPECT_EQ(hints_of(client), Json::array({{{"position", position_at(1, 13)},
                                            {"label", "= 2"},
                                            {"kind", 1},
                                            {"paddingLeft", true},
                                            {"paddingRight", false}},
                                           {{"position", position_at(2, 12)},
                                            {"label", "r:"},
                                            {"kind", 2},
                                            {"paddingLeft", false},
                                            {"paddingRight", true}}}));
}

TEST(InlayHintRequest, IsAskedForAgainWhenTheSettingChanges) {
  TestClient client(Json({{"workspace", {{"inlayHint", {{"refreshSupport", true}}}}}}));
  client.notify("workspace/didChangeConfiguration",
                {{"settings", {{"sdlc", {{"inlayHints", true}}}}}});
  const Json request = client.wait_for_message([](const Json& message) {
    return message.value("method", "") == "workspace/inlayHint/refresh";
  });
  EXPECT_FALSE(request.contains("params"));
  client.respond(request.at("id"), nullptr);
}

}  // namespace
}  // namespace sdlc::test
