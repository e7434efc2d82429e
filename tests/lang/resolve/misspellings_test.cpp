#include "lang/resolve/misspellings.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/lang/resolve/indexed_program.hpp"

// Unused declarations that unknown names probably mean.
namespace sdlc::test {
namespace {

/// "declared -> used", with "!" if the declaration is misspelt for certain; empty if there is none.
std::string misspelling(const std::string& text, const std::string& use) {
  const IndexedProgram program(text);
  const lang::Misspellings misspellings(program.table(), nullptr);
  const lang::Misspelling* found = misspellings.find(program.offset(use));
  if (found == nullptr) return "";
  return std::string(found->name) + " -> " + std::string(found->meant) +
         (found->is_certain ? "!" : "");
}

TEST(Misspellings, PairAnUnknownNameWithAnUnusedDeclaration) {
  EXPECT_EQ(misspelling("scene 1\nlet radius = 1\nlet b = raduis\n", "raduis"), "radius -> raduis");
  EXPECT_EQ(misspelling("scene 1\nlet radius = 1\nlet b = radius + raduis\n", "raduis"), "")
      << "it is used";
  EXPECT_EQ(misspelling("scene 1\nlet raduis = raduiss\n", "raduiss"), "")
      << "a value is not made of itself";
}

TEST(Misspellings, BlameTheDeclarationThatSeveralUsesContradict) {
  EXPECT_EQ(misspelling("scene 1\nlet hieght = 1\nlet b = height + 2 * height\n", "height"),
            "hieght -> height!");
  EXPECT_EQ(misspelling("scene 1\nfn haf(x) = x\nlet b = half(2) + half(3)\n", "half"),
            "haf -> half!");
}

TEST(Misspellings, StopOnRequest) {
  const IndexedProgram program("scene 1\nlet radius = 1\nlet b = radius\n");
  lang::StopRequest stop;
  EXPECT_TRUE(lang::Misspellings(program.table(), &stop).find(0) == nullptr);
  stop.make();
  EXPECT_THROW(lang::Misspellings(program.table(), &stop), lang::StopRequested);
}

TEST(Misspellings, FollowScopesAndNameSpaces) {
  EXPECT_EQ(misspelling("scene 1\nfn f(colour) = color\n", "color"), "colour -> color");
  EXPECT_EQ(misspelling("scene 1\nfn f(colour) = 1\nlet b = color\n", "color"), "");
  EXPECT_EQ(misspelling("scene 1\nfn heigth() = 1\nlet b = height\n", "height"), "")
      << "a function is no value";
  EXPECT_EQ(misspelling("scene 1\ndef box(widht) {}\nbox { width: 1 }\n", "width"),
            "widht -> width");
}

}  // namespace
}  // namespace sdlc::test
