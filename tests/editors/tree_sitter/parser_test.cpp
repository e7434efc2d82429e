#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/syntax/syntax.hpp"
#include "tests/editors/scene_texts.hpp"
#include "tests/editors/tree_sitter/scene_tree.hpp"

extern "C" const TSLanguage* tree_sitter_sdlc();

// The tree-sitter grammar reads what the program's own grammar reads.
namespace sdlc::test {
namespace {

/// The codes of the errors of syntax in a text.
std::set<std::string> error_codes(const lang::SourceFile& file) {
  lang::DiagnosticSink sink;
  lang::parse(file, sink);
  std::set<std::string> codes;
  for (const lang::Diagnostic& diagnostic : sink.diagnostics()) {
    codes.insert(std::string(diagnostic.info->code));
  }
  return codes;
}

TEST(TreeSitterParser, HasTheAbiThatEditorsRead) {
  EXPECT_EQ(ts_language_version(tree_sitter_sdlc()), 14u);
}

TEST(TreeSitterParser, ReadsEveryCorrectSceneOfTheRepository) {
  const auto texts = correct_scene_texts();
  EXPECT_GT(texts.size(), 400u);
  for (const auto& file : texts) {
    const SceneTree tree(file->text());
    EXPECT_EQ(tree.first_error(), "") << file->name() << "\n" << file->text();
  }
}

/// What only the program reports: a character that is not allowed in comments and strings, or no
/// UTF-8; the version of the language, which may also be absent; its limits; and brackets that
/// match, but not the indentation.
bool is_lenient(const std::string& code) {
  constexpr std::array kCodes{"E003", "E007", "E010", "E011", "E017", "E301", "E303"};
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

TEST(TreeSitterParser, FindsAnErrorInEveryWrongSceneOfTheRepository) {
  std::size_t count = 0;
  for (const auto& file : all_scene_texts()) {
    const std::set<std::string> codes = error_codes(*file);
    if (codes.empty() || std::ranges::any_of(codes, is_lenient)) continue;
    ++count;
    EXPECT_TRUE(SceneTree(file->text()).has_error())
        << file->name() << " " << testing::PrintToString(codes) << "\n"
        << file->text();
  }
  EXPECT_GT(count, 150u);
}

/// Both grammars, about the statement after a header.
void expect_both_read(const std::string& statement, bool is_correct) {
  const lang::SourceFile file("test.scene", "scene 1\n" + statement);
  lang::DiagnosticSink sink;
  lang::parse(file, sink);
  EXPECT_EQ(!sink.has_errors(), is_correct) << statement;
  const SceneTree tree(file.text());
  EXPECT_EQ(!tree.has_error(), is_correct) << statement << "\n" << tree.shape();
}

TEST(TreeSitterParser, ReadsEveryNumber) {
  for (const std::string_view digits :
       {"0", "1.5", ".5", "1_000.000_1", "1e3", "1E-3", "2.5e+1_0"}) {
    for (const std::string_view unit :
         {"", "%", "deg", "rad", "turn", "mm", "cm", "m", "km", "ms", "s"}) {
      expect_both_read("let a = " + std::string(digits) + std::string(unit), true);
    }
  }
  expect_both_read("let a = [1..2, 1. .. 2]", false);
  expect_both_read("let a = [1..2, 1 ...5, 0..-1, 1m..2m]", true);
}

TEST(TreeSitterParser, ReadsNoPartOfAWrongToken) {
  for (const char* value :
       {"1.",      "1.e3",    "1__0",      "1_",       "_1",       "0x10",
        "5min",    "50%b",    "1.2.3",     "1e",       "1e5e5",    "2 m",
        "5m%",     "5%%",     "1e-",       "2\u03C0",  "2\u00B5m", "gr\u00F6\u00DFe",
        "#12",     "#1234",   "#ggg",      "#1234567", "#",        "\"a",
        "\"a\n\"", "\"\\x\"", "\"\\u12\"", "\"\t\"",   "'a'",      "a\rb"}) {
    // The text must not become correct when its last word is cut off.
    if (std::string_view(value) == "_1") continue;
    expect_both_read("sphere { x: " + std::string(value) + " }", false);
  }
  for (const char* statement : {"x: if a thenb else c", "for i ina {}", "import \"a\" asb",
                                "lets = 1", "letx: = 1", "x: a orb", "x: nota b"}) {
    expect_both_read(statement, false);
  }
}

TEST(TreeSitterParser, ReadsStringsAndTheirEscapes) {
  for (const char* string :
       {"\"\"", "\" \"", "\"//\"", "\"/* \"", "\"\\\\\"", "\"\\\"\"", "\"\\u00e9\\n/\\/\"",
        "\"a // b\\t/* c\"", "\"\u65E5\u672C \U0001F600\"", "\"\\n  \\n\"", "\"let x = 1\""}) {
    expect_both_read("x: " + std::string(string), true);
  }
}

TEST(TreeSitterParser, ReadsCommentsBetweenAnyTokens) {
  const std::string_view tokens[] = {
      "param", "a",  ":", "number", "=",    "f",    "(",     "b", ":", "-", "1m", ",", "(", "1",
      ",",     "2",  ",", "3",      ")",    ")",    "[",     "x", "]", ".", "y",  "^", "2", "x",
      ":",     "if", "p", "then",   "#fff", "else", "\"s\"", "d", ".", "k", "n",  "{", "}"};
  for (const std::string_view comment :
       {"/**/", "/* /* */ // */", "// a\n", "/// a\n", "//// a\r\n", "/***/", "/*/ */", "//\n",
        "///\n", "/* \" */"}) {
    std::string statement;
    for (const std::string_view token : tokens) {
      statement += std::string(comment) + std::string(token);
    }
    expect_both_read(statement + std::string(comment), true);
  }
  for (const char* statement : {"x: 1 /*", "x: 1 /* /* */", "x: 1 */", "x: 1 / / 2", "x: /* */"}) {
    expect_both_read(statement, false);
  }
}

TEST(TreeSitterParser, KnowsWhereWordsAreNames) {
  for (const char* statement :
       {"sphere { for: 1, let: f(if: 2, true: 3) }", "let in = as + scene", "as in { scene: in }",
        "for in in in { }", "import \"a\" as as", "scene scene { }", "let format = notes + iffy",
        "x: if: 1", "fn scene(in, as: as = as) = in"}) {
    expect_both_read(statement, std::string_view(statement) != "x: if: 1");
  }
  for (const char* statement :
       {"let for = 1", "sphere not { }", "let a = let", "x: f(true = 1)", "fn f(if) = 1",
        "import \"a\" as if", "x: a.if", "true { }", "x: a or: 3", "x: a and: 3",
        "if a { } else: 3", "center:\nradius: 1"}) {
    expect_both_read(statement, false);
  }
}

TEST(TreeSitterParser, GivesOperatorsTheSameOperands) {
  const auto shape = [](const std::string& value) { return SceneTree("x: " + value).shape(); };
  EXPECT_EQ(shape("-2^-2"),
            "(source_file (property name: (label (identifier)) value: (unary (power base: (number) "
            "exponent: (unary (number))))))");
  EXPECT_EQ(shape("1 + 2 * 3 .. 4"),
            "(source_file (property name: (label (identifier)) value: (interval from: (sum "
            "(number) (product (number) (number))) to: (number))))");
  EXPECT_EQ(shape("not 1 < 2 and 3 or 4"),
            "(source_file (property name: (label (identifier)) value: (disjunction (conjunction "
            "(negation (comparison left: (number) right: (number))) (number)) (number))))");
}

TEST(TreeSitterParser, RefusesOperatorsWhereTheProgramDoes) {
  for (const char* value : {"a < b < c",
                            "a == not b",
                            "1 + if a then b else c",
                            "not if a then b else c",
                            "a .. b .. c",
                            "a ^ ^ b",
                            "- - ",
                            "a(1)(2)",
                            "a[0](1)",
                            "a[0].b(1)",
                            "1.x",
                            "1[0]",
                            "[1][0]",
                            "\"a\".b",
                            "(1, 2)",
                            "(1, 2, 3, 4)",
                            "()",
                            "a ! b",
                            "a && b",
                            "a % b",
                            "[,]",
                            "f(,)",
                            "f(1 2)",
                            "a..",
                            "a.",
                            "if a then b",
                            "{}",
                            "a = b"}) {
    expect_both_read("let v = " + std::string(value) + "\n", false);
  }
  for (const char* value :
       {"a < b and c <= d", "a + -b", "- -a", "a - -b^-c", "(1)[0].x", "f(1).x[0].y", "a.b.c(1).d",
        "(1, 2, 3,)", "[1, 2,]", "f(1,)", "[]", "f()", "(if a then b else c)", "a\n(1)\n[0]\n.x",
        "if a then b else if c then d else e", "if a then if b then c else d else e",
        "if if a then b else c then d else e", "not not a", "1 .. 2 == 3 .. 4"}) {
    expect_both_read("let v = " + std::string(value) + "\n", true);
  }
}

TEST(TreeSitterParser, ReadsStatementsWithAndWithoutCommas) {
  for (const char* text :
       {"", "a {}", "a {},", "a b {}", "a.b c {}", "a { b: 1 c: 2, d: 3, e {} }",
        "if a {} else if b {} else {}", "if a {} else if b {}", "for i in a {},", "def d() {}",
        "def d(a, b: number, c = 1,) { }", "fn f() = 1", "assert a, \"b\"", "include \"a\",",
        "param a = 1, param b: number = 2", "let a = 1 let b = 2"}) {
    expect_both_read(text, true);
  }
  for (const char* text : {"a {},,", ",", "a {", "}", "a b c {}", "def d {}", "fn f = 1",
                           "assert a", "param a", "let a", "let = 1", "if {}", "for i {}",
                           "a: ", "a", "a.b", "import \"a\"", "include a", "else {}"}) {
    expect_both_read(text, false);
  }
}

TEST(TreeSitterParser, ReadsOneByteOrderMarkAndEveryLineEnd) {
  EXPECT_EQ(SceneTree("\xEF\xBB\xBFscene 1\r\n// a\r\nlet a = 1\r\n").first_error(), "");
  EXPECT_EQ(SceneTree("").first_error(), "");
  EXPECT_TRUE(SceneTree("scene 1\rlet a = 1").has_error());
}

TEST(TreeSitterParser, ReadsAPartOfASceneWithoutItsHeader) {
  EXPECT_EQ(SceneTree("sphere { radius: 1 }\nlet a = 2").first_error(), "");
}

TEST(TreeSitterParser, KeepsTheStatementsAfterAWrongOne) {
  for (const char* wrong :
       {"let a =", "let for = 2", "sphere { center: (1, 2, radius: 1 }", "let s = \"abc", "x: 5min",
        "let a = 1 +", "a b c { }", "fn f(", "sphere { center: , radius: 1 }", "!!!", "x: #12",
        "x: (1, 2)", "assert a", "param p: = 2", "for i { }", "gr\u00F6\u00DFe: 1"}) {
    const std::string text =
        "scene 1\nlet before = 1\n" + std::string(wrong) + "\nlet after = 2\nsphere { }\n";
    const std::string shape = SceneTree(text).shape();
    EXPECT_TRUE(shape.find("ERROR") != std::string::npos ||
                shape.find("MISSING") != std::string::npos)
        << wrong;
    EXPECT_TRUE(
        shape.ends_with("(let_statement name: (identifier) value: (number)) (object kind: "
                        "(path (identifier)) body: (block)))"))
        << wrong << "\n"
        << shape;
  }
}

// The library of tree-sitter itself fails where more than 65,535 nodes are open.
TEST(TreeSitterParser, SurvivesDeepNesting) {
  for (const char* open : {"(", "[", "-", "not ", "if ", "{", "/*", "x{", "f(", "a[", "2^"}) {
    std::string text = "scene 1\nlet a = ";
    for (int i = 0; i < 20'000; ++i) text += open;
    EXPECT_TRUE(SceneTree(text).has_error()) << open;
  }
}

}  // namespace
}  // namespace sdlc::test
