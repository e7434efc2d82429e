#include "lang/resolve/symbol_types.hpp"

#include <string>

#include <gtest/gtest.h>

#include "lang/value/builtins.hpp"
#include "tests/lang/resolve/indexed_program.hpp"

namespace sdlc::test {
namespace {

/// The type of `x` in a file.
std::string type_of_x(const std::string& declaration) {
  const IndexedProgram program("scene 1\n" + declaration + "\n",
                               {{"lib.scene", "scene 1\nlet tint = red\nfn half(a) = a / 2\n"}});
  const lang::TypeInfo* type = lang::type_of(program.index(), program.at("x"));
  return type == nullptr ? "" : std::string(type->name);
}

TEST(SymbolTypes, AreReadFromTheText) {
  EXPECT_EQ(type_of_x("let x = 3cm"), "number");
  EXPECT_EQ(type_of_x("let x = 90deg / 2"), "angle");
  EXPECT_EQ(type_of_x("let x = 90deg / 2deg"), "number");
  EXPECT_EQ(type_of_x("let x = 2 * (1, 2, 3)"), "vec3");
  EXPECT_EQ(type_of_x("let x = (0deg, 30deg, 0deg)"), "angles");
  EXPECT_EQ(type_of_x("let x = not true"), "bool");
  EXPECT_EQ(type_of_x("let x = if 1 < 2 then \"a\" else \"b\""), "string");
  EXPECT_EQ(type_of_x("let x = [1, 2]"), "list");
  EXPECT_EQ(type_of_x("let x = 1 .. 2"), "interval");
  EXPECT_EQ(type_of_x("let x = diffuse(color: red)"), "material");
  EXPECT_EQ(type_of_x("let x = mix(red, #ff0000, 0.5)"), "color");
  EXPECT_EQ(type_of_x("param x: angle = lib"), "angle");
  EXPECT_EQ(type_of_x("fn f(x = pi) = x"), "number");
  EXPECT_EQ(type_of_x("for x in range(3) {}"), "number");
  EXPECT_EQ(type_of_x("for x in range(0deg, 90deg, 30deg) {}"), "angle");
  EXPECT_EQ(type_of_x("for x in reverse(sort([red, tan])) {}"), "color");
  EXPECT_EQ(type_of_x("fn f(x) = x"), "");
  EXPECT_EQ(type_of_x("import \"lib.scene\" as x"), "");
}

TEST(SymbolTypes, FollowNamesThroughFiles) {
  const std::string import = "\nimport \"lib.scene\" as lib";
  EXPECT_EQ(type_of_x("let x = lib.tint" + import), "color");
  EXPECT_EQ(type_of_x("let x = y.x let y = (1, 2, 3)"), "number");
  EXPECT_EQ(type_of_x("let x = y let y = z let z = false"), "bool");
  EXPECT_EQ(type_of_x("let x = f(2) fn f(a: vec3) = a * 2"), "vec3");
  EXPECT_EQ(type_of_x("let x = x"), "");
}

TEST(SymbolTypes, OfEveryBuiltinFunctionAreKnown) {
  for (const lang::Builtin& builtin : lang::all_builtins()) {
    // Their types are those of elements or of later arguments.
    if (builtin.name == "sum" || builtin.name == "remap") continue;
    EXPECT_NE(type_of_x("let x = " + std::string(builtin.name) + "(2)"), "") << builtin.name;
  }
}

TEST(SymbolTypes, OfLongChainsAreGivenUp) {
  std::string text = "let x = a1 * a1\n";
  for (int i = 1; i < 2000; ++i) {
    text += "let a" + std::to_string(i) + " = a" + std::to_string(i + 1) + " * a" +
            std::to_string(i + 1) + "\n";
  }
  EXPECT_EQ(type_of_x(text), "");
}

}  // namespace
}  // namespace sdlc::test
