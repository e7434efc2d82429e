#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/syntax/syntax.hpp"
#include "tests/lang/rulings/values.hpp"

// Rulings 1 to 8 of the language's design: syntax.
namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string joined(const std::vector<std::string>& tokens, const std::string& between) {
  std::string text;
  for (const std::string& token : tokens) text += token + between;
  return text;
}

TEST(Rulings, Ruling01_NewlinesNeverMatter) {
  const std::vector<std::string> tokens{
      "let",      "a", "=",     "if", "1",      "<",    "2",   "then",   "(", "1", ",",
      "2",        ",", "-",     "3",  ")",      "*",    "2",   "else",   "(", "0", ",",
      "0",        ",", "0",     ")",  "sphere", "ball", "{",   "center", ":", "a", "radius",
      ":",        "(", "[",     "1",  ",",      "2",    "]",   ")",      "[", "1", "]",
      "material", ":", "unlit", "(",  "color",  ":",    "red", ")",      "}"};
  for (const std::string between : {" ", "\n", "\t\r\n ", " // comment\n", "/* a\n/* b */ */"}) {
    const Evaluated result = evaluated({.root = joined(tokens, between)});
    ASSERT_THAT(result.codes(), IsEmpty()) << between;
    ASSERT_EQ(result.objects.size(), 1u) << between;
    const lang::Object& sphere = result.objects[0];
    EXPECT_EQ(sphere.name, "ball");
    EXPECT_EQ(sphere.get<render::Vec3>(lang::sphere_property::kCenter), (render::Vec3{2, 4, -6}));
    EXPECT_EQ(sphere.get<double>(lang::sphere_property::kRadius), 2);
  }
}

TEST(Rulings, Ruling01_CommasAreOptionalInBracesAndAtTheTopAndAtMostOne) {
  EXPECT_THAT(
      errors_of("let a = 1, let b = 2,\nrender { width: 5, height: 6 samples: 7, }, " + kBall),
      IsEmpty());
  EXPECT_THAT(errors_of("render { width: 5,, height: 6 }"), ElementsAre("E012"));
  EXPECT_THAT(errors_of("let a = 1,, let b = 2"), ElementsAre("E012"));
  EXPECT_THAT(errors_of("render { , width: 5 }"), ElementsAre("E012"));
}

TEST(Rulings, Ruling01_CommasAreRequiredInParenthesesAndBrackets) {
  for (const char* expression : {"(1 2, 3)", "[1 2]", "max(1 2)", "rgb(1, 2 3)"}) {
    const Told error = only_error_of("let a = " + std::string(expression));
    EXPECT_EQ(error.code, "E001") << expression;
    EXPECT_THAT(error.fixes, ElementsAre(",")) << expression;
    EXPECT_THAT(errors_of(with_fixes("let a = " + std::string(expression))), IsEmpty())
        << expression;
  }
  EXPECT_THAT(errors_of("let a = [1, 2,] let b = max(1, 2,) let c = (1, 2, 3,)"), IsEmpty());
  EXPECT_THAT(errors_of("let a = [1,, 2]"), ElementsAre("E001"));
}

TEST(Rulings, Ruling01_BracketsOnTheNextLineContinueAnExpression) {
  EXPECT_EQ(number("b", "let a = [5, 7]\nlet b = a\n[1]"), 7);
  EXPECT_EQ(number("b", "fn f(x) = 2 * x\nlet b = f\n(3)"), 6);
  EXPECT_EQ(number("b", "let b = (1, 2, 3)\n.z"), 3);
}

TEST(Rulings, Ruling01_AMissingCommaInAListOfTriplesIsAnErrorAtTheGap) {
  const Told error = only_error_of("let a = [(1, 2, 3)\n(4, 5, 6)]");
  EXPECT_EQ(error.code, "E001");
  EXPECT_THAT(error.fixes, ElementsAre(","));
  EXPECT_THAT(with_fixes("let a = [(1, 2, 3)\n(4, 5, 6)]"), HasSubstr("[(1, 2, 3),\n(4, 5, 6)]"));
  // Literals are never continued: a number, a string, a colour or a list has no parts.
  for (const char* list : {"[1 (2)]", "[\"a\" (\"b\")]", "[#fff (red)]", "[[1] [2]]"}) {
    EXPECT_THAT(errors_in(list), ElementsAre("E001")) << list;
  }
}

// The lint for the lopsided space is still to come.
TEST(Rulings, Ruling01_AMinusBehindABlankSubtracts) {
  EXPECT_EQ(number("len([x -1])", "let x = 5"), 1);
  EXPECT_EQ(number("([x -1])[0]", "let x = 5"), 4);
}

TEST(Rulings, Ruling02_AMalformedNumberIsOneError) {
  for (const char* written : {"1.", "1.e3", "1__0", "0x10", "5min", "50%b", "1.2.3", "1e", "1_"}) {
    const Told error = only_error_of("let a = " + std::string(written));
    EXPECT_EQ(error.code, "E002") << written;
    EXPECT_EQ(error.at, written);
  }
}

TEST(Rulings, Ruling02_AUnitBehindABlankIsPutRight) {
  const Told error = only_error_of("let a = 2 m");
  EXPECT_EQ(error.code, "E016");
  EXPECT_THAT(error.fixes, ElementsAre("2m"));
  EXPECT_THAT(with_fixes("let a = 2 m"), HasSubstr("let a = 2m"));
}

// `.5` formatted as `0.5` is the formatter's.
TEST(Rulings, Ruling02_TwoPointsMakeAnIntervalAndOneALeadingPoint) {
  EXPECT_TRUE(is_true("1..48 == (1 .. 48)"));
  EXPECT_TRUE(is_true("1...5 == (1 .. 0.5)"));
  EXPECT_EQ(number(".5"), 0.5);
  EXPECT_EQ(number("1_000.2_5e-1"), 100.025);
}

TEST(Rulings, Ruling02_UnitsDivideExactly) {
  EXPECT_EQ(number("35%"), 35.0 / 100);
  EXPECT_EQ(number("9mm"), 9.0 / 1000);
  EXPECT_EQ(number("35cm"), 35.0 / 100);
  EXPECT_EQ(number("13ms / 1s"), 13.0 / 1000);
  EXPECT_NE(9.0 / 1000, 9.0 * 0.001) << "so that dividing can be told from multiplying";
}

TEST(Rulings, Ruling02_AHashTakesTheWholeRunOfLettersAndDigits) {
  for (const char* written : {"#fade", "#80b3ff80", "#12345", "#xyz", "#ff_f"}) {
    const Told error = only_error_of("let a = " + std::string(written));
    EXPECT_EQ(error.code, "E006") << written;
    EXPECT_EQ(error.at, written);
  }
  EXPECT_THAT(only_error_of("let a = #80b3ff80").message, HasSubstr("colours have no alpha"));
}

TEST(Rulings, Ruling03_ReservedWordsMayBePropertyNamesAndLabels) {
  const Told property =
      only_error_of("sphere { center: (0, 0, 0), radius: 1, material: unlit(red), if: 1 }");
  EXPECT_EQ(property.code, "E104") << "it is read as a property, of which there is none";
  EXPECT_EQ(property.at, "if");
  const Told label = only_error_of("let a = linear(1, 2, 3, then: 4)");
  EXPECT_EQ(label.code, "E109");
  EXPECT_EQ(label.at, "then");
}

TEST(Rulings, Ruling03_ANameBeforeAColonIsNeverAValue) {
  const Told error = only_error_of("sphere {\n center:\n radius: 1\n material: unlit(red)\n}");
  EXPECT_EQ(error.code, "E014");
  EXPECT_EQ(error.at, "center");
}

TEST(Rulings, Ruling04_ImportsAndIncludesTakeLiterals) {
  for (const char* statement :
       {"import name as x", "import \"a\" + \"b\" as x", "include name", "include (\"a.scene\")"}) {
    EXPECT_THAT(errors_of("let name = \"a.scene\" " + std::string(statement)), ElementsAre("E001"))
        << statement;
  }
  EXPECT_THAT(errors_of("scene version\n"), testing::Contains("E010"));
}

TEST(Rulings, Ruling04_AssertHasAMessageAndParamADefault) {
  EXPECT_THAT(errors_of("assert true"), ElementsAre("E001"));
  EXPECT_THAT(errors_of("param a"), ElementsAre("E001"));
  EXPECT_THAT(errors_of("param a: number"), ElementsAre("E001"));
}

TEST(Rulings, Ruling04_AParamsTypeIsThatOfItsDefaultUnlessGiven) {
  EXPECT_THAT(codes_of({.root = "param a = 1", .sets = {{"a", "red"}}}), ElementsAre("E238"));
  EXPECT_THAT(errors_of("param a: number = 1 param b: string = \"x\" param c: vec3 = (1, 2, 3)"),
              IsEmpty());
  EXPECT_THAT(errors_of("param a: number = \"x\""), ElementsAre("E232"));
}

struct Habit {
  const char *written, *fixed;
};

TEST(Rulings, Ruling05_HabitsFromOtherLanguagesGetAFix) {
  const std::vector<Habit> habits{
      {"render { width = 5 }", "render { width: 5 }"},
      {"let a : 5", "let a = 5"},
      {"let a = true && false", "let a = true and false"},
      {"let a = true || false", "let a = true or false"},
      {"let a = !true", "let a = not true"},
      {"let a = 2 ** 3", "let a = 2 ^ 3"},
      {"let a = 1; let b = 2;", "let a = 1 let b = 2"},
      {"render { output: 'a.png' }", "render { output: \"a.png\" }"},
      {"render { width 5 }", "render { width: 5 }"},
      {"def ring(n) { } ring(n: 3)", "def ring(n) { } ring { n: 3 }"},
  };
  for (const Habit& habit : habits) {
    const Told error = told_about({.root = habit.written}).front();
    EXPECT_THAT(error.code, testing::StartsWith("E0")) << habit.written;
    const std::string fixed = with_fixes(habit.written);
    EXPECT_EQ(fixed, "scene 1\n" + std::string(habit.fixed));
    EXPECT_THAT(errors_of(fixed), IsEmpty()) << fixed;
  }
}

TEST(Rulings, Ruling05_OtherHabitsAreExplained) {
  const auto help_of = [](const std::string& statement) {
    const Told error = only_error_of(statement);
    return error.help.empty() ? "" : error.help[0];
  };
  EXPECT_THAT(help_of("let a = true ? 1 : 2"), HasSubstr("if … then … else …"));
  EXPECT_THAT(help_of("let a = 1 => 2"), HasSubstr("`>=`"));
  EXPECT_THAT(help_of("let a = sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }"),
              HasSubstr("an object is `sphere a { … }`"));
  EXPECT_THAT(help_of("let b = 3 let a = b % 2"), HasSubstr("mod(a, b)"));
  EXPECT_THAT(help_of("if true then render { }"), HasSubstr("if … { … }"));
}

TEST(Rulings, Ruling06_OnlySpacesTabsAndLineEndsAreBlank) {
  EXPECT_THAT(errors_of("let\ta\r\n = 1\n"), IsEmpty());
  const std::string nothing(1, '\0');
  for (const std::string& blank : {std::string("\r"), std::string("\u00a0"), nothing,
                                   std::string("\x07"), std::string("\u2003")}) {
    EXPECT_THAT(errors_of("let a =" + blank + " 1"), ElementsAre("E003")) << blank;
  }
}

TEST(Rulings, Ruling06_BidirectionalControlsAndBadUtf8AreErrorsEverywhere) {
  for (const std::string text : {"let a = 1 // \u202e", "let a = \"\u2066\"", "/* \u202a */"}) {
    EXPECT_THAT(errors_of(text), ElementsAre("E003")) << text;
  }
  for (const std::string text : {"let a = 1 // \xff", "let a = \"\xc3\"", "let a = 1 \xfe"}) {
    EXPECT_THAT(errors_of(text), ElementsAre("E007")) << text;
  }
}

TEST(Rulings, Ruling06_WhatIsNeverClosedIsReportedWhereItOpensOrShouldHaveClosed) {
  const Told comment = only_error_of("let a = 1\n/* never /* closed */\nlet b = 2");
  EXPECT_EQ(comment.code, "E004");
  EXPECT_EQ(comment.at, "/*");
  const Told quote = only_error_of("render { output: \"a.png\n}");
  EXPECT_EQ(quote.code, "E004");
  EXPECT_EQ(quote.at, "\"");
  const Told brace = only_error_of("render {\n  width: 5\nlet b = 2\n");
  EXPECT_EQ(brace.code, "E017") << "the first line not indented deeper than its opener";
  EXPECT_EQ(brace.at, "let");
  EXPECT_THAT(errors_of(with_fixes("render {\n  width: 5\nlet b = 2\n")), IsEmpty());
}

TEST(Rulings, Ruling07_RecoverySkipsToTheBlocksEndOrTheNextStatement) {
  // What is wrong in one statement hides nothing of the next, on a line of its own or not.
  for (const std::string broken : {"let a = @ (1, {2}, [3)]", "render { width: @ ( }",
                                   "sphere { @ { radius: 5 } }", "group { let = 5 }", "fn f(x = 1",
                                   "for i in { } ", "assert @,", "import 5 as", "@ @", "5"}) {
    for (const std::string next :
         {"\nlet b = 1 / 0", "\nrender { width: 1 / 0 }",
          "\ncamera main { fov: 1deg, at: (0, 0, 0), from: (1 / 0, 0, 0) }"}) {
      const auto codes = errors_of(broken + next);
      EXPECT_THAT(codes, testing::Contains(testing::StartsWith("E0"))) << broken << next;
      EXPECT_THAT(codes, testing::Contains("E215")) << broken << next;
    }
  }
  // Within a block the next property is read.
  EXPECT_THAT(errors_of("sphere ball {\n  center: 5 @ 6\n  radius: true\n  material: 1\n}"),
              ElementsAre("E201", "E001", "E201", "E201"));
}

TEST(Rulings, Ruling08_ThreeSlashesDocumentTheNextStatementOrTheFile) {
  const std::string text =
      "/// The file.\nscene 1\n/// A ball.\nlet a = 1 // no\n//// no\n/* no */ render {\n"
      "  /// Pixels.\n  width: 5\n}\n";
  const lang::SourceFile file("test.scene", text);
  lang::DiagnosticSink sink;
  const lang::SyntaxTree tree = lang::parse(file, sink);
  EXPECT_FALSE(sink.has_errors());
  std::vector<std::string> documentation;
  for (const lang::Comment& comment : tree.comments()) {
    if (comment.kind == lang::CommentKind::Doc) documentation.emplace_back(tree.text(comment.span));
  }
  // Hover and the reference, which will show them, are still to come.
  EXPECT_THAT(documentation, ElementsAre("/// The file.", "/// A ball.", "/// Pixels."));
}

}  // namespace
}  // namespace sdlc::test
