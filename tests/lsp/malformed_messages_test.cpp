#include <array>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

// Whatever a client sends, the server answers the next correct request. The seeds are fixed.
namespace sdlc::test {
namespace {

constexpr std::string_view kScene =
    "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.unit\n"
    "camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
    "sphere ball { center: (a, 0, 0), radius: 1, material: diffuse(color: #fc0) }\n";

constexpr auto kMethods = std::to_array<std::string_view>({"initialize",
                                                           "initialized",
                                                           "textDocument/didOpen",
                                                           "textDocument/didChange",
                                                           "textDocument/didClose",
                                                           "textDocument/didSave",
                                                           "textDocument/completion",
                                                           "completionItem/resolve",
                                                           "textDocument/hover",
                                                           "textDocument/signatureHelp",
                                                           "textDocument/definition",
                                                           "textDocument/references",
                                                           "textDocument/documentHighlight",
                                                           "textDocument/documentSymbol",
                                                           "textDocument/codeAction",
                                                           "codeAction/resolve",
                                                           "textDocument/codeLens",
                                                           "textDocument/documentLink",
                                                           "textDocument/documentColor",
                                                           "textDocument/colorPresentation",
                                                           "textDocument/formatting",
                                                           "textDocument/rangeFormatting",
                                                           "textDocument/onTypeFormatting",
                                                           "textDocument/rename",
                                                           "textDocument/prepareRename",
                                                           "textDocument/foldingRange",
                                                           "textDocument/selectionRange",
                                                           "textDocument/prepareCallHierarchy",
                                                           "callHierarchy/incomingCalls",
                                                           "callHierarchy/outgoingCalls",
                                                           "textDocument/semanticTokens/full",
                                                           "textDocument/semanticTokens/range",
                                                           "textDocument/semanticTokens/full/delta",
                                                           "textDocument/inlayHint",
                                                           "workspace/symbol",
                                                           "workspace/executeCommand",
                                                           "workspace/didChangeConfiguration",
                                                           "workspace/didChangeWatchedFiles",
                                                           "workspace/didChangeWorkspaceFolders",
                                                           "$/setTrace",
                                                           "$/cancelRequest",
                                                           "window/workDoneProgress/cancel",
                                                           "no/such/method"});

using Random = std::mt19937;

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

Json any_value(Random& random, int depth) {
  switch (below(random, depth > 2 ? 8 : 10)) {
    case 0: return nullptr;
    case 1: return below(random, 2) == 0;
    case 2: return -1;
    case 3: return 4294967296.5;
    case 4: return std::uint64_t{18446744073709551615u};
    case 5: return "";
    case 6: return "file:///no/such/%ZZ/file";
    case 7: return static_cast<int>(below(random, 9));
    case 8: {
      Json array = Json::array();
      for (std::size_t i = below(random, 4); i > 0; --i) {
        array.push_back(any_value(random, depth + 1));
      }
      return array;
    }
    default: return {{"uri", any_value(random, depth + 1)}, {"line", any_value(random, depth + 1)}};
  }
}

/// Correct parameters of every method at once.
Json good_params(const TestClient& client) {
  const Json start{{"line", 2}, {"character", 9}}, end{{"line", 4}, {"character", 3}};
  const Json range{{"start", start}, {"end", end}};
  const std::string uri = client.uri("a.scene");
  return {
      {"textDocument", {{"uri", uri}, {"version", 7}, {"languageId", "scene"}, {"text", kScene}}},
      {"position", start},
      {"positions", {start, end}},
      {"range", range},
      {"newName", "b"},
      {"ch", "}"},
      {"options", {{"tabSize", 2}, {"insertSpaces", true}}},
      {"context", {{"diagnostics", Json::array()}, {"includeDeclaration", true}}},
      {"color", {{"red", 1}, {"green", 0.5}, {"blue", 0}, {"alpha", 1}}},
      {"contentChanges", Json::array({{{"range", range}, {"text", "x"}}})},
      {"item", {{"uri", uri}, {"range", range}, {"selectionRange", range}}},
      {"query", "a"},
      {"command", "sdlc.chooseScene"},
      {"arguments", Json::array({{{"uri", uri}}})},
      {"changes", Json::array({{{"uri", uri}, {"type", 2}}})},
      {"event", {{"added", Json::array()}, {"removed", Json::array()}}},
      {"settings", {{"sdlc", {{"inlayHints", true}}}}},
      {"value", "off"},
      {"id", 1}};
}

/// Replaces a random part of the JSON value.
void spoil(Json& json, Random& random) {
  Json* part = &json;
  while (part->is_structured() && !part->empty() && below(random, 4) != 0) {
    part = &*std::next(part->begin(), static_cast<std::ptrdiff_t>(below(random, part->size())));
  }
  *part = any_value(random, 0);
}

std::string framed(std::string_view content) {
  return fmt::format("Content-Length: {}\r\n\r\n{}", content.size(), content);
}

/// A client with open texts.
struct Opened : TestClient {
  Opened() {
    write("lib.scene", "scene 1\nlet unit = 1\n");
    open("a.scene", std::string(kScene));
  }
};

/// Whether the server still knows its texts and answers.
void expect_alive(TestClient& client) {
  client.open("a.scene", "scene 1\nlet wrong = b\nsphere { center: (0, 0, 0), radius: 1 }\n");
  client.diagnostics("a.scene", [](const Json& found) {
    return !found.empty() && found[0].value("code", "") == "E101";
  });
  EXPECT_TRUE(client.exit());
}

TEST(MalformedMessages, WithAnyParametersAreAnswered) {
  Opened client;
  Random random(1);
  std::vector<std::int64_t> requests;
  for (int i = 0; i < 1000; ++i) {
    Json params = good_params(client);
    for (std::size_t n = below(random, 4); n > 0; --n) spoil(params, random);
    const std::string_view method = kMethods[below(random, kMethods.size())];
    requests.push_back(client.send_request(method, std::move(params)));
  }
  for (const std::int64_t request : requests) {
    const Answer answer = client.wait_for(request);
    EXPECT_NE((answer.error.is_null() ? 0 : answer.error.value("code", 0)),
              static_cast<int>(lsp::ErrorCode::InternalError))
        << answer.error.dump();
  }
  expect_alive(client);
}

TEST(MalformedMessages, WithChangedBytesAreSkipped) {
  Opened client;
  Random random(2);
  for (int i = 0; i < 600; ++i) {
    std::string content = Json{
        {"jsonrpc", "2.0"},
        {"id", i + 1'000'000},
        {"method", kMethods[below(random, kMethods.size())]},
        {"params",
         good_params(client)}}.dump();
    for (std::size_t n = 1 + below(random, 4); n > 0; --n) {
      content[below(random, content.size())] = static_cast<char>(random());
    }
    client.send_raw(framed(content));
  }
  expect_alive(client);
}

TEST(MalformedMessages, WithBrokenHeadersAreSkipped) {
  Opened client;
  Random random(3);
  const std::string good = framed(R"({"jsonrpc":"2.0","method":"$/setTrace","params":{}})");
  const std::vector<std::string> headers{
      "Content-Length: x\r\n\r\n{}",
      "Content-Length: -5\r\n\r\n{}",
      "Content-Length: 99999999999999999999\r\n\r\n",
      "Content-Length:\r\n\r\n",
      "content-length: 2\r\n\r\n{}",
      "Content-Length: 2\n\n[]",
      "Content-Type: application/vscode-jsonrpc; charset=utf-8\r\nContent-Length: 2\r\n\r\n{}",
      "nonsense\r\n\r\n",
      "\r\n\r\n\r\n",
      "{\"jsonrpc\":\"2.0\"}\r\n",
      framed(""),
      framed("[]"),
      framed("null"),
      framed(R"({"jsonrpc":"2.0","id":[1],"method":"shutdown"})"),
      framed(R"({"jsonrpc":"2.0","id":7})"),
      framed(R"({"jsonrpc":"2.0","id":7,"result":null})"),
      framed(R"({"jsonrpc":"2.0","id":7,"method":5})"),
      framed("\xff\xfe{}"),
      framed(std::string(100'000, '[')),
      framed(R"({"jsonrpc":"2.0","id":8,"method":"completionItem/resolve","params":)" +
             std::string(100'000, '[') + std::string(100'000, ']') + "}"),
      std::string(20'000, 'x') + "\r\n",
  };
  for (int i = 0; i < 400; ++i) {
    client.send_raw(headers[below(random, headers.size())]);
    if (below(random, 3) == 0) client.send_raw(good);
  }
  expect_alive(client);
}

TEST(MalformedMessages, BeforeInitializeAreRefused) {
  TestClient client(TestClient::Silent{});
  client.open("a.scene", std::string(kScene));
  EXPECT_EQ(client.ask("textDocument/hover", nullptr).error.at("code"), -32002);
  EXPECT_EQ(client.ask("shutdown", nullptr).error.at("code"), -32002);
  client.result("initialize", {{"capabilities", Json::object()}});
  EXPECT_EQ(client.ask("initialize", {{"capabilities", Json::object()}}).error.at("code"), -32600);
  client.result("shutdown", nullptr);
  EXPECT_EQ(client.ask("textDocument/hover", nullptr).error.at("code"), -32600);
}

TEST(MalformedMessages, HalfAtTheEndEndTheServer) {
  for (const std::string_view half :
       {"Content-Le", "Content-Length: 50\r\n\r\n{\"jsonrpc\"", "\r\n"}) {
    TestClient client;
    client.send_raw(half);
    client.end_input();
    EXPECT_FALSE(client.wait_for_end());
  }
}

}  // namespace
}  // namespace sdlc::test
