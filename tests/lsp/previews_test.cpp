#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

/// A program that answers like `sdlc serve --editor`: it says a URL, then the place in `click`, and
/// writes its arguments and its input to `log`.
std::string page_program(const TemporaryFolder& folder, const std::string& click) {
  const std::string path = (folder / "sdlc").string();
  write_text(path, fmt::format("#!/bin/sh\n"
                               "echo \"$*\" >{0}\n"
                               "echo '{{\"type\": \"url\", \"url\": \"http://127.0.0.1:1/x/\"}}'\n"
                               "echo nothing\n"
                               "echo '{1}'\n"
                               "exec cat >>{0}\n",
                               (folder / "log").string(), click));
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

Answer preview(TestClient& client, const Json& argument) {
  return client.ask("workspace/executeCommand",
                    {{"command", "sdlc.preview"}, {"arguments", Json::array({argument})}});
}

void wait_for_log(const TemporaryFolder& folder, const std::string& part) {
  while (content_of(folder / "log").find(part) == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST(PreviewCommand, TellsThePageTheTextsAndTheCursorOfTheEditor) {
  const TemporaryFolder folder;
  TestClient client(Json::object(), {{"threads", 2}},
                    {.limits = {}, .program = page_program(folder, "")});
  client.open("part.scene", "scene 1\nlet a = 1\n");
  client.open("a.scene", "scene 1\ncamera {}\n");
  const Json answer = preview(client, {{"uri", client.uri("a.scene")}}).result;
  EXPECT_EQ(answer.at("url"), "http://127.0.0.1:1/x/");
  EXPECT_EQ(answer.at("scene"), client.uri("a.scene"));
  EXPECT_EQ(preview(client, {{"uri", client.uri("a.scene")}}).result, answer) << "there is one";
  wait_for_log(folder, fmt::format("serve {} --editor --threads=2\n", client.path("a.scene")));
  wait_for_log(folder, R"("text":"scene 1\ncamera {}\n")");
  wait_for_log(folder, R"("text":"scene 1\nlet a = 1\n")");
  client.change("a.scene", "scene 1\n// é\n");
  wait_for_log(folder, R"("text":"scene 1\n// é\n")");
  client.notify("sdlc/cursor", client.at("a.scene", {{"line", 1}, {"character", 3}}));
  wait_for_log(folder, fmt::format(R"({{"column":4,"line":2,"path":"{}","type":"cursor"}})",
                                   client.path("a.scene")));
  client.close("part.scene");
  wait_for_log(folder, fmt::format(R"({{"path":"{}","text":null,"type":"text"}})",
                                   client.path("part.scene")));
}

TEST(PreviewCommand, ShowsThePlaceOfAClick) {
  const TemporaryFolder folder, scenes;
  const std::string path = (scenes / "a.scene").string();
  write_text(path, "scene 1\nsphere {}\n");
  TestClient client(
      {{"window", {{"showDocument", {{"support", true}}}}}}, Json::object(),
      {.limits = {},
       .program = page_program(
           folder,
           fmt::format(R"({{"type": "open", "path": "{}", "line": 2, "column": 3}})", path))});
  client.open("a.scene", "scene 1\n");
  EXPECT_EQ(preview(client, {{"uri", client.uri("a.scene")}, {"external", true}}).error, nullptr);
  Json shown = client.wait_for_notification("window/showDocument");
  if (shown.contains("external")) {
    EXPECT_EQ(shown.at("uri"), "http://127.0.0.1:1/x/");
    shown = client.wait_for_notification("window/showDocument");
  }
  EXPECT_EQ(shown.at("uri"), "file://" + path);
  EXPECT_EQ(shown.at("selection").at("start"), Json({{"line", 1}, {"character", 2}}));
}

TEST(PreviewCommand, StartsAnotherPageAfterTheEndOfOne) {
  std::signal(SIGPIPE, SIG_IGN);  // as in the program
  const TemporaryFolder folder;
  TestClient client(Json::object(), Json::object(),
                    {.limits = {}, .program = page_program(folder, "")});
  client.open("a.scene", "scene 1\ncamera {}\n");
  const Json answer = preview(client, {{"uri", client.uri("a.scene")}}).result;
  const Json end{{"command", "sdlc.endPreview"},
                 {"arguments", Json::array({{{"uri", answer.at("scene")}}})}};
  client.change("a.scene", "scene 1\n// one\n");
  wait_for_log(folder, "// one");
  EXPECT_EQ(client.ask("workspace/executeCommand", end).error, nullptr);
  client.change("a.scene", "scene 1\n// two\n");
  EXPECT_EQ(preview(client, {{"uri", client.uri("a.scene")}}).result, answer);
  wait_for_log(folder, "// two");
  EXPECT_EQ(content_of(folder / "log").find("// one"), std::string::npos) << "of the new one";
}

TEST(PreviewCommand, SaysIfThereIsNoPage) {
  std::signal(SIGPIPE, SIG_IGN);  // as in the program
  const TemporaryFolder folder;
  for (const char* script :
       {"#!/bin/sh\nexit 1\n", "#!/bin/sh\necho '{\"type\": 3}'\n", "no program"}) {
    const std::string path = (folder / "sdlc").string();
    write_text(path, script);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    TestClient client(Json::object(), Json::object(), {.limits = {}, .program = path});
    client.open("a.scene", "scene 1\n");
    EXPECT_NE(preview(client, {{"uri", client.uri("a.scene")}})
                  .error.at("message")
                  .get<std::string>()
                  .find("does not start"),
              std::string::npos);
    client.notify("sdlc/cursor", client.at("a.scene", {{"line", 0}, {"character", 0}}));
  }
}

}  // namespace
}  // namespace sdlc::test
