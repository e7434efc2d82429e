#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const std::string kCamera = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

Json everywhere() {
  return {{"start", {{"line", 0}, {"character", 0}}}, {"end", {{"line", 999}, {"character", 0}}}};
}

Json actions_in(TestClient& client, const std::string& name, const Json& range,
                Json context = Json::object()) {
  if (!context.contains("diagnostics")) context["diagnostics"] = Json::array();
  return client.result("textDocument/codeAction", {{"textDocument", {{"uri", client.uri(name)}}},
                                                   {"range", range},
                                                   {"context", std::move(context)}});
}

std::vector<std::string> titles(const Json& actions) {
  std::vector<std::string> all;
  for (const Json& action : actions) all.push_back(action.at("title"));
  return all;
}

Json empty_range(const Json& position) { return {{"start", position}, {"end", position}}; }

/// The text after an action's edit.
std::string after(const TestClient& client, const std::string& name, const Json& action) {
  return TestClient::apply_edits(client.text(name),
                                 action.at("edit").at("changes").at(client.uri(name)));
}

TEST(CodeActions, FixAndAllowFindings) {
  TestClient client;
  const std::string text =
      "scene 1\n" + kCamera + "sphere { center: (0, 0, 0), radius: |0, material: unlit(red) }\n";
  const Json at = client.open_marked("a.scene", text);
  const Json actions = actions_in(client, "a.scene", empty_range(at));
  ASSERT_THAT(titles(actions), ElementsAre("Allow W402 here", "Explain W402"));
  EXPECT_EQ(actions[0].at("kind"), "quickfix");
  EXPECT_EQ(
      after(client, "a.scene", actions[0]),
      "scene 1\n" + kCamera +
          "// sdlc: allow(W402)\nsphere { center: (0, 0, 0), radius: 0, material: unlit(red) }\n");
}

TEST(CodeActions, BelongToTheDiagnosticsOfTheClient) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet s = \"\U0001F600\" let  a = 1;\n");
  const Json found = client.diagnostics("a.scene", [](const Json& all) { return !all.empty(); });
  const Json actions =
      actions_in(client, "a.scene", everywhere(), {{"diagnostics", found}, {"only", {"quickfix"}}});
  ASSERT_THAT(titles(actions), ElementsAre("Remove `;`"));
  EXPECT_EQ(actions[0].at("diagnostics"), found);
  EXPECT_EQ(actions[0].at("isPreferred"), true);
  EXPECT_EQ(after(client, "a.scene", actions[0]), "scene 1\nlet s = \"\U0001F600\" let  a = 1\n");
}

TEST(CodeActions, FixTheSameMistakeInTheWholeFileOnce) {
  TestClient client;
  client.open("a.scene", "scene 1\nsphere { radus: 1 }\nsphere { radus: 2 }\n");
  const Json actions = actions_in(client, "a.scene", everywhere(), {{"only", {"quickfix"}}});
  const std::string title = "Replace all `radus` with `radius` in this file (2 places)";
  ASSERT_THAT(titles(actions),
              ElementsAre("Replace `radus` with `radius`", title, "Replace `radus` with `radius`"));
  EXPECT_EQ(after(client, "a.scene", actions[1]),
            "scene 1\nsphere { radius: 1 }\nsphere { radius: 2 }\n");
}

TEST(CodeActions, AreThoseOfTheRange) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1;\nlet b = 2 m\n");
  const auto at = [](int line, int character) {
    return empty_range({{"line", line}, {"character", character}});
  };
  const Json only{{"only", {"quickfix"}}};
  EXPECT_EQ(actions_in(client, "a.scene", at(1, 10), only).size(), 1u);
  EXPECT_THAT(titles(actions_in(client, "a.scene", at(1, 4), only)), IsEmpty());
  EXPECT_EQ(actions_in(client, "a.scene", everywhere(), only).size(), 2u);
}

TEST(CodeActions, RespectTheWantedKindsAndTheTrigger) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1;\n");
  const auto with = [&](const Json& context) {
    return titles(actions_in(client, "a.scene", everywhere(), context));
  };
  EXPECT_THAT(with(Json::object()),
              ElementsAre("Remove `;`", "Fix all safe findings", "Explain E012"));
  EXPECT_THAT(with({{"triggerKind", 2}}), ElementsAre("Remove `;`"));
  for (const char* kind : {"source", "source.fixAll", "source.fixAll.sdlc"}) {
    EXPECT_THAT(with({{"only", {kind}}}), ElementsAre("Fix all safe findings"));
    EXPECT_THAT(with({{"only", {kind}}, {"triggerKind", 2}}), ElementsAre("Fix all safe findings"));
  }
  EXPECT_THAT(with({{"only", {"refactor"}}}), IsEmpty());
  EXPECT_THAT(with({{"only", {"source.organizeImports"}}}), IsEmpty());
  EXPECT_THAT(with({{"only", Json::array()}}), IsEmpty());
}

TEST(CodeActions, FixAllWhenTheyAreResolved) {
  const Json resolves{{"resolveSupport", {{"properties", {"edit"}}}}};
  const Json edits{{"workspaceEdit", {{"documentChanges", true}}}};
  TestClient client(Json{{"textDocument", {{"codeAction", resolves}}}, {"workspace", edits}});
  client.open("a.scene", "scene 1\nlet a = 1;\nlet b = 2;\n");
  const Json actions = actions_in(client, "a.scene", everywhere(), {{"only", {"source.fixAll"}}});
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_FALSE(actions[0].contains("edit"));
  const Json edit = client.result("codeAction/resolve", actions[0]).at("edit");
  const Json& change = edit.at("documentChanges").at(0);
  EXPECT_EQ(change.at("textDocument"), Json({{"uri", client.uri("a.scene")}, {"version", 1}}));
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"), change.at("edits")),
            "scene 1\nlet a = 1\nlet b = 2\n");
}

TEST(CodeActions, FixAllByACommandForOtherClients) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1;\n");
  const Json actions = actions_in(client, "a.scene", everywhere(), {{"only", {"source.fixAll"}}});
  ASSERT_EQ(actions.size(), 1u);
  client.result("workspace/executeCommand", actions[0].at("command"));
  const Json request = client.wait_for_notification("workspace/applyEdit");
  EXPECT_EQ(after(client, "a.scene", request), "scene 1\nlet a = 1\n");
}

TEST(CodeActions, FixConfigs) {
  TestClient client;
  client.open("a.json", "{\"rendering\": {\"width\": 10,}, \"saving\": {}}");
  const Json actions = actions_in(client, "a.json", everywhere(), {{"only", {"quickfix"}}});
  ASSERT_FALSE(actions.empty());
  EXPECT_EQ(actions[0].at("kind"), "quickfix");
}

TEST(CodeActions, SurviveStrangeParameters) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1;\n");
  const Json text{{"uri", client.uri("a.scene")}};
  EXPECT_EQ(client.result("codeAction/resolve", {{"title", "x"}}), Json({{"title", "x"}}));
  EXPECT_FALSE(client.ask("textDocument/codeAction", {{"textDocument", text}}).error.is_null());
  EXPECT_FALSE(
      client
          .ask("textDocument/codeAction",
               {{"textDocument", text}, {"range", everywhere()}, {"context", {{"only", {1, 2}}}}})
          .error.is_null());
  EXPECT_FALSE(client.ask("codeAction/resolve", Json::array()).error.is_null());
}

}  // namespace
}  // namespace sdlc::test
