#include "lang/editor/fix_edits.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/diagnostics/fixes.hpp"
#include "lang/lint/linted_text.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

const std::string kCamera = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

/// The first quick fix of a text; its title and the text after it.
struct Fixed {
  std::string title, text;
  bool is_preferred = false;
};

std::vector<Fixed> quick_fixes(const std::string& text) {
  const auto document = std::make_shared<const lang::Document>("ball.scene", text);
  const lang::LintedText linted(document);
  lang::QuickFixes fixes;
  std::vector<Fixed> all;
  for (const lang::Diagnostic* found : linted.findings().shown) {
    const auto fix = fixes.of(*found);
    if (!fix) continue;
    EXPECT_EQ(fix->files.size(), 1u);
    all.push_back({.title = fix->title,
                   .text = lang::with_edits(text, fix->files.front().edits),
                   .is_preferred = fix->is_preferred});
  }
  return all;
}

TEST(QuickFixes, ReplaceAWord) {
  const auto fixes = quick_fixes("scene 1\nsphere { center: (0, 0, 0), radus: 1 }\n");
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].title, "Replace `radus` with `radius`");
  EXPECT_EQ(fixes[0].text, "scene 1\nsphere { center: (0, 0, 0), radius: 1 }\n");
  EXPECT_FALSE(fixes[0].is_preferred);
}

TEST(QuickFixes, InsertAndRemoveSigns) {
  const auto comma = quick_fixes("scene 1\nlet a = [1 2]\n");
  ASSERT_FALSE(comma.empty());
  EXPECT_EQ(comma[0].title, "Insert `,`");
  EXPECT_EQ(comma[0].text, "scene 1\nlet a = [1, 2]\n");
  const auto semicolon = quick_fixes("scene 1\nlet a = 1;\n");
  ASSERT_FALSE(semicolon.empty());
  EXPECT_EQ(semicolon[0].title, "Remove `;`");
  EXPECT_TRUE(semicolon[0].is_preferred);
  const auto space = quick_fixes("scene 1\nlet a = 2 m\n");
  ASSERT_FALSE(space.empty());
  EXPECT_EQ(space[0].text, "scene 1\nlet a = 2m\n");
}

TEST(QuickFixes, AreNotPreferredWhereLintWouldRefuseThem) {
  for (const Fixed& fix : quick_fixes("scene 1\nlet a = 'it's' \n")) {
    EXPECT_FALSE(fix.is_preferred) << fix.title;
  }
}

TEST(QuickFixes, HaveOneLineTitlesAndDisjointEdits) {
  std::size_t count = 0;
  for (const char* folder : {"syntax", "mistakes", "lint"}) {
    for (const FileCase& file_case : load_cases(folder)) {
      for (const Fixed& fix : quick_fixes(file_case.texts.front().text())) {
        EXPECT_EQ(fix.title.find('\n'), std::string::npos) << fix.title;
        EXPECT_LT(fix.title.size(), 500u) << fix.title;
        EXPECT_TRUE(fix.title[0] >= 'A' && fix.title[0] <= 'Z') << fix.title;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 100u);
}

TEST(QuickFixes, OfOneDiagnosticAreOneAction) {
  const lang::SourceFile a("a.scene", "let x = y\n"), b("b.scene", "x\n");
  lang::Diagnostic diagnostic;
  diagnostic.fixes = {{.where = {&a, {8, 9}}, .replacement = "z", .is_safe = true},
                      {.where = {&a, {0, 3}}, .replacement = "param", .is_safe = true},
                      {.where = {&b, {0, 0}}, .replacement = "scene 1\n", .is_safe = true},
                      {.where = {&b, {1, 2}}, .replacement = "", .is_safe = true}};
  const auto fix = lang::QuickFixes().of(diagnostic);
  EXPECT_EQ(fix->title, "Replace `y` with `z`, replace `let` with `param`, …");
  ASSERT_EQ(fix->files.size(), 2u);
  EXPECT_EQ(lang::with_edits(a.text(), fix->files[0].edits), "param x = z\n");
  EXPECT_EQ(lang::with_edits(b.text(), fix->files[1].edits), "scene 1\nx");
  EXPECT_TRUE(fix->is_preferred);
}

TEST(QuickFixes, CountEqualChanges) {
  const lang::SourceFile file("a.scene", "a a\n");
  lang::Diagnostic diagnostic;
  diagnostic.fixes = {{.where = {&file, {0, 1}}, .replacement = "b"},
                      {.where = {&file, {2, 3}}, .replacement = "b"}};
  EXPECT_EQ(lang::QuickFixes().of(diagnostic)->title, "Replace `a` with `b` in 2 places");
  EXPECT_FALSE(lang::QuickFixes().of({}));
}

/// The action for all findings like the first that has a fix.
std::optional<lang::QuickFix> everywhere(const lang::LintedText& linted) {
  for (const lang::Diagnostic* found : linted.findings().shown) {
    if (!found->fixes.empty()) return lang::fix_everywhere(*found, linted.findings().shown);
  }
  return std::nullopt;
}

TEST(FixEverywhere, FixesTheSameMistakeInTheWholeFile) {
  const std::string text =
      "scene 1\n" + kCamera +
      "sphere { center: (0, 0, 0), radus: 1 }\nsphere { center: (0, 3, 0), radus: 2 }\n"
      "sphere { center: (0, 6, 0), raduis: 2 }\nsphere { center: (0, 9, 0), radus: 3 }\n";
  const lang::LintedText linted(std::make_shared<const lang::Document>("ball.scene", text));
  const auto fix = everywhere(linted);
  ASSERT_TRUE(fix);
  EXPECT_EQ(fix->title, "Replace all `radus` with `radius` in this file (3 places)");
  EXPECT_FALSE(fix->is_preferred);
  ASSERT_EQ(fix->files.size(), 1u);
  EXPECT_EQ(
      lang::with_edits(text, fix->files[0].edits),
      "scene 1\n" + kCamera +
          "sphere { center: (0, 0, 0), radius: 1 }\nsphere { center: (0, 3, 0), radius: 2 }\n"
          "sphere { center: (0, 6, 0), raduis: 2 }\nsphere { center: (0, 9, 0), radius: 3 }\n");
}

TEST(FixEverywhere, RemovesTheSameSign) {
  const lang::LintedText linted(
      std::make_shared<const lang::Document>("a.scene", "scene 1\nlet a = 1;\nlet b = 2;\n"));
  EXPECT_EQ(everywhere(linted)->title, "Remove all `;` in this file (2 places)");
}

TEST(FixEverywhere, IsNotForOneMistakeOrForOthersOfTheSameText) {
  for (const char* rest :
       {"sphere { radus: 1 }\n", "sphere { radus: 1 }\nlet a = radus\n",
        "sphere { radus: 1 }\nsphere { Radus: 1 }\n", "let a = [1 2]\nlet b = [1 2]\n"}) {
    const lang::LintedText linted(
        std::make_shared<const lang::Document>("a.scene", "scene 1\n" + std::string(rest)));
    EXPECT_FALSE(everywhere(linted)) << rest;
  }
}

TEST(FixEverywhere, KeepsToTheFileOfTheFinding) {
  const lang::SourceFile a("a.scene", "x x"), b("b.scene", "x x");
  lang::Diagnostic in_a, in_b;
  in_a.fixes = {{.where = {&a, {0, 1}}, .replacement = "y"}};
  in_b.fixes = {{.where = {&b, {0, 1}}, .replacement = "y"}};
  const std::vector<const lang::Diagnostic*> both{&in_a, &in_b}, twice{&in_a, &in_a};
  EXPECT_FALSE(lang::fix_everywhere(in_a, both));
  EXPECT_FALSE(lang::fix_everywhere(in_a, twice));
}

lang::FixAll fix_all(const std::string& text, const lang::FindingsFilter& filter = {}) {
  const auto check = [&](std::string each) {
    return std::make_unique<lang::LintedText>(
        std::make_shared<const lang::Document>("ball.scene", std::move(each)),
        lang::ProgramOptions{}, filter);
  };
  return lang::fix_all(check(text), check);
}

TEST(FixAll, AppliesTheSafeFixesUntilNoneIsLeft) {
  const std::string text =
      "scene 1\n" + kCamera + "let spare = 1;\nsphere { center = (0, 0, 0), radus: 1 }\n";
  const lang::FixAll fixed = fix_all(text);
  EXPECT_EQ(lang::with_edits(text, fixed.edits),
            "scene 1\n" + kCamera + "let spare = 1\nsphere { center: (0, 0, 0), radus: 1 }\n");
  EXPECT_EQ(fixed.applied, 2u);
  EXPECT_EQ(fixed.edits.size(), 2u);
}

TEST(FixAll, KeepsFindingsThatAreNotWanted) {
  const auto none = [](const lang::DiagnosticInfo&, const lang::SourceFile*) { return false; };
  EXPECT_TRUE(fix_all("scene 1\nlet spare = 1;\n", {.is_wanted = none}).edits.empty());
}

}  // namespace
}  // namespace sdlc::test
