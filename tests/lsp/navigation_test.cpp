#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;

const char* const kLibrary =
    "scene 1\nlet tint = red\nfn half(of) = of / 2\ndef pair(gap) { sphere { radius: gap } }\n";

Json range(int line, int begin, int end) {
  return {{"start", {{"line", line}, {"character", begin}}},
          {"end", {{"line", line}, {"character", end}}}};
}

TEST(GoToDefinition, LeadsToTheImportedFile) {
  TestClient client(Json{{"textDocument", {{"definition", {{"linkSupport", true}}}}}});
  client.write("lib.scene", kLibrary);
  const Json cursor = client.open_marked(
      "a.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = \"𝄞\" + lib.ti|nt\n");
  const Json links = client.result_at("textDocument/definition", "a.scene", cursor);
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].at("targetUri"), client.uri("lib.scene"));
  EXPECT_EQ(links[0].at("originSelectionRange"), range(2, 19, 23));
  EXPECT_EQ(links[0].at("targetRange"), range(1, 0, 14));
  EXPECT_EQ(links[0].at("targetSelectionRange"), range(1, 4, 8));
}

TEST(GoToDefinition, IsALocationForPlainClients) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\nlet a = 1\nlet b = |a\n");
  EXPECT_EQ(client.result_at("textDocument/definition", "a.scene", cursor),
            (Json{{"uri", client.uri("a.scene")}, {"range", range(1, 4, 5)}}));
}

TEST(GoToDefinition, OfAnImportIsTheFileAndItsDeclarationTheImport) {
  TestClient client;
  client.write("lib.scene", kLibrary);
  const Json cursor =
      client.open_marked("a.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = l|ib.tint\n");
  EXPECT_EQ(client.result_at("textDocument/definition", "a.scene", cursor),
            (Json{{"uri", client.uri("lib.scene")}, {"range", range(0, 0, 0)}}));
  EXPECT_EQ(client.result_at("textDocument/declaration", "a.scene", cursor),
            (Json{{"uri", client.uri("a.scene")}, {"range", range(1, 22, 25)}}));
}

TEST(GoToDefinition, IsNullWhereThereIsNone) {
  TestClient client;
  Json cursor = client.open_marked("a.scene", "scene 1\nimport \"|missing.scene\" as lib\n");
  EXPECT_EQ(client.result_at("textDocument/definition", "a.scene", cursor), nullptr);
  cursor = client.open_marked("a.json", "{\"cam|era\": 1}");
  for (const char* method : {"textDocument/definition", "textDocument/declaration"}) {
    EXPECT_EQ(client.result_at(method, "a.json", cursor), nullptr);
  }
  client.open("empty.scene", "");
  const Json far{{"line", 99}, {"character", 99}};
  EXPECT_EQ(client.result_at("textDocument/definition", "empty.scene", far), nullptr);
}

TEST(FindReferences, ListsTheUsesInAllFiles) {
  TestClient client;
  client.write("lib.scene", kLibrary);
  const Json cursor =
      client.open_marked("a.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.ti|nt\n");
  const auto uses = [&](bool includes_declaration) {
    std::vector<std::string> found;
    for (const Json& place :
         client.result_at("textDocument/references", "a.scene", cursor,
                          {{"context", {{"includeDeclaration", includes_declaration}}}})) {
      const std::string uri = place.at("uri");
      found.push_back(uri.substr(uri.rfind('/') + 1) + " " +
                      place.at("range").at("start").at("line").dump());
    }
    return found;
  };
  EXPECT_THAT(uses(true), ElementsAre("a.scene 2", "lib.scene 1"));
  EXPECT_THAT(uses(false), ElementsAre("a.scene 2"));
}

TEST(Highlights, DistinguishWritesFromReads) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\nlet a = 1\nlet b = |a\n");
  const Json found = client.result_at("textDocument/documentHighlight", "a.scene", cursor);
  EXPECT_EQ(found, Json::array({{{"range", range(1, 4, 5)}, {"kind", 3}},
                                {{"range", range(2, 8, 9)}, {"kind", 2}}}));
}

TEST(Links, LeadToFilesThatExist) {
  TestClient client;
  client.write("folder/lib.scene", kLibrary);
  client.open("a.scene",
              "scene 1\nimport \"folder/lib.scene\" as lib\nimport \"no.scene\" as no\n");
  EXPECT_EQ(
      client.result("textDocument/documentLink",
                    {{"textDocument", {{"uri", client.uri("a.scene")}}}}),
      Json::array({{{"range", range(1, 7, 25)}, {"target", client.uri("folder/lib.scene")}}}));
}

TEST(CallHierarchy, LeadsToCallersAndCallees) {
  TestClient client;
  client.write("lib.scene", kLibrary);
  const Json cursor = client.open_marked(
      "a.scene",
      "scene 1\nimport \"lib.scene\" as lib\nfn quarter(of) = lib.h|alf(lib.half(of))\n"
      "let a = lib.half(1) + quarter(2)\n");
  const Json half = client.result_at("textDocument/prepareCallHierarchy", "a.scene", cursor);
  ASSERT_EQ(half.size(), 1u);
  EXPECT_EQ(half[0].at("name"), "half");
  EXPECT_EQ(half[0].at("uri"), client.uri("lib.scene"));
  // The server looks at it in the scene of its file.
  const Json incoming = client.result("callHierarchy/incomingCalls", {{"item", half[0]}});
  EXPECT_TRUE(incoming.is_array());

  const Json file{{"name", "a.scene"},
                  {"uri", client.uri("a.scene")},
                  {"selectionRange", range(0, 0, 0)},
                  {"data", {{"isFile", true}}}};
  const Json outgoing = client.result("callHierarchy/outgoingCalls", {{"item", file}});
  ASSERT_EQ(outgoing.size(), 2u);
  EXPECT_EQ(outgoing[0].at("to").at("name"), "quarter");
  EXPECT_EQ(outgoing[0].at("fromRanges"), Json::array({range(3, 22, 29)}));
  EXPECT_EQ(outgoing[1].at("to").at("uri"), client.uri("lib.scene"));
  const Json callers =
      client.result("callHierarchy/incomingCalls", {{"item", outgoing[0].at("to")}});
  ASSERT_EQ(callers.size(), 1u);
  EXPECT_EQ(callers[0].at("from").at("name"), "a.scene");
  EXPECT_EQ(callers[0].at("from").at("data").at("isFile"), true);
}

TEST(CallHierarchy, OfAnItemThatIsGoneIsEmpty) {
  TestClient client;
  const Json cursor = client.open_marked("a.scene", "scene 1\nfn ha|lf(of) = of / 2\n");
  const Json half = client.result_at("textDocument/prepareCallHierarchy", "a.scene", cursor);
  client.change("a.scene", "scene 1\n");
  EXPECT_EQ(client.result("callHierarchy/incomingCalls", {{"item", half[0]}}), Json::array());
  EXPECT_EQ(client.result("callHierarchy/outgoingCalls", {{"item", half[0]}}), Json::array());
  EXPECT_EQ(client.ask("callHierarchy/outgoingCalls", {{"item", nullptr}}).error.at("code"),
            -32602);
}

}  // namespace
}  // namespace sdlc::test
