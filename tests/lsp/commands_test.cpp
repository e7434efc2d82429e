#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

Answer run(TestClient& client, const std::string& command, const Json& argument) {
  return client.ask("workspace/executeCommand",
                    {{"command", command}, {"arguments", Json::array({argument})}});
}

/// A program that reports its arguments and its input as an error.
std::string echo_program(const TemporaryFolder& folder) {
  const std::string path = (folder / "sdlc").string();
  std::ofstream(path) << "#!/bin/sh\necho \"error: $* $(cat)\" >&2\nexit 1\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

class RenderCommand : public testing::Test {
 protected:
  /// What the program was started with.
  std::string render(const Json& more = Json::object()) {
    Json argument{{"uri", client_.uri("a.scene")}};
    argument.update(more);
    EXPECT_TRUE(run(client_, "sdlc.render", argument).error.is_null());
    return client_.wait_for_notification("window/showMessage").at("message");
  }

  const TemporaryFolder folder_;
  TestClient client_{
      Json::object(), {{"threads", 2}}, {.limits = {}, .program = echo_program(folder_)}};
};

TEST_F(RenderCommand, RendersTheTextOfTheEditor) {
  client_.open("a.scene", "scene 1 camera main {}");
  const std::string message = render({{"camera", "main"}});
  for (const char* part :
       {"Rendering a.scene, camera main failed: error: render - ", "/a.scene --output=/",
        "--camera=main", "--threads=2", "scene 1 camera main {}"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(RenderCommand, RendersAFileThatIsNotOpen) {
  client_.write("a.scene", "scene 1\ncamera main {}\n");
  EXPECT_NE(render().find("error: render /"), std::string::npos);
}

TEST_F(RenderCommand, RendersTheFirstFrameOfAnAnimation) {
  client_.open("a.scene", "scene 1\nanimation { frames: 5 .. 9 }\n");
  EXPECT_NE(render().find("--frames=5"), std::string::npos);
  EXPECT_NE(render({{"frame", 7}}).find("--frames=7"), std::string::npos);
}

TEST_F(RenderCommand, NamesTheFilesThatItReadsAsSaved) {
  client_.write("saved.scene", "scene 1\nlet a = 1\n");
  client_.write("changed.scene", "scene 1\nlet b = 1\n");
  client_.open("saved.scene", "scene 1\nlet a = 1\n");
  client_.open("changed.scene", "scene 1\nlet b = 2\n");
  client_.open("other.scene", "scene 1\nlet c = 2\n");
  client_.open("a.scene",
               "scene 1\nimport \"saved.scene\" as s\nimport \"changed.scene\" as c\n"
               "camera main {}\n");
  EXPECT_EQ(render(),
            "The render reads `changed.scene` as saved, without the changes in the editor.");
}

TEST(Commands, ShowThePageOfACode) {
  const Json argument{{"code", "W402"}, {"show", true}};
  TestClient with_documents(Json{{"window", {{"showDocument", {{"support", true}}}}}});
  run(with_documents, "sdlc.explain", argument);
  const Json shown = with_documents.wait_for_message(
      [](const Json& message) { return message.value("method", "") == "window/showDocument"; });
  const std::string uri = shown.at("params").at("uri");
  ASSERT_TRUE(uri.starts_with("file:///") && uri.ends_with("/W402.md")) << uri;
  std::ifstream page(uri.substr(7));
  EXPECT_NE(std::string(std::istreambuf_iterator<char>(page), {}).find("W402"), std::string::npos);

  TestClient without_documents;
  run(without_documents, "sdlc.explain", argument);
  EXPECT_NE(without_documents.wait_for_notification("window/showMessage")
                .at("message")
                .get<std::string>()
                .find("W402"),
            std::string::npos);
}

TEST(Commands, TakeAUriAsTheirArgument) {
  TestClient client;
  client.open("a.scene", "scene 1\n");
  for (const char* name : {"sdlc.render", "sdlc.fixAll", "sdlc.chooseScene"}) {
    EXPECT_TRUE(run(client, name, client.uri("a.scene")).error.is_null()) << name;
  }
}

TEST(Commands, ExplainACode) {
  TestClient client;
  const Json page = run(client, "sdlc.explain", {{"code", "w402"}}).result;
  EXPECT_EQ(page.at("code"), "W402");
  EXPECT_NE(page.at("markdown").get<std::string>().find("W402"), std::string::npos);
  EXPECT_EQ(run(client, "sdlc.explain", "W402").result, page);
  EXPECT_EQ(run(client, "sdlc.explain", "W999").error.at("message"),
            "no diagnostic has the code `W999`");
}

TEST(Commands, SayThatThereIsNothingToFix) {
  TestClient client;
  client.open("a.scene", "scene 1\n");
  EXPECT_TRUE(run(client, "sdlc.fixAll", {{"uri", client.uri("a.scene")}}).error.is_null());
  client.wait_for_notification("window/showMessage");
}

TEST(Commands, ChooseTheSceneOfAFile) {
  TestClient client;
  client.write("main.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.none\n");
  client.open("lib.scene", "scene 1\nlet unit = 1\n");
  run(client, "sdlc.chooseScene",
      {{"uri", client.uri("lib.scene")}, {"scene", client.uri("main.scene")}});
  client.diagnostics("main.scene", [](const Json& found) { return !found.empty(); });
  run(client, "sdlc.chooseScene", {{"uri", client.uri("lib.scene")}, {"scene", nullptr}});
}

constexpr const char* kUsesPart = "scene 1\nimport \"part.scene\" as p\nlet a = p.none\n";
constexpr const char* kUsesNothing = "scene 1\nlet a = 1\n";
constexpr const char* kWrongPart = "scene 1\nlet unit = none\n";

bool has_one(const Json& found) { return found.size() == 1; }

TEST(Commands, ChooseNoSceneThatDoesNotReadTheFile) {
  TestClient client;
  client.write("other.scene", kUsesNothing);
  client.open("part.scene", kWrongPart);
  client.diagnostics("part.scene", has_one);
  run(client, "sdlc.chooseScene",
      {{"uri", client.uri("part.scene")}, {"scene", client.uri("other.scene")}});
  const std::string told = client.wait_for_notification("window/showMessage").at("message");
  EXPECT_TRUE(told.starts_with("`other.scene` does not read `part.scene`")) << told;
  client.change("part.scene", "scene 1\nlet unit = none + nothing\n");
  client.diagnostics("part.scene", [](const Json& found) { return found.size() == 2; });
}

TEST(Commands, ChooseNoSceneThatCannotBeRead) {
  TestClient client;
  client.open("part.scene", kWrongPart);
  run(client, "sdlc.chooseScene",
      {{"uri", client.uri("part.scene")}, {"scene", client.uri("none.scene")}});
  client.wait_for_notification("window/showMessage");
  client.diagnostics("part.scene", has_one);
}

TEST(Commands, ChooseASceneAsLongAsItReadsTheFile) {
  TestClient client;
  client.open("part.scene", kWrongPart);
  client.open("main.scene", kUsesPart);
  run(client, "sdlc.chooseScene",
      {{"uri", client.uri("part.scene")}, {"scene", client.uri("main.scene")}});
  client.diagnostics("part.scene", has_one);
  client.diagnostics("main.scene", has_one);
  client.change("main.scene", kUsesNothing);
  const std::string told = client.wait_for_notification("window/showMessage").at("message");
  EXPECT_TRUE(told.starts_with("`main.scene` does not read `part.scene`")) << told;
  client.change("part.scene", "scene 1\nlet unit = none + nothing\n");
  client.diagnostics("part.scene", [](const Json& found) { return found.size() == 2; });
  // The choice counts again.
  client.change("main.scene", kUsesPart);
  client.diagnostics("main.scene", has_one);
  client.change("part.scene", kWrongPart);
  client.diagnostics("part.scene", has_one);
}

TEST(Commands, AreRefusedIfTheyAreUnknownOrWrong) {
  TestClient client;
  EXPECT_EQ(run(client, "sdlc.nothing", Json::object()).error.at("message"),
            "unknown command `sdlc.nothing`");
  for (const char* name : {"sdlc.render", "sdlc.fixAll", "sdlc.explain", "sdlc.chooseScene"}) {
    EXPECT_FALSE(run(client, name, Json::object()).error.is_null()) << name;
    EXPECT_FALSE(run(client, name, nullptr).error.is_null()) << name;
    EXPECT_FALSE(client.ask("workspace/executeCommand", {{"command", name}}).error.is_null());
    EXPECT_FALSE(run(client, name, {{"uri", "untitled:x"}, {"code", 3}}).error.is_null()) << name;
  }
  client.notify("window/workDoneProgress/cancel", {{"token", 7}});
  client.notify("window/workDoneProgress/cancel", nullptr);
  EXPECT_TRUE(run(client, "sdlc.explain", "E104").error.is_null());
}

}  // namespace
}  // namespace sdlc::test
