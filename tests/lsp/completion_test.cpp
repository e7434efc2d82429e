#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

constexpr auto kCompletion = "textDocument/completion";

std::vector<std::string> labels(const Json& list) {
  std::vector<std::string> all;
  for (const Json& item : list.at("items")) all.push_back(item.at("label"));
  return all;
}

const Json& item_of(const Json& list, const std::string& label) {
  static const Json kNone;
  for (const Json& item : list.at("items")) {
    if (item.at("label") == label) return item;
  }
  ADD_FAILURE() << "no item " << label;
  return kNone;
}

Json client_with(const Json& item) {
  return {{"textDocument", {{"completion", {{"completionItem", item}}}}}};
}

TEST(CompletionMessages, ReplaceTheWordAtTheCursor) {
  TestClient client;
  const Json cursor =
      client.open_marked("a.scene", "scene 1\nsphere { center: (0, 0, 0), ra|dus }");
  const Json list = client.result_at(kCompletion, "a.scene", cursor);
  ASSERT_EQ(labels(list).front(), "radius");
  const Json& item = list.at("items").front();
  EXPECT_EQ(TestClient::apply_edits(client.text("a.scene"), Json::array({item.at("textEdit")})),
            "scene 1\nsphere { center: (0, 0, 0), radius:  }");
  EXPECT_EQ(item.at("detail"), "a length, at least 0, required");
}

TEST(CompletionMessages, CountUtf16Units) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\n/* 𝄞é */ sphere { ra| }");
  const Json list = client.result_at(kCompletion, "a.scene", cursor);
  const Json& edit = item_of(list, "radius").at("textEdit");
  EXPECT_EQ(edit.at("range").at("start").at("character"), 19);
  EXPECT_EQ(edit.at("range").at("end").at("character"), 21);
}

TEST(CompletionMessages, HaveSnippetsOnlyForClientsThatTakeThem) {
  const std::string text = "scene 1\nsphere { ce| }";
  TestClient plain;
  Json cursor = plain.open_marked("a.scene", text);
  Json list = plain.result_at(kCompletion, "a.scene", cursor);
  EXPECT_EQ(item_of(list, "center").at("textEdit").at("newText"), "center: ");
  EXPECT_FALSE(item_of(list, "center").contains("insertTextFormat"));
  TestClient rich(client_with({{"snippetSupport", true}}));
  cursor = rich.open_marked("a.scene", text);
  list = rich.result_at(kCompletion, "a.scene", cursor);
  EXPECT_EQ(item_of(list, "center").at("textEdit").at("newText"),
            "center: (${1:0}, ${2:0}, ${3:0})");
  EXPECT_EQ(item_of(list, "center").at("insertTextFormat"), 2);
}

TEST(CompletionMessages, LetTheClientInsertOrReplace) {
  TestClient client(client_with({{"insertReplaceSupport", true}}));
  const Json cursor = client.open_marked("a.scene", "scene 1\nsphere { ra|dius }");
  const Json list = client.result_at(kCompletion, "a.scene", cursor);
  const Json& edit = item_of(list, "radius").at("textEdit");
  EXPECT_EQ(edit.at("insert").at("end").at("character"), 11);
  EXPECT_EQ(edit.at("replace").at("end").at("character"), 15);
}

TEST(CompletionMessages, GiveTheRangeOnceToClientsThatTakeItSo) {
  const Json list_support{{"itemDefaults", {"commitCharacters", "editRange"}}};
  Json with_ranges = client_with({{"insertReplaceSupport", true}});
  with_ranges["textDocument"]["completion"]["completionList"] = list_support;
  const Json with_range{{"textDocument", {{"completion", {{"completionList", list_support}}}}}};
  const std::string text = "scene 1\nsphere { ra|dius }";

  TestClient plain(with_range);
  Json cursor = plain.open_marked("a.scene", text);
  Json list = plain.result_at(kCompletion, "a.scene", cursor);
  const Json begin{{"line", 1}, {"character", 9}}, end{{"line", 1}, {"character", 15}};
  EXPECT_EQ(list.at("itemDefaults").at("editRange"), Json({{"start", begin}, {"end", end}}));
  EXPECT_FALSE(item_of(list, "radius").contains("textEdit"));
  EXPECT_EQ(item_of(list, "radius").at("textEditText"), "radius: ");

  TestClient rich(with_ranges);
  cursor = rich.open_marked("a.scene", text);
  list = rich.result_at(kCompletion, "a.scene", cursor);
  EXPECT_EQ(list.at("itemDefaults").at("editRange").at("insert").at("end").at("character"), 11);
  EXPECT_EQ(list.at("itemDefaults").at("editRange").at("replace").at("end"), end);
  cursor = rich.open_marked("b.scene", "scene 1\nlet size = 1\nlet other = si|");
  list = rich.result_at(kCompletion, "b.scene", cursor);
  EXPECT_FALSE(item_of(list, "size").contains("textEditText")) << "the label is the text";
}

TEST(CompletionMessages, HaveMarkdownOnlyForClientsThatShowIt) {
  const std::string text = "scene 1\ncamera main { sh| }";
  TestClient plain;
  Json cursor = plain.open_marked("a.scene", text);
  Json list = plain.result_at(kCompletion, "a.scene", cursor);
  EXPECT_THAT(item_of(list, "shutter").at("documentation").get<std::string>(),
              HasSubstr("the frame's time; none: nothing"));
  TestClient rich(client_with({{"documentationFormat", {"markdown", "plaintext"}}}));
  cursor = rich.open_marked("a.scene", text);
  list = rich.result_at(kCompletion, "a.scene", cursor);
  EXPECT_EQ(item_of(list, "shutter").at("documentation").at("kind"), "markdown");
}

TEST(CompletionMessages, ListFilesOfTheFolder) {
  TestClient client;
  client.write("parts/legs.scene", "scene 1\n");
  client.write("parts/notes.txt", "");
  client.write("parts/top.json", "{}");
  Json cursor = client.open_marked("a.scene", "scene 1\nimport \"parts/|\n");
  EXPECT_THAT(labels(client.result_at(kCompletion, "a.scene", cursor)), ElementsAre("legs.scene"));
  cursor = client.open_marked("b.scene", "scene 1\ninclude \"parts/|\"\n");
  EXPECT_THAT(labels(client.result_at(kCompletion, "b.scene", cursor)),
              ElementsAre("legs.scene", "top.json"));
}

TEST(CompletionMessages, OfferFilesOutsideTheFolderUnlessTheyAreRefused) {
  TestClient client, sandboxed(Json::object(), {{"sandbox", true}});
  for (TestClient* each : {&client, &sandboxed}) {
    each->write("above.scene", "scene 1\n");
    each->write("lib/beside.scene", "scene 1\n");
  }
  const auto offered = [](TestClient& each) {
    const Json cursor = each.open_marked("lib/a.scene", "scene 1\nimport \"../|\"\n");
    return labels(each.result_at(kCompletion, "lib/a.scene", cursor));
  };
  EXPECT_THAT(offered(client), ElementsAre("above.scene", "lib/"));
  EXPECT_THAT(offered(sandboxed), IsEmpty());
  const Json cursor = sandboxed.open_marked("lib/b.scene", "scene 1\nimport \"|\"\n");
  EXPECT_THAT(labels(sandboxed.result_at(kCompletion, "lib/b.scene", cursor)),
              IsSupersetOf({"a.scene", "beside.scene"}));
}

TEST(CompletionMessages, OfTypedCharactersAreNotUnwanted) {
  TestClient client;
  const auto typed = [&](const std::string& text, const std::string& character) {
    const Json cursor = client.open_marked("a.scene", text);
    return client.result_at(kCompletion, "a.scene", cursor,
                            {{"context", {{"triggerKind", 2}, {"triggerCharacter", character}}}});
  };
  EXPECT_TRUE(typed("scene 1\nlet a = 1 |", " ").is_null());
  EXPECT_THAT(labels(typed("scene 1\ncamera main { shutter: |", " ")), Contains("none"));
  EXPECT_THAT(labels(typed("scene 1\nlet a = 1\nlet b = a /|", "/")), IsEmpty());
  EXPECT_THAT(labels(typed("scene 1\nlet a = \"|\"", "\"")), IsEmpty());
}

TEST(CompletionMessages, ExplainCodesWhenTheyAreSelected) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\n// sdlc: allow(W402|\nlet a = 1\n");
  const Json list = client.result_at(kCompletion, "a.scene", cursor);
  const Json& item = item_of(list, "W402");
  EXPECT_FALSE(item.contains("documentation"));
  const Json resolved = client.result("completionItem/resolve", item);
  EXPECT_THAT(resolved.at("documentation").get<std::string>(), HasSubstr("radius 0"));
  EXPECT_EQ(client.result("completionItem/resolve", {{"label", "x"}}), Json({{"label", "x"}}));
}

TEST(CompletionMessages, CompleteConfigs) {
  TestClient client;
  const Json cursor = client.open_marked("a.json", R"({"camera": {"look|": 1}})");
  const Json list = client.result_at(kCompletion, "a.json", cursor);
  EXPECT_THAT(labels(list), ElementsAre("look_from", "look_at"));
  const Json& item = list.at("items").front();
  EXPECT_EQ(item.at("filterText"), "\"look_from\"");
  EXPECT_EQ(TestClient::apply_edits(client.text("a.json"), Json::array({item.at("textEdit")})),
            R"({"camera": {"look_from": 1}})");
}

TEST(SignatureHelpMessages, ShowTheActiveParameter) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\nlet a = mix(1, max(2, 3), |");
  const Json help = client.result_at("textDocument/signatureHelp", "a.scene", cursor);
  EXPECT_EQ(help.at("activeParameter"), 2);
  EXPECT_EQ(help.at("signatures").front().at("label"), "mix(a, b, t)");
  EXPECT_EQ(help.at("signatures").front().at("parameters")[2].at("label"), "t");
  const Json outside = client.open_marked("b.scene", "scene 1\nlet a = |1");
  EXPECT_TRUE(client.result_at("textDocument/signatureHelp", "b.scene", outside).is_null());
}

}  // namespace
}  // namespace sdlc::test
