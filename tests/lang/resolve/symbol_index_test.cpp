#include "lang/resolve/symbol_index.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/resolve/indexed_program.hpp"

// Symbols of names, their occurrences, and the names that are visible at a place.
namespace sdlc::test {
namespace {

using lang::NameSpace;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(SymbolIndex, ResolvesDefinitionsOfBlocks) {
  const IndexedProgram program(R"(scene 1
fn f(x) = x
def d() {
  let a = 1
  fn f(x) = if x > a then f(x - 1) else let a = x in a
  def e(n) { d { } e { n: f(n) } }
  e { n: f(a) }
}
d { }
let b = f(2)
)");
  EXPECT_EQ(program.meaning("f(x - 1)"), "function 5:6");
  EXPECT_EQ(program.meaning("f(a)"), "function 5:6");
  EXPECT_EQ(program.meaning("f(2)"), "function 2:4");
  EXPECT_EQ(program.meaning("a then"), "value 4:7");
  EXPECT_EQ(program.meaning("a\n"), "value 5:45");
  EXPECT_EQ(program.meaning("e { n: f(n)"), "kind 6:7");
  EXPECT_EQ(program.meaning("n: f(a)"), "parameter 6:9");
  EXPECT_THAT(program.references("f(a)"), ElementsAre("5:6", "5:27", "6:27", "7:10"));
  EXPECT_THAT(program.unknown(), IsEmpty());
}

TEST(SymbolIndex, ResolvesLocalsInnermostFirst) {
  const IndexedProgram program(R"(scene 1
let size = 1
def row(size) {
  for i in range(size) {
    let size = size + i
    sphere { center: (size, 0, 0), radius: i }
  }
  sphere { radius: size }
}
sphere { radius: size }
)");
  EXPECT_EQ(program.meaning("size) {#2"), "parameter 3:9");
  EXPECT_EQ(program.meaning("size + i"), "parameter 3:9");
  EXPECT_EQ(program.meaning("size, 0"), "value 5:9");
  EXPECT_EQ(program.meaning("size }"), "parameter 3:9");
  EXPECT_EQ(program.meaning("size }#2"), "value 2:5");
  EXPECT_EQ(program.meaning("i }"), "loop variable 4:7");
  EXPECT_THAT(program.references("size"), ElementsAre("2:5", "10:18"));
  EXPECT_THAT(program.references("size) {"), ElementsAre("3:9", "4:18", "5:16", "8:20"));
  EXPECT_THAT(program.unknown(), IsEmpty());
}

TEST(SymbolIndex, ResolvesDeclarationsWhereverTheyAre) {
  const IndexedProgram program(R"(scene 1
let a = b + fact(3)
fn fact(n, of = n * b) = if n < 2 then 1 else n * fact(n - 1, of: of)
let b = pi
flake { n: 2, scale: 2 }
def flake(n: number) { if n > 0 { flake { n: n - 1 } } }
)");
  EXPECT_EQ(program.meaning("b +"), "value 4:5");
  EXPECT_EQ(program.meaning("n * b"), "parameter 3:9");
  EXPECT_EQ(program.meaning("fact(n -"), "function 3:4");
  EXPECT_EQ(program.meaning("of: of"), "parameter 3:12");
  EXPECT_EQ(program.meaning("of)"), "parameter 3:12");
  EXPECT_EQ(program.meaning("pi"), "built-in pi");
  EXPECT_EQ(program.meaning("n: 2"), "parameter 6:11");
  EXPECT_EQ(program.meaning("scale"), "built-in scale");
  EXPECT_EQ(program.meaning("number"), "built-in number");
  EXPECT_THAT(program.references("flake"), ElementsAre("5:1", "6:5", "6:35"));
  EXPECT_THAT(program.references("n: 2"), ElementsAre("5:9", "6:11", "6:27", "6:43", "6:46"));
}

TEST(SymbolIndex, FollowsImportsOverThreeFiles) {
  const IndexedProgram program(
      "scene 1\nimport \"b.scene\" as b\nlet x = b.tint + b.deep(b.tint)\nb.pair { gap: 1 }\n",
      {{"b.scene",
        "scene 1\nimport \"c.scene\" as c\n/// Of glass.\nlet tint = c.tint\n"
        "fn deep(of) = c.wide(of: of)\ndef pair(gap) { c.single { gap: gap } }\n"},
       {"c.scene", "scene 1\nlet tint = red\nfn wide(of) = of\ndef single(gap) {}\n"}});
  EXPECT_EQ(program.meaning("b.tint"), "import 2:21");
  EXPECT_EQ(program.meaning("tint"), "value b.scene 4:5");
  EXPECT_EQ(program.meaning("tint#2", "b.scene"), "value c.scene 2:5");
  EXPECT_EQ(program.meaning("of: of", "b.scene"), "parameter c.scene 3:9");
  EXPECT_EQ(program.meaning("gap"), "parameter b.scene 6:10");
  EXPECT_THAT(program.references("tint"), ElementsAre("3:11", "3:27", "b.scene 4:5"));
  EXPECT_THAT(program.references("tint", "c.scene"), ElementsAre("b.scene 4:14", "c.scene 2:5"));
  EXPECT_EQ(program.index().documentation(program.at("tint")), "Of glass.");
  std::vector<std::string> members;
  for (const lang::SymbolId member : program.index().members(program.at("b.tint"))) {
    members.push_back(program.describe(member));
  }
  EXPECT_THAT(members,
              ElementsAre("value b.scene 4:5", "function b.scene 5:4", "kind b.scene 6:5"));
}

TEST(SymbolIndex, KnowsTheUsesInIncludedFiles) {
  const IndexedProgram program(
      "scene 1\nimport \"lib.scene\" as lib\nsphere { radius: lib.size }\n"
      "if false { include \"part.scene\" }\n",
      {{"lib.scene", "scene 1\nlet size = 1\n"},
       {"part.scene", "scene 1\nimport \"lib.scene\" as l\ninclude \"deep.scene\"\n"},
       {"deep.scene", "scene 1\nimport \"lib.scene\" as lib\nsphere { radius: lib.size }\n"}});
  EXPECT_THAT(program.references("size"), ElementsAre("3:22", "lib.scene 2:5", "deep.scene 3:22"));
  const auto texts = program.renamed("size", "width");
  EXPECT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts.at("deep.scene"),
            "scene 1\nimport \"lib.scene\" as lib\nsphere { radius: lib.width }\n");
}

TEST(SymbolIndex, ListsWhatIsVisible) {
  const IndexedProgram program(R"(scene 1
let top = 1
fn f(a, b = 2) = a
def d(p) {
  let one = p
  for i in [1] { let two = i  sphere { radius: two } }
  let three = one
  group { let four = 4 } sphere { radius: three }
}
import "no.scene" as lib
)");
  EXPECT_THAT(program.visible("b = 2"), ElementsAre("a", "top", "lib"));
  EXPECT_THAT(program.visible("= a\ndef"), ElementsAre("b", "a", "top", "lib"));
  EXPECT_THAT(program.visible("p\n  for"), ElementsAre("p", "top", "lib"));
  EXPECT_THAT(program.visible("two }"), ElementsAre("two", "i", "one", "p", "top", "lib"));
  EXPECT_THAT(program.visible("three }"), ElementsAre("three", "one", "p", "top", "lib"));
  EXPECT_THAT(program.visible("import", NameSpace::Functions), ElementsAre("f"));
  EXPECT_THAT(program.visible("import", NameSpace::Kinds), ElementsAre("d"));
}

TEST(SymbolIndex, KnowsLabelsWordsAndNamesOfTheLanguage) {
  const IndexedProgram program(R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg, shutter: none }
camera other { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
render { camera: other, tone: sqrt }
sphere ball { center: (0, sqrt(4), 0), radius: 1, material: transmissive(ior: 1.5, fresnel: exact) }
)");
  EXPECT_EQ(program.meaning("other, tone"), "object 3:8");
  EXPECT_EQ(program.meaning("ball"), "object 5:8");
  EXPECT_EQ(program.meaning("sqrt }"), "built-in sqrt");
  EXPECT_EQ(program.meaning("radius"), "built-in radius");
  EXPECT_EQ(program.meaning("exact"), "built-in exact");
  EXPECT_EQ(program.meaning("none"), "built-in none");
  EXPECT_EQ(program.meaning("sphere"), "built-in sphere");
  EXPECT_EQ(program.index().documentation(program.at("ior")).empty(), false);
  EXPECT_THAT(program.references("sqrt(4)"), ElementsAre("5:27"));
  EXPECT_THAT(program.references("from"), ElementsAre("2:15", "3:16"));
  EXPECT_THAT(program.unknown(), IsEmpty());
}

TEST(SymbolIndex, KeepsDuplicatesApart) {
  const IndexedProgram program(R"(scene 1
let a = 1
let a = 2
fn f(x, x = a) = x
def d() { let b = 1 let b = b sphere { radius: b } }
let c = a
fn g(p, q, p, r, q) = r
)");
  EXPECT_EQ(program.meaning("p, r"), "parameter 7:12");
  EXPECT_EQ(program.meaning("q) ="), "parameter 7:18");
  EXPECT_THAT(program.references("r, q"), ElementsAre("7:15", "7:23"));
  EXPECT_THAT(program.references("a#1"), ElementsAre("2:5", "4:13", "6:9"));
  EXPECT_EQ(program.meaning("a = 2"), "value 3:5");
  EXPECT_THAT(program.references("a = 2"), ElementsAre("3:5"));
  EXPECT_EQ(program.meaning("x = a"), "parameter 4:9");
  EXPECT_EQ(program.meaning("x\ndef"), "parameter 4:6");
  EXPECT_EQ(program.meaning("b sphere"), "value 5:15");
  EXPECT_EQ(program.meaning("b }"), "value 5:25");
}

TEST(SymbolIndex, ResolvesTheRestOfABrokenFile) {
  const IndexedProgram program(R"(scene 1
let width = 2
let broken = width +
def box(size { sphere { radius: size } }
shpere { radius: width, let inner = width }
if width > 1 { param late = width  fn nested(n) = n + width }
sphere { radius: width  let r = width  center: (r, 0, 0) }
radius: width
lib.thing { size: width }
let last = widht + missing(width, of: width)
)");
  for (int i = 1; i <= 11; ++i) {
    EXPECT_EQ(program.meaning("width#" + std::to_string(i)), "value 2:5") << i;
  }
  EXPECT_EQ(program.meaning("r, 0"), "value 7:29");
  EXPECT_EQ(program.meaning("n + width"), "parameter 6:46");
  EXPECT_EQ(program.meaning("widht"), "unknown");
  EXPECT_EQ(program.meaning("missing"), "unknown");
}

TEST(SymbolIndex, ReadsDocCommentsBeforeDeclarations) {
  const IndexedProgram program(R"(/// The file.
scene 1

/// How many
///  there are.
param count = 3  /// not of the next
let other = count

// no doc comment
fn plain(
  /// In metres.
  height) = height
/// A ring.
// A remark.
def ring() {}
)");
  const auto documentation = [&](const std::string& place) {
    return program.index().documentation(program.at(place));
  };
  EXPECT_EQ(documentation("count"), "How many\n there are.");
  EXPECT_EQ(documentation("plain"), "");
  EXPECT_EQ(documentation("height"), "In metres.");
  EXPECT_EQ(documentation("ring() {"), "");
}

}  // namespace
}  // namespace sdlc::test
