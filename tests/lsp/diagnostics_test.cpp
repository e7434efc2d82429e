#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

bool is_empty(const Json& diagnostics) { return diagnostics.empty(); }
bool is_any(const Json& diagnostics) { return !diagnostics.empty(); }
bool is_without_errors(const Json& diagnostics) {
  return std::ranges::all_of(diagnostics,
                             [](const Json& found) { return found.at("severity") != 1; });
}

TEST(Diagnostics, FollowTheText) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = b\nsphere { center: (0, 0, 0), radius: a }\n");
  const Json found = client.diagnostics("a.scene", is_any);
  EXPECT_EQ(found[0].at("code"), "E101");
  EXPECT_EQ(found[0].at("range").at("start"), Json({{"line", 1}, {"character", 8}}));
  client.change("a.scene", "scene 1\nlet a = 1\nsphere { center: (0, 0, 0), radius: a }\n");
  client.diagnostics("a.scene", is_without_errors);
}

TEST(Diagnostics, OfAnImportedFileAppearThere) {
  TestClient client;
  client.write("lib.scene", "scene 1\nlet unit = wrong\n");
  client.open(
      "a.scene",
      "scene 1\nimport \"lib.scene\" as lib\nsphere { center: (0, 0, 0), radius: lib.unit }\n");
  EXPECT_EQ(client.diagnostics("lib.scene", is_any)[0].at("code"), "E101");
  // The unsaved text wins over the file.
  client.open("lib.scene", "scene 1\nlet unit = 1\n");
  client.diagnostics("lib.scene", is_empty);
  client.close("lib.scene");
  client.diagnostics("lib.scene", is_any);
}

TEST(Diagnostics, AreSentAgainToAnEditorThatOpensTheFileAgain) {
  const std::string text = "scene 1\nlet a = wrong\n";
  TestClient client;
  client.open("a.scene", text);
  client.diagnostics("a.scene", is_any);
  for (int i = 0; i < 10; ++i) {
    client.drop_messages();
    client.close("a.scene");
    client.open("a.scene", text);
    client.wait_for_message([](const Json& message) {
      return message.at("method") == "textDocument/publishDiagnostics" &&
             is_any(message.at("params").at("diagnostics"));
    });
  }
}

class LinkedFile : public testing::Test {
 protected:
  LinkedFile() {
    client_.write("real.scene", kWrong);
    std::filesystem::create_symlink(client_.path("real.scene"), client_.path("link.scene"));
  }

  static constexpr const char* kWrong = "scene 1\nlet a = wrong\n";
  TestClient client_;
};

TEST_F(LinkedFile, HasItsDiagnosticsUnderTheNameThatIsOpen) {
  client_.open("main.scene", "scene 1\nimport \"real.scene\" as real\n");
  client_.diagnostics("real.scene", is_any);
  client_.open("link.scene", kWrong);
  client_.diagnostics("link.scene", is_any);
  client_.diagnostics("real.scene", is_empty);
  client_.close("link.scene");
  client_.diagnostics("link.scene", is_empty);
  client_.diagnostics("real.scene", is_any);
}

TEST_F(LinkedFile, KeepsItsTextUntilAllItsNamesAreClosed) {
  client_.open("link.scene", "scene 1\nlet b = 1\n");
  client_.open("real.scene", "scene 1\nlet b = 1\n");
  client_.close("link.scene");
  client_.diagnostics("real.scene", is_without_errors);
  const Json symbols = client_.result("textDocument/documentSymbol",
                                      {{"textDocument", {{"uri", client_.uri("real.scene")}}}});
  EXPECT_EQ(symbols.at(0).at("name"), "b");
}

TEST(Diagnostics, CountUtf16UnitsUnlessTheClientOffersUtf8) {
  const std::string text = "scene 1\nlet a = \"𝄞é\" + b\nsphere { center: (0, 0, 0), radius: 1 }\n";
  TestClient client;
  client.open("a.scene", text);
  EXPECT_EQ(client.diagnostics("a.scene", is_any)[0].at("range").at("start").at("character"), 16);
  TestClient other(Json{{"general", {{"positionEncodings", {"utf-8", "utf-16"}}}}});
  other.open("a.scene", text);
  EXPECT_EQ(other.diagnostics("a.scene", is_any)[0].at("range").at("start").at("character"), 19);
}

TEST(Diagnostics, FollowTheSettingsOfTheFolder) {
  const std::string text =
      "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
      "sphere { center: (0, 0, 0), radius: 0, material: diffuse(color: tan) }\n";
  TestClient client;
  client.write(".sdlc.toml", "[lint]\nignore = ['W402']\n");
  client.open("a.scene", text);
  EXPECT_THAT(client.codes("a.scene"), testing::Not(testing::Contains("W402")));
  client.write(".sdlc.toml", "[lint]\n");
  client.notify("workspace/didChangeWatchedFiles",
                {{"changes", Json::array({{{"uri", client.uri(".sdlc.toml")}, {"type", 2}}})}});
  EXPECT_THAT(client.codes("a.scene"), testing::Contains("W402"));
  client.write(".sdlc.toml", "[lint]\nignored = []\n");
  client.notify("workspace/didChangeWatchedFiles",
                {{"changes", Json::array({{{"uri", client.uri(".sdlc.toml")}, {"type", 2}}})}});
  EXPECT_THAT(client.wait_for_notification("window/showMessage").at("message").get<std::string>(),
              testing::HasSubstr("did you mean `ignore`?"));
}

const Json kVersionSupport{{"textDocument", {{"publishDiagnostics", {{"versionSupport", true}}}}}};

TEST(Diagnostics, SayWhichVersionWasChecked) {
  TestClient client(kVersionSupport);
  // A client that drops findings of an older version needs those of each version, also the same.
  const auto expect = [&](int version, std::size_t count) {
    Json params;
    do {  // a check between `close` and `open` cannot read the file, and has no version
      params = client.wait_for_notification("textDocument/publishDiagnostics");
    } while (!params.contains("version"));
    EXPECT_EQ(params.at("version"), version);
    EXPECT_EQ(params.at("diagnostics").size(), count);
  };
  client.open("a.scene", "scene 1\nlet a = b\n");
  expect(1, 1);
  client.change("a.scene", "scene 1\nlet a = b\n// text\n");
  expect(2, 1);
  client.change("a.scene", "scene 1\n");
  expect(3, 0);
  client.change("a.scene", "scene 1\n// text\n");
  expect(4, 0);
  for (int i = 0; i < 10; ++i) {
    client.close("a.scene");
    client.open("a.scene", "scene 1\n");
    expect(1, 0);
  }
}

TEST(Diagnostics, HaveNoVersionWhileAFileIsOpenUnderTwoNames) {
  TestClient client(kVersionSupport);
  client.write("real.scene", "");
  std::filesystem::create_symlink(client.path("real.scene"), client.path("link.scene"));
  client.open("link.scene", "scene 1\nlet a = wrong\n");
  client.open("real.scene", "scene 1\nlet a = wrong\n");
  const auto findings_of_real = [&](std::size_t count) {
    while (true) {
      const Json params = client.wait_for_notification("textDocument/publishDiagnostics");
      const bool is_of_real = params.at("uri") == client.uri("real.scene");
      if (is_of_real && params.at("diagnostics").size() == count) return params;
    }
  };
  EXPECT_EQ(findings_of_real(1).count("version"), 0);
  client.change("link.scene", "scene 1\n");
  EXPECT_EQ(findings_of_real(0).count("version"), 0);
}

TEST(Diagnostics, HaveNoVersionForClientsThatDoNotKnowIt) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = b\n");
  EXPECT_EQ(client.wait_for_notification("textDocument/publishDiagnostics").count("version"), 0);
}

TEST(Server, WritesBothDirectionsToItsLog) {
  const TemporaryFolder folder;
  {
    lsp::Log log(folder / "log");
    log.set_trace(lsp::Trace::Verbose);
    std::stringstream in, out;
    in << lsp::with_header(R"({"jsonrpc":"2.0","id":1,"method":"nothing"})");
    lsp::Server(in, out, log, {}).run();
  }
  const std::string text = content_of(folder / "log");
  EXPECT_THAT(text, testing::HasSubstr(R"(received {"jsonrpc":"2.0","id":1,"method":"nothing"})"));
  EXPECT_THAT(text, testing::HasSubstr("sent {"));
}

TEST(Server, EndsWellOnlyAfterShutdown) {
  TestClient client;
  EXPECT_TRUE(client.exit());
  TestClient other;
  other.notify("exit", nullptr);
  EXPECT_FALSE(other.wait_for_end());
  TestClient third;
  third.end_input();
  EXPECT_FALSE(third.wait_for_end());
}

}  // namespace
}  // namespace sdlc::test
