#include "lsp/semantic_tokens.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/lsp/ranges.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

constexpr auto kFull = "textDocument/semanticTokens/full";
constexpr auto kDelta = "textDocument/semanticTokens/full/delta";
constexpr auto kRange = "textDocument/semanticTokens/range";

/// Each token as "line:column+size type".
std::vector<std::string> decoded(const Json& data) {
  const Json types = lsp::semantic_tokens_options().at("legend").at("tokenTypes");
  std::vector<std::string> tokens;
  int line = 0, column = 0;
  for (std::size_t i = 0; i + 4 < data.size(); i += 5) {
    if (data[i] != 0) column = 0;
    line += data[i].get<int>();
    column += data[i + 1].get<int>();
    tokens.push_back(std::to_string(line) + ":" + std::to_string(column) + "+" +
                     data[i + 2].dump() + " " +
                     types.at(data[i + 3].get<std::size_t>()).get<std::string>());
  }
  return tokens;
}

Json params_of(TestClient& client) { return {{"textDocument", {{"uri", client.uri("a.scene")}}}}; }

Json full(TestClient& client) { return client.result(kFull, params_of(client)); }

/// The numbers after the edits of a delta.
std::vector<int> edited(std::vector<int> numbers, const Json& edits) {
  for (const Json& edit : edits) {
    const auto begin = numbers.begin() + edit.at("start").get<int>();
    const auto at = numbers.erase(begin, begin + edit.at("deleteCount").get<int>());
    const auto data = edit.at("data").get<std::vector<int>>();
    numbers.insert(at, data.begin(), data.end());
  }
  return numbers;
}

TEST(SemanticTokenRequests, CountInTheUnitsOfTheClient) {
  const std::string text = "scene 1\n/* ä😀\n😀 */ let a = pi // 😀\n";
  TestClient utf16;
  utf16.open("a.scene", text);
  EXPECT_EQ(decoded(full(utf16).at("data")),
            (std::vector<std::string>{"0:0+5 keyword", "0:6+1 number", "1:0+6 comment",
                                      "2:0+5 comment", "2:6+3 keyword", "2:10+1 variable",
                                      "2:12+1 operator", "2:14+2 variable", "2:17+5 comment"}));
  TestClient utf8(Json({{"general", {{"positionEncodings", Json::array({"utf-8"})}}}}));
  utf8.open("a.scene", text);
  EXPECT_EQ(decoded(full(utf8).at("data")).back(), "2:19+7 comment");
}

TEST(SemanticTokenRequests, LeaveTheRestToTheGrammarOfTheClient) {
  TestClient client(
      Json({{"textDocument", {{"semanticTokens", {{"augmentsSyntaxTokens", true}}}}}}));
  client.open("a.scene", "scene 1\nlet a = 1 // c\n");
  EXPECT_EQ(decoded(full(client).at("data")),
            (std::vector<std::string>{"0:0+5 keyword", "1:0+3 keyword", "1:4+1 variable"}));
}

TEST(SemanticTokenRequests, OfARangeArePartOfAll) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1\nlet b = 2\nlet c = 3\n");
  Json params = params_of(client);
  params["range"] = range_in_line(2, 0, 9);
  const Json found = client.result(kRange, params);
  EXPECT_EQ(decoded(found.at("data")),
            (std::vector<std::string>{"2:0+3 keyword", "2:4+1 variable", "2:6+1 operator",
                                      "2:8+1 number"}));
}

TEST(SemanticTokenRequests, OfAChangedTextAreEdits) {
  TestClient client;
  client.open("a.scene", "scene 1\nlet a = 1\nlet b = 2\n");
  Json result = full(client);
  auto numbers = result.at("data").get<std::vector<int>>();
  std::string id = result.at("resultId");
  for (const char* text : {"scene 1\nlet a = 1 + c\nlet b = 2\n", "scene 1\nlet b = 2\n", "",
                           "scene 1\nlet b = 2\n", "scene 1\nlet b = 2\n"}) {
    client.change("a.scene", text);
    Json params = params_of(client);
    params["previousResultId"] = id;
    result = client.result(kDelta, params);
    ASSERT_TRUE(result.contains("edits")) << text;
    numbers = edited(numbers, result.at("edits"));
    const Json all = full(client);
    EXPECT_EQ(numbers, all.at("data").get<std::vector<int>>()) << text;
    id = all.at("resultId");
  }
  EXPECT_EQ(result.at("edits"), Json::array());
}

TEST(SemanticTokenRequests, OfAnUnknownResultAreAll) {
  TestClient client;
  client.open("a.scene", "scene 1\n");
  Json params = params_of(client);
  params["previousResultId"] = "77";
  EXPECT_TRUE(client.result(kDelta, params).contains("data"));
}

TEST(SemanticTokenRequests, KeepAFewResults) {
  lsp::SemanticResults results;
  const std::string first = results.add("a", {1});
  for (std::size_t i = 0; i < lsp::SemanticResults::kMaxTexts; ++i) {
    results.add(std::to_string(i), {});
  }
  EXPECT_EQ(results.find("a", first), nullptr);
  EXPECT_NE(results.find("0", "2"), nullptr);
}

TEST(SemanticTokenRequests, OfConfigsAreEmpty) {
  TestClient client;
  client.open("c.json", "{}");
  EXPECT_EQ(client.result(kFull, {{"textDocument", {{"uri", client.uri("c.json")}}}}).at("data"),
            Json::array());
}

}  // namespace
}  // namespace sdlc::test
