#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/resolve/indexed_program.hpp"

// A rename keeps the meaning of a program, or is refused.
namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(Rename, ReplacesEveryUseInEveryFile) {
  const IndexedProgram program(
      "scene 1\nimport \"lib.scene\" as lib\nlib.ring { n: lib.count, scale: lib.half(of: 4) }\n",
      {{"lib.scene",
        "scene 1\nparam count = 3\nfn half(of) = of / 2\n"
        "def ring(n) { for i in range(n) { sphere { radius: count } } }\n"}});
  EXPECT_THAT(program.renamed("count", "number"),
              ElementsAre(Pair("lib.scene",
                               "scene 1\nparam number = 3\nfn half(of) = of / 2\n"
                               "def ring(n) { for i in range(n) { sphere { radius: number } } }\n"),
                          Pair("test.scene",
                               "scene 1\nimport \"lib.scene\" as lib\n"
                               "lib.ring { n: lib.number, scale: lib.half(of: 4) }\n")));
  EXPECT_THAT(program.renamed("n: lib", "m").at("test.scene"),
              testing::HasSubstr("lib.ring { m: lib.count"));
  EXPECT_THAT(program.renamed("of: 4", "x").at("lib.scene"), testing::HasSubstr("half(x) = x / 2"));
  EXPECT_THAT(program.renamed("lib.ring", "shapes").at("test.scene"),
              testing::HasSubstr("shapes.ring { n: shapes.count, scale: shapes.half"));
}

TEST(Rename, KeepsDefinitionsOfBlocksApart) {
  const IndexedProgram program(
      "scene 1\nfn f(x) = x\ngroup { fn f(x) = let y = x in y + f(0) sphere { radius: f(1) } }\n"
      "sphere { radius: f(2) }\n");
  EXPECT_THAT(program.renamed("f(1)", "g"),
              ElementsAre(Pair("test.scene",
                               "scene 1\nfn f(x) = x\n"
                               "group { fn g(x) = let y = x in y + g(0) sphere { radius: g(1) } }\n"
                               "sphere { radius: f(2) }\n")));
  EXPECT_EQ(program.refusal("y + f", "x"), "conflict 3:14");
}

TEST(Rename, IsRefusedWhereAMeaningWouldChange) {
  const IndexedProgram program(R"(scene 1
let a = 1
let b = a
fn f(x) = x + pi
def d(p) { let q = p for i in [1] { sphere { radius: i + q + red } } }
camera one { from: (0, 0, 5) }
camera two { from: (0, 0, 5) }
render { camera: one }
)");
  EXPECT_EQ(program.refusal("a = 1", "b"), "conflict 3:5");
  EXPECT_EQ(program.refusal("a = 1", "x"), "conflict 4:6");
  EXPECT_EQ(program.refusal("a = 1", "f"), "") << "functions have a name space of their own";
  EXPECT_EQ(program.refusal("x)", "pi"), "conflict 4:15");
  EXPECT_EQ(program.refusal("x)", "red"), "") << "it is used elsewhere only";
  EXPECT_EQ(program.refusal("x)", "p"), "");
  EXPECT_EQ(program.refusal("i in", "q"), "conflict 5:16");
  EXPECT_EQ(program.refusal("p)", "material"), "conflict");
  EXPECT_EQ(program.refusal("one {", "two"), "conflict 7:8");
  EXPECT_EQ(program.refusal("one {", "a"), "");
  EXPECT_EQ(program.refusal("a = 1", "let"), "no name");
  EXPECT_EQ(program.refusal("a = 1", "2a"), "no name");
  EXPECT_EQ(program.refusal("pi", "tau"), "not declared");
  EXPECT_EQ(program.refusal("radius", "size"), "not declared");
}

}  // namespace
}  // namespace sdlc::test
