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
