#include <chrono>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

Json document(const TestClient& client, const std::string& name) {
  return {{"textDocument", {{"uri", client.uri(name)}}}};
}

const std::string kScene =
    "scene 1\nlet a = 1\ndef ring(n) {\n  let b = n\n  sphere ball {\n    radius: b\n  }\n}\n";

TEST(DocumentSymbols, AreNestedIfTheClientCanShowThat) {
  TestClient client(Json{{"textDocument",
                          {{"documentSymbol",
                            {{"hierarchicalDocumentSymbolSupport", true},
                             {"symbolKind", {{"valueSet", {1, 19}}}}}}}}});
  client.open("a.scene", kScene);
  const Json symbols = client.result("textDocument/documentSymbol", document(client, "a.scene"));
  ASSERT_EQ(symbols.size(), 2u);
  EXPECT_EQ(symbols[0].at("name"), "a");
  EXPECT_EQ(symbols[0].at("detail"), "= 1");
  EXPECT_EQ(symbols[0].at("kind"), 14);
  const Json& ring = symbols[1];
  EXPECT_EQ(ring.at("detail"), "(n)");
  EXPECT_EQ(ring.at("range").at("end"), (Json{{"line", 7}, {"character", 1}}));
  EXPECT_EQ(ring.at("selectionRange").at("start"), (Json{{"line", 2}, {"character", 4}}));
  ASSERT_EQ(ring.at("children").size(), 2u);
  EXPECT_EQ(ring.at("children")[1].at("name"), "ball");
  EXPECT_EQ(ring.at("children")[1].at("kind"), 19);
}

TEST(DocumentSymbols, AreAListForPlainClients) {
  TestClient client;
  client.open("a.scene", kScene);
  const Json symbols = client.result("textDocument/documentSymbol", document(client, "a.scene"));
  ASSERT_EQ(symbols.size(), 4u);
  EXPECT_EQ(symbols[3].at("name"), "ball");
  EXPECT_EQ(symbols[3].at("containerName"), "ring");
  EXPECT_EQ(symbols[3].at("kind"), 13) << "objects are too new";
  EXPECT_EQ(symbols[3].at("location").at("uri"), client.uri("a.scene"));
}

TEST(DocumentSymbols, OfAConfigAreItsMembers) {
  TestClient client;
  client.open("a.json", "{\"camera\": {\"vfov\": 40}, \"spheres\": []}");
  const Json symbols = client.result("textDocument/documentSymbol", document(client, "a.json"));
  ASSERT_EQ(symbols.size(), 3u);
  EXPECT_EQ(symbols[1].at("name"), "vfov");
}

TEST(DocumentSymbols, OfALongLineAreFound) {
  TestClient client;
  std::string text = "{\"spheres\": [";
  while (text.size() < 3'000'000) text += "{\"radius\": 1, \"name\": \"é\"}, ";
  client.open("a.json", text + "{}], \"last\": 1}");
  const Json symbols = client.result("textDocument/documentSymbol", document(client, "a.json"));
  EXPECT_EQ(symbols.back().at("name"), "last");
  // The é of 29 bytes per sphere counts once in UTF-16.
  const std::size_t spheres = (text.size() - 13) / 29;
  EXPECT_EQ(symbols.back().at("location").at("range").at("start").at("character"),
            text.size() - spheres + 5);
}

TEST(WorkspaceSymbols, AreThoseOfAllFilesBestFirst) {
  TestClient client;
  client.write("deep/lib.scene",
               "scene 1\nfn spring(x) = x\ngroup outer { sphere ring { radius: 1 } }\n");
  client.notify("workspace/didChangeWatchedFiles",
                {{"changes", Json::array({{{"uri", client.uri("deep/lib.scene")}, {"type", 1}}})}});
  client.open("a.scene", "scene 1\nimport \"deep/lib.scene\" as ring\ndef rings() {}\nlet r = 1\n");
  Json found;
  // The folder is read in the background, on a busy machine late.
  while (found.size() < 3) {
    found = client.result("workspace/symbol", {{"query", "RING"}});
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].at("name"), "ring");
  EXPECT_EQ(found[0].at("containerName"), "outer");
  EXPECT_EQ(found[0].at("location").at("uri"), client.uri("deep/lib.scene"));
  EXPECT_EQ(found[0].at("location").at("range").at("start"),
            (Json{{"line", 2}, {"character", 21}}));
  EXPECT_EQ(found[1].at("name"), "rings");
  EXPECT_EQ(found[1].at("kind"), 5);
  EXPECT_EQ(found[2].at("name"), "spring");
  EXPECT_EQ(client.result("workspace/symbol", {{"query", "nothing"}}), Json::array());
}

TEST(FoldingRanges, KeepTheLineOfTheClosingBracket) {
  TestClient client(Json{{"textDocument", {{"foldingRange", {{"lineFoldingOnly", true}}}}}});
  client.open("a.scene",
              "// one\n// two\nscene 1\ngroup { if 1 < 2 {\n  sphere { radius: 1 }\n} else {\n"
              "  sphere { radius: (\n    1) }\n} }\n");
  EXPECT_EQ(client.result("textDocument/foldingRange", document(client, "a.scene")),
            Json::array({{{"startLine", 0}, {"endLine", 1}, {"kind", "comment"}},
                         {{"startLine", 3}, {"endLine", 8}},
                         {{"startLine", 5}, {"endLine", 7}},
                         {{"startLine", 6}, {"endLine", 7}}}));
}

TEST(FoldingRanges, HaveColumnsIfTheClientUsesThem) {
  TestClient client;
  client.open("a.json", "{\n\"a\": [\n1\n]}\n");
  EXPECT_EQ(client.result("textDocument/foldingRange", document(client, "a.json")),
            Json::array(
                {{{"startLine", 0}, {"startCharacter", 1}, {"endLine", 3}, {"endCharacter", 1}},
                 {{"startLine", 1}, {"startCharacter", 6}, {"endLine", 3}, {"endCharacter", 0}}}));
}

TEST(SelectionRanges, AreNestedForEachCursor) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet abc = f(x)\n");
  Json params = document(client, "a.scene");
  params["positions"] =
      Json::array({{{"line", 1}, {"character", 5}}, {{"line", 99}, {"character", 0}}});
  const Json ranges = client.result("textDocument/selectionRange", params);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].at("range").at("end"), (Json{{"line", 1}, {"character", 7}}));
  EXPECT_EQ(ranges[0].at("parent").at("range").at("start"), (Json{{"line", 1}, {"character", 0}}));
  EXPECT_TRUE(ranges[0].at("parent").at("parent").contains("range"));
  client.open("empty.scene", "");
  params["textDocument"]["uri"] = client.uri("empty.scene");
  EXPECT_EQ(client.result("textDocument/selectionRange", params).size(), 2u);
}

}  // namespace
}  // namespace sdlc::test
