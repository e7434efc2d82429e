#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "lang/editor/call_hierarchy.hpp"
#include "lang/editor/folding.hpp"
#include "lang/editor/links.hpp"
#include "lang/editor/navigation.hpp"
#include "lang/editor/rename.hpp"
#include "lang/editor/selection_ranges.hpp"
#include "lang/editor/symbols.hpp"
#include "lang/source/source.hpp"
#include "tests/lang/editor/marked_scene.hpp"
#include "tests/lang/editor/shared_scenes.hpp"

// Every question about a place has an answer within the text, however damaged the text is.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using namespace lang;

constexpr std::string_view kConstructs = R"(/// The file.
scene 1
import "lib.scene" as lib
param count: number = 3
/* block
   comment */ let colors = [#fc0, "a\"b", rgb(1, 2, 3)]
fn half(of, by = 2) = if of > 1 then of / by else -of ^ 2
def ring(n: number, tint = red) {
  for i in range(n) {
    let a = i / n * 1turn // turn
    sphere ball { center: (cos(a), 0, sin(a)).x * (1, 2, 3), radius: half(of: i) }
  }
  if n > 2 and not false { include "lib.scene" } else { group { ring small { n: n - 1 } } }
}
ring big { n: count, tint: lib.tint }
lib.pair { gap: lib.half(1) }
camera main { from: (0, 2, 6), shutter: none }
render { camera: main, tone: sqrt }
)";

constexpr std::string_view kLibrary =
    "scene 1\nlet tint = red\nfn half(of) = of / 2\ndef pair(gap) { sphere { radius: gap } }\n";

/// The text; cut off; with bytes removed, doubled or replaced.
std::vector<std::string> variants_of(std::string_view text) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same texts each time
  const auto place = [&] { return random() % text.size(); };
  std::vector<std::string> variants{std::string(text), ""};
  for (int i = 0; i < 40; ++i) {
    std::string changed(text);
    switch (i % 4) {
      case 0: changed.resize(place()); break;
      case 1: changed.erase(place(), 1 + place() % 5); break;
      case 2: changed.insert(place(), std::string(1, "{}()\"/*\r\n:=.\xF0"[place() % 14])); break;
      default: changed.insert(place(), changed.substr(place(), 20)); break;
    }
    variants.push_back(std::move(changed));
  }
  return variants;
}

void expect_inside(std::string_view text, Span span) {
  EXPECT_LE(span.begin, span.end);
  EXPECT_LE(span.end, text.size());
}

void check_ranges(const SourceFile& file, const SyntaxTree& tree) {
  for (const FoldingRange& range : folding_ranges(file, &tree, 1000)) {
    expect_inside(file.text(), range.hidden);
    EXPECT_NE(file.text(range.hidden).find('\n'), std::string_view::npos);
  }
  std::vector<std::uint32_t> offsets;
  for (std::uint32_t at = 0; at < file.text().size() + 2; at += 3) offsets.push_back(at);
  for (const std::vector<Span>& chain : selection_ranges(file, &tree, offsets)) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      expect_inside(file.text(), chain[i]);
      if (i == 0) continue;
      EXPECT_LE(chain[i].begin, chain[i - 1].begin);
      EXPECT_GE(chain[i].end, chain[i - 1].end);
      EXPECT_GT(chain[i].size(), chain[i - 1].size());
    }
  }
  std::vector<DocumentSymbol> around;
  for (const DocumentSymbol& symbol : document_symbols(tree)) {
    EXPECT_NE(symbol.name, "");
    EXPECT_LE(symbol.whole.begin, symbol.where.begin);
    EXPECT_GE(symbol.whole.end, symbol.where.end);
    while (!around.empty() && around.back().depth >= symbol.depth) around.pop_back();
    EXPECT_EQ(around.size(), symbol.depth);
    if (!around.empty()) {
      EXPECT_LE(around.back().whole.begin, symbol.whole.begin);
      EXPECT_GE(around.back().whole.end, symbol.whole.end);
    }
    around.push_back(symbol);
  }
}

void check_place(const SceneView& view, std::uint32_t file, std::uint32_t offset) {
  const std::string_view text = view.file(file).text();
  KnownScenes scenes({&view});
  if (const auto target = definition(view, file, offset)) {
    expect_inside(text, target->origin);
    if (const auto target_file = view.find(target->path)) {
      expect_inside(view.file(*target_file).text(), target->whole);
      expect_inside(view.file(*target_file).text(), target->where);
    }
  }
  const auto symbol = shared_symbol(view, file, offset);
  const bool may_rename = prepare_rename(view, file, offset).refusal.empty();
  EXPECT_EQ(may_rename, symbol && !symbol->path.empty());
  if (!symbol) return;
  EXPECT_FALSE(highlights(view, file, offset).empty());
  EXPECT_FALSE(references(scenes, *symbol, true).empty());
  if (const auto item = call_item_at(view, file, offset)) {
    incoming_calls(scenes, *symbol);
    outgoing_calls(view, *item);
  }
}

TEST(EveryPlace, HasAnswersInsideTheText) {
  for (const std::string& text : variants_of(kConstructs)) {
    SCOPED_TRACE(text);
    MarkedScene scene({{"root.scene", text}, {"lib.scene", std::string(kLibrary)}});
    const SceneView& view = scene.view();
    for (std::uint32_t file = 0; file < view.file_count(); ++file) {
      check_ranges(view.file(file), view.tree(file));
      file_links(view.tree(file), view.module(file).path, scene.workspace());
      for (std::uint32_t at = 0; at < view.file(file).text().size() + 2; ++at) {
        check_place(view, file, at);
      }
    }
  }
}

TEST(EveryPlace, OfAConfigHasAnswersInsideTheText) {
  for (const std::string& text : variants_of(
           R"({"camera": {"look_from": [0, 0, 1]}, // x
  "spheres": [{"radius": 1, "a": "\"]"}, {"radius": null}
], "x": {"y": {"z": [[], {}]}}})")) {
    SCOPED_TRACE(text);
    const SourceFile file("a.json", text);
    for (const DocumentSymbol& symbol : config_symbols(text)) {
      expect_inside(text, symbol.whole);
      EXPECT_NE(symbol.name, "");
    }
    folding_ranges(file, nullptr, 10);
    std::vector<std::uint32_t> offsets;
    for (std::uint32_t at = 0; at < text.size() + 2; ++at) offsets.push_back(at);
    for (const auto& chain : selection_ranges(file, nullptr, offsets)) {
      for (const Span span : chain) expect_inside(text, span);
    }
  }
}

}  // namespace
}  // namespace sdlc::test
