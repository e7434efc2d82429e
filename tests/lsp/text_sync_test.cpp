#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lsp/open_files.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

Json position(unsigned line, unsigned character) {
  return {{"line", line}, {"character", character}};
}

Json edit(const Json& start, const Json& end, const std::string& text) {
  return {{"range", {{"start", start}, {"end", end}}}, {"text", text}};
}

std::string changed(const std::string& text, const Json& changes) {
  return lsp::changed_text(text, changes, lang::PositionEncoding::Utf16);
}

TEST(TextChanges, AreAppliedOneAfterTheOther) {
  const std::string text = "a\nb\nc\nd\n";
  EXPECT_EQ(changed(text, {edit(position(3, 0), position(3, 1), "D"),
                           edit(position(1, 1), position(2, 0), ""),
                           edit(position(0, 0), position(0, 0), "x\ny\n"),
                           edit(position(4, 0), position(4, 1), "Z")}),
            "x\ny\na\nbc\nZ\n");
}

TEST(TextChanges, GoBackAndForthBetweenLines) {
  std::string expected, text;
  Json changes = Json::array();
  for (int i = 0; i < 100; ++i) text += "line\n", expected += "LINE\n";
  for (unsigned i = 0; i < 100; ++i) {
    const unsigned line = i * 37 % 100;  // each once
    changes.push_back(edit(position(line, 0), position(line, 4), "LINE"));
  }
  EXPECT_EQ(changed(text, changes), expected);
}

TEST(TextChanges, BeyondTheTextAreAtItsEnd) {
  EXPECT_EQ(changed("a\nb", Json::array({edit(position(7, 0), position(9, 3), "!")})), "a\nb!");
  EXPECT_EQ(changed("a\nb", {edit(position(7, 0), position(9, 3), "!"),
                             edit(position(0, 0), position(0, 1), "A")}),
            "A\nb!");
}

class WrongChange : public testing::Test {
 protected:
  WrongChange() {
    client_.open("a.scene", "scene 1\nlet a = none\n");
    client_.diagnostics("a.scene", [](const Json& found) { return found.size() == 1; });
    send(Json::array({edit(position(1, 2), position(0, 1), "x")}));
  }

  void send(const Json& changes) {
    client_.notify("textDocument/didChange",
                   {{"textDocument", {{"uri", client_.uri("a.scene")}, {"version", ++version_}}},
                    {"contentChanges", changes}});
  }
  Answer symbols() {
    return client_.ask("textDocument/documentSymbol",
                       {{"textDocument", {{"uri", client_.uri("a.scene")}}}});
  }

  TestClient client_;
  int version_ = 10;
};

TEST_F(WrongChange, IsToldToTheUser) {
  const std::string told = client_.wait_for_notification("window/showMessage").at("message");
  EXPECT_TRUE(told.starts_with("sdlc no longer knows the text of `a.scene`")) << told;
}

TEST_F(WrongChange, IsFollowedByNoAnswerAboutAnotherText) {
  EXPECT_FALSE(symbols().error.is_null());
  EXPECT_FALSE(
      client_.ask("textDocument/formatting", {{"textDocument", {{"uri", client_.uri("a.scene")}}}})
          .error.is_null());
  send(Json::array({edit(position(0, 0), position(0, 0), " ")}));
  EXPECT_FALSE(symbols().error.is_null());
}

TEST_F(WrongChange, IsForgottenWithTheNextWholeText) {
  send(Json::array({{{"text", "scene 1\nlet b = 1\n"}}}));
  EXPECT_EQ(symbols().result.at(0).at("name"), "b");
}

TEST(JsonFiles, ThatAreNoConfigsAreNotChecked) {
  TestClient client;
  client.open("package.json", R"({"name": "x", "version": "1.0.0", "camera": 1})");
  client.open("config.json", R"({"camera": {}, "spheres": []})");
  client.diagnostics("config.json", [](const Json& found) { return !found.empty(); });
  EXPECT_TRUE(client.codes("package.json").empty());
  client.change("package.json", R"({"camera": {}, "saving": {}})");
  client.diagnostics("package.json", [](const Json& found) { return !found.empty(); });
  client.change("package.json", R"({"camera": {}})");
  client.diagnostics("package.json", [](const Json& found) { return found.empty(); });
}

TEST(WrongParameters, AreAnsweredInOurWords) {
  TestClient client;
  client.open("a.scene", "scene 1\n");
  const Answer answer =
      client.ask("textDocument/hover", {{"textDocument", {{"uri", client.uri("a.scene")}}}});
  EXPECT_EQ(answer.error.at("message"),
            "a parameter of `textDocument/hover` is missing or has the wrong type");
}

}  // namespace
}  // namespace sdlc::test
