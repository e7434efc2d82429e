#include "lang/repair/scene_repair.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/report/findings.hpp"
#include "lang/source/source.hpp"

// What a text is taken for when its brackets do not match.
namespace sdlc::lang {
namespace {

struct Repaired {
  std::string text;  ///< as it was if nothing is repaired
  std::vector<std::string> codes;
};

RepairedText repair(const SourceFile& file, DiagnosticSink& sink) {
  RepairedText text(file.text());
  const RepairContext context{file, text, sink};
  repair_spelling(context);
  repair_structure(context, false);
  return text;
}

Repaired repaired(const std::string& text) {
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  Repaired repaired{repair(file, sink).text(), {}};
  for (const Diagnostic* diagnostic : select_findings(sink).shown) {
    repaired.codes.emplace_back(diagnostic->info->code);
  }
  return repaired;
}

TEST(SceneRepair, LeavesWhatMatchesAsItIs) {
  const std::string text = "scene 1\ngroup g {\nsphere { center: (0, 1, 0), radius: 1 }\n  }\n";
  EXPECT_EQ(repaired(text).text, text);
  EXPECT_TRUE(repaired(text).codes.empty());
}

TEST(SceneRepair, ClosesAnObjectAtTheEndOfItsOnlyLine) {
  const Repaired result = repaired("sphere { radius: 1\nsphere { radius: 2 }\n");
  EXPECT_EQ(result.text, "sphere { radius: 1}\nsphere { radius: 2 }\n");
  EXPECT_EQ(result.codes, std::vector<std::string>{"E001"});
}

TEST(SceneRepair, ClosesABlockBeforeTheFirstLineThatIsNotDeeper) {
  const Repaired result = repaired("group {\n  sphere { radius: 1 }\n\nsphere { radius: 2 }\n");
  EXPECT_EQ(result.text, "group {\n  sphere { radius: 1 }}\n\nsphere { radius: 2 }\n");
  EXPECT_EQ(result.codes, std::vector<std::string>{"E017"});
}

TEST(SceneRepair, OpensABlockWhoseLinesAreDeeper) {
  EXPECT_EQ(repaired("for i in range(3)\n  sphere { radius: i }\n}\n").text,
            "for i in range(3) {\n  sphere { radius: i }\n}\n");
}

TEST(SceneRepair, ClosesParenthesesBeforeAPropertyThatIsNoArgument) {
  EXPECT_EQ(repaired("sphere { center: (0, 1, 0, radius: 1 }").text,
            "sphere { center: (0, 1, 0), radius: 1 }");
  EXPECT_EQ(repaired("sphere { material: specular(color: red, fuzz: 1 }").text,
            "sphere { material: specular(color: red, fuzz: 1) }");
}

TEST(SceneRepair, BlanksWhatClosesNothing) {
  EXPECT_EQ(repaired("sphere { center: (0, 1, 0)), radius: 1 }").text,
            "sphere { center: (0, 1, 0) , radius: 1 }");
  EXPECT_EQ(repaired("group {\n  sphere { radius: 1 }}\n  sphere { radius: 2 }\n}\n").text,
            "group {\n  sphere { radius: 1 } \n  sphere { radius: 2 }\n}\n");
}

TEST(SceneRepair, PutsTheRightBracketInAnothersPlace) {
  EXPECT_EQ(repaired("let a = [1, 2, 3)\nlet b = 1\n").text, "let a = [1, 2, 3]\nlet b = 1\n");
  EXPECT_EQ(repaired("sphere { material: diffuse{color: red} }").text,
            "sphere { material: diffuse(color: red) }");
  EXPECT_EQ(repaired("sphere { material: diffuse(color: red }) radius: 1").codes,
            std::vector<std::string>{"E001"});
}

TEST(SceneRepair, AddsMarksBetweenValues) {
  const Repaired result = repaired("let a = f(1 2, [3 4], (5, 6), b: 7, c 8)");
  EXPECT_EQ(result.text, "let a = f(1, 2, [3, 4], (5, 6, 0), b: 7, c: 8)");
  EXPECT_EQ(result.codes.size(), 4u);
}

TEST(SceneRepair, KnowsMisspeltWordsOfTheLanguage) {
  EXPECT_EQ(repaired("lte a = 1\nfro i in list { }\nif a { } esle { }").text,
            "let a = 1\nfor i in list { }\nif a { } else { }");
}

TEST(SceneRepair, KnowsSignsOfOtherLanguages) {
  EXPECT_EQ(repaired("let a = b && !c || d ** 2 <> e").text,
            "let a = b  and  not c  or  d ^ 2 != e");
  EXPECT_EQ(repaired("sphere { radius = 1 }").text, "sphere { radius: 1 }");
}

TEST(SceneRepair, KnowsWhereInTheFileItsBytesAre) {
  const std::string text = "f(1 2) g";
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  const RepairedText result = repair(file, sink);
  ASSERT_EQ(result.text(), "f(1, 2) g");
  for (std::uint32_t i = 0; i < result.text().size(); ++i) {
    if (result.is_added(i)) continue;
    EXPECT_EQ(result.text()[i], text[result.in_source(i)]);
  }
  EXPECT_TRUE(result.is_added(3));
}

}  // namespace
}  // namespace sdlc::lang
