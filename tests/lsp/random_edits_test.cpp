#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/source/source.hpp"
#include "lsp/positions.hpp"
#include "tests/lsp/test_client.hpp"

// Random incremental edits of open files that import each other: the server that has seen all of
// them answers like one that opens the texts anew, and its memory does not grow. Seeds are fixed.
namespace sdlc::test {
namespace {

constexpr int kShards = 10, kEditsPerShard = 1000, kEditsBetweenComparisons = 25;
constexpr std::size_t kMaxText = 2000;

using Texts = std::map<std::string, std::string>;
using Random = std::mt19937;

const Texts kOriginals{
    {"root.scene", R"(scene 1
import "lib.scene" as lib
param count = 3
let size = lib.unit * 0.5
def tower(height, wide = size) {
  for level in range(height) { sphere { center: (0, level, 0), radius: wide } }
}
camera main { from: (0, 2, 9), at: (0, 0, 0), fov: 40deg }
background { color: white }
group { material: lib.paint, translate: (1, 0, 0)
  tower first { height: count }
}
include "part.scene"
// sdlc: allow(W402) a test
let unused = lib.twice(2)
sphere ball { center: (0, 0, 0), radius: size, material: lib.paint }
)"},
    {"lib.scene", R"(scene 1
import "base.scene" as base
/// The length of everything: 𝄞 é.
let unit = base.meter * 2
fn twice(x) = x + x
let paint = diffuse(color: rgb(200, 100, 50))
)"},
    {"base.scene", "scene 1\r\nlet meter = 1\r\nlet spare = [1, 2, 3]\r\n"},
    {"part.scene", R"(scene 1
import "base.scene" as base
for i in range(3) {
  let x = i * base.meter
  if x > 1 { sphere { center: (x, 1, 0), radius: 0.2, material: unlit(red) } }
}
)"},
};

constexpr auto kPieces = std::to_array<std::string_view>({"{",
                                                          "}",
                                                          "(",
                                                          ")",
                                                          "[",
                                                          "]",
                                                          ",",
                                                          ":",
                                                          "=",
                                                          "\"",
                                                          "//",
                                                          "/*",
                                                          "*/",
                                                          "+",
                                                          " - ",
                                                          "..",
                                                          "1",
                                                          "0.5",
                                                          "2deg",
                                                          "#fc0",
                                                          "size",
                                                          "lib.",
                                                          "base.meter",
                                                          "\n",
                                                          "\r\n",
                                                          "\r",
                                                          "let a = 1\n",
                                                          "import \"lib.scene\" as lib\n",
                                                          "import \"other.scene\" as other\n",
                                                          "sphere",
                                                          "é",
                                                          "𝄞",
                                                          "\xEF\xBB\xBF",
                                                          "scene 1\n",
                                                          "// sdlc: allow(W402)\n",
                                                          ""});

std::size_t below(Random& random, std::size_t limit) { return random() % limit; }

/// An offset of the text that a position can name.
std::uint32_t any_offset(const lang::SourceFile& file, Random& random) {
  const auto offset = static_cast<std::uint32_t>(below(random, file.text().size() + 1));
  return lsp::offset_of_json(file, lsp::position_json(file, offset, lang::PositionEncoding::Utf16),
                             lang::PositionEncoding::Utf16);
}

/// The text without the folder's name, which is another one in each client.
std::string without_folder(std::string text, const TestClient& client) {
  const std::string folder = client.path("");
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
    text.erase(at, folder.size());
  }
  return text;
}

/// What a client sees of a server: everything that follows from the texts.
std::string state_of(TestClient& client, const Texts& texts) {
  std::string state;
  for (const auto& [name, text] : texts) {
    const Json file{{"textDocument", {{"uri", client.uri(name)}}}};
    for (const std::string_view method :
         {"textDocument/documentSymbol", "textDocument/foldingRange", "textDocument/documentLink",
          "textDocument/semanticTokens/full", "textDocument/documentColor"}) {
      Json result = client.result(method, file);
      if (result.is_object()) result.erase("resultId");
      state += result.dump() + "\n";
    }
  }
  return without_folder(state, client);
}

std::size_t resident_kib() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word && word != "VmRSS:") {
  }
  std::size_t size = 0;
  status >> size;
  return size;
}

class RandomEdits : public testing::TestWithParam<int> {
 protected:
  static void open_all(TestClient& client, const Texts& texts) {
    for (const auto& [name, text] : kOriginals) client.write(name, text);
    for (const auto& [name, text] : texts) client.open(name, text);
  }

  void edit(TestClient& client) {
    auto& [name, text] =
        *std::next(texts_.begin(), static_cast<long>(below(random_, texts_.size())));
    Json changes = Json::array();
    for (std::size_t n = 1 + below(random_, 2); n > 0; --n) {
      const lang::SourceFile file(name, text);
      std::uint32_t begin = any_offset(file, random_), end = begin;
      if (below(random_, 2) == 0) end = any_offset(file, random_);
      if (begin > end) std::swap(begin, end);
      if (end - begin > 60)
        end = any_offset(lang::SourceFile(name, text.substr(0, begin + 60)), random_);
      end = std::max(begin, end);
      const std::string piece(kPieces[below(random_, kPieces.size())]);
      changes.push_back(
          {{"range", lsp::range_json(file, {begin, end}, lang::PositionEncoding::Utf16)},
           {"text", piece}});
      text.replace(begin, end - begin, piece);
    }
    const bool is_new = text.size() > kMaxText || below(random_, 60) == 0;
    if (is_new) {
      text = kOriginals.at(name);
      changes.push_back({{"text", text}});
    }
    client.notify("textDocument/didChange",
                  {{"textDocument", {{"uri", client.uri(name)}, {"version", ++version_}}},
                   {"contentChanges", std::move(changes)}});
  }

  /// What the client shows as the findings of the texts. The scene that a text is checked in is
  /// found in the background, so that it may be another one a moment later.
  std::string findings_of(TestClient& client) const {
    std::string rows;
    for (const auto& [name, text] : texts_) {
      client.codes(name);  // waits for a check
      rows += name + "\n";
      for (const Json& found : client.diagnostics(name, [](const Json&) { return true; })) {
        rows +=
            found.at("range").dump() + found.value("code", "") + found.value("message", "") + "\n";
      }
    }
    return without_folder(rows, client);
  }

  void expect_same_findings(TestClient& client, TestClient& fresh) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    std::string found = findings_of(client), expected = findings_of(fresh);
    while (found != expected && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      found = findings_of(client);
      expected = findings_of(fresh);
    }
    EXPECT_EQ(found, expected);
  }

  Random random_{static_cast<std::uint32_t>(GetParam())};
  Texts texts_ = kOriginals;
  int version_ = 1;
};

TEST_P(RandomEdits, GiveTheStateOfAFreshOpen) {
  TestClient client;
  open_all(client, texts_);
  std::size_t early_kib = 0;
  for (int i = 1; i <= kEditsPerShard && !HasFailure(); ++i) {
    edit(client);
    client.drop_messages();
    if (i == kEditsPerShard / 5) early_kib = resident_kib();
    if (i % kEditsBetweenComparisons != 0) continue;
    TestClient fresh;
    open_all(fresh, texts_);
    EXPECT_EQ(state_of(client, texts_), state_of(fresh, texts_));
    expect_same_findings(client, fresh);
  }
  if (!HasFailure()) {
    EXPECT_LT(resident_kib(), 2 * early_kib);
  }
}

INSTANTIATE_TEST_SUITE_P(Lsp, RandomEdits, testing::Range(0, kShards));

}  // namespace
}  // namespace sdlc::test
