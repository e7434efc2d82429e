#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

const Json kDocumentChanges{{"workspace", {{"workspaceEdit", {{"documentChanges", true}}}}}};

/// The notification of an editor that watches the folder.
void announce_changed_files(TestClient& client) {
  client.notify("workspace/didChangeWatchedFiles",
                {{"changes", Json::array({{{"uri", client.uri("")}, {"type", 1}}})}});
}

TEST(Rename, EditsAllFilesWithTheVersionsOfOpenTexts) {
  TestClient client(kDocumentChanges);
  client.write("lib.scene", "scene 1\nlet tint = red\n");
  const Json cursor = client.open_marked(
      "a.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = [\"𝄞\", lib.ti|nt]\n");
  const Json prepared = client.result_at("textDocument/prepareRename", "a.scene", cursor);
  EXPECT_EQ(prepared.at("placeholder"), "tint");
  EXPECT_EQ(prepared.at("range").at("start").at("character"), 19);
  const Json edit =
      client.result_at("textDocument/rename", "a.scene", cursor, {{"newName", "shade"}});
  const Json& changes = edit.at("documentChanges");
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].at("textDocument"), (Json{{"uri", client.uri("a.scene")}, {"version", 1}}));
  EXPECT_EQ(changes[1].at("textDocument"),
            (Json{{"uri", client.uri("lib.scene")}, {"version", nullptr}}));
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"), changes[0].at("edits")),
            "scene 1\nimport \"lib.scene\" as lib\nlet a = [\"𝄞\", lib.shade]\n");
  EXPECT_EQ(TestClient::apply_edits("scene 1\nlet tint = red\n", changes[1].at("edits")),
            "scene 1\nlet shade = red\n");
}

TEST(Rename, IsAListByUriForPlainClients) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\nlet |a = 1\nlet b = a\n");
  const Json edit = client.result_at("textDocument/rename", "a.scene", cursor, {{"newName", "c"}});
  EXPECT_EQ(
      TestClient::apply_edits(client.text("a.scene"), edit.at("changes").at(client.uri("a.scene"))),
      "scene 1\nlet c = 1\nlet b = c\n");
}

TEST(Rename, IsRefusedWithTheReason) {
  TestClient client;
  const auto error_of = [&](const std::string& text, const std::string& new_name) {
    Json params = client.at("a.scene", client.open_marked("a.scene", text));
    params["newName"] = new_name;
    const Json error = client.ask("textDocument/rename", params).error;
    EXPECT_EQ(error.at("code"), -32803);
    return error.at("message").get<std::string>();
  };
  EXPECT_EQ(error_of("scene 1\nlet |a = 1\nlet b = a\n", "b"),
            "`b` is already the name of a value at a.scene:3:5.");
  EXPECT_EQ(error_of("scene 1\n|sphere { radius: 1 }\n", "ball"),
            "`sphere` is a name of the language and cannot be renamed.");
  EXPECT_EQ(error_of("scene 1\nlet a =| 1\n", "b"), "There is no name here.");
  const Json params = client.at("a.json", client.open_marked("a.json", "{\"cam|era\": 1}"));
  EXPECT_EQ(client.ask("textDocument/prepareRename", params).error.at("message"),
            "A JSON config has no names that could be changed.");
}

TEST(Rename, OfALibraryChangesAllScenesOfTheFolder) {
  TestClient client;
  for (int i = 0; i < 7; ++i) {
    client.write("part" + std::to_string(i) + "/a.scene",
                 "scene 1\nimport \"../lib.scene\" as lib\nlet a = lib.tint\n");
  }
  client.write("other.scene", "scene 1\nlet tint = blue\n");
  announce_changed_files(client);
  // What has just been typed counts, too.
  client.open("typed.scene", "scene 1\n");
  client.change("typed.scene", "scene 1\nimport \"lib.scene\" as l\nlet a = l.tint\n");
  const Json cursor = client.open_marked("lib.scene", "scene 1\nlet |tint = red\n");
  Json edit = client.result_at("textDocument/rename", "lib.scene", cursor, {{"newName", "x"}});
  EXPECT_EQ(edit.at("changes").size(), 9u);
  EXPECT_TRUE(edit.at("changes").contains(client.uri("part6/a.scene")));
  EXPECT_TRUE(edit.at("changes").contains(client.uri("typed.scene")));
  EXPECT_FALSE(edit.at("changes").contains(client.uri("other.scene")));
  EXPECT_EQ(client
                .result_at("textDocument/references", "lib.scene", cursor,
                           {{"context", {{"includeDeclaration", false}}}})
                .size(),
            8u);
}

TEST(Rename, IsRefusedWhereItClashesInAnotherScene) {
  TestClient client;
  client.write("one.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.tint\n");
  client.write("two.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.shade\n");
  announce_changed_files(client);
  const Json cursor = client.open_marked("lib.scene", "scene 1\nlet |tint = red\n");
  Json params = client.at("lib.scene", cursor);
  params["newName"] = "shade";
  EXPECT_EQ(client.ask("textDocument/rename", params).error.at("message"),
            "The unknown name `shade` at two.scene:3:13 would then be this value.");
}

TEST(Rename, LeavesFilesOutsideOfTheFolderAlone) {
  TestClient client;
  TemporaryFolder other;
  const std::string outside = (std::filesystem::canonical(other.path()) / "lib.scene").string();
  std::ofstream(outside) << "scene 1\nlet tint = red\n";
  const Json cursor = client.open_marked(
      "a.scene", "scene 1\nimport \"" + outside + "\" as lib\nlet a = lib.ti|nt\n");
  Json params = client.at("a.scene", cursor);
  params["newName"] = "shade";
  EXPECT_EQ(client.ask("textDocument/rename", params).error.at("message"),
            "The name is used in `" + outside + "`, which is outside the folder.");
}

}  // namespace
}  // namespace sdlc::test
