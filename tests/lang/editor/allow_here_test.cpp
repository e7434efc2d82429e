#include "lang/editor/allow_here.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "lang/format/format.hpp"
#include "lang/lint/linted_text.hpp"
#include "tests/support/case_flags/case_flags.hpp"
#include "tests/support/file_test.hpp"

namespace sdlc::test {
namespace {

/// The text after the edit for a warning at the mark `|`.
std::string allowed(std::string text, const lang::DiagnosticInfo& info = lang::diag::zero_radius) {
  const std::size_t at = text.find('|');
  text.erase(at, 1);
  const lang::Document document("ball.scene", text);
  const auto edit = lang::allow_here(document, info, static_cast<std::uint32_t>(at));
  return edit ? lang::with_edits(text, std::span(&*edit, 1)) : "";
}

TEST(AllowHere, AddsALineBeforeTheStatement) {
  EXPECT_EQ(allowed("scene 1\nsphere { radius: |0 }\n"),
            "scene 1\n// sdlc: allow(W402)\nsphere { radius: 0 }\n");
}

TEST(AllowHere, KeepsTheIndentation) {
  EXPECT_EQ(allowed("scene 1\ngroup {\n\t  sphere { radius: |0 }\n}\n"),
            "scene 1\ngroup {\n\t  // sdlc: allow(W402)\n\t  sphere { radius: 0 }\n}\n");
  EXPECT_EQ(allowed("scene 1\nsphere {\n  center: (0, 0, 0)\n  radius: |0\n}\n"),
            "scene 1\nsphere {\n  center: (0, 0, 0)\n  // sdlc: allow(W402)\n  radius: 0\n}\n");
}

TEST(AllowHere, KeepsTheLineEnds) {
  EXPECT_EQ(allowed("scene 1\r\nsphere { radius: |0 }\r\n"),
            "scene 1\r\n// sdlc: allow(W402)\r\nsphere { radius: 0 }\r\n");
}

TEST(AllowHere, IsBeforeTheDocCommentsOfTheStatement) {
  EXPECT_EQ(allowed("scene 1\n\n/// A ball,\n/// a small one.\nsphere { radius: |0 }\n"),
            "scene 1\n\n// sdlc: allow(W402)\n/// A ball,\n/// a small one.\nsphere { radius: 0 "
            "}\n");
  EXPECT_EQ(allowed("scene 1\n/// The file.\n\nsphere { radius: |0 }\n"),
            "scene 1\n/// The file.\n\n// sdlc: allow(W402)\nsphere { radius: 0 }\n");
}

TEST(AllowHere, AddsTheCodeToTheCommentOfTheStatement) {
  EXPECT_EQ(allowed("scene 1\n// sdlc: allow( S601 ) for now\nsphere { radius: |0 }\n"),
            "scene 1\n// sdlc: allow( S601, W402 ) for now\nsphere { radius: 0 }\n");
  EXPECT_EQ(allowed("scene 1\nsphere { radius: |0 }  // sdlc: allow(S601, S602)\n"),
            "scene 1\nsphere { radius: 0 }  // sdlc: allow(S601, S602, W402)\n");
}

TEST(AllowHere, IgnoresCommentsOfAnotherForm) {
  EXPECT_EQ(allowed("scene 1\n// sdlc: allow S601\nsphere { radius: |0 }\n"),
            "scene 1\n// sdlc: allow S601\n// sdlc: allow(W402)\nsphere { radius: 0 }\n");
}

TEST(AllowHere, IsAfterAStatementThatEndsTheLine) {
  EXPECT_EQ(allowed("scene 1\nsphere { radius: 1 } sphere { radius: |0 }\n"),
            "scene 1\nsphere { radius: 1 } sphere { radius: 0 }  // sdlc: allow(W402)\n");
  EXPECT_EQ(allowed("scene 1\nsphere { radius: 1 } sphere { radius: |0 } // here\n"),
            "scene 1\nsphere { radius: 1 } sphere { radius: 0 } // sdlc: allow(W402) // here\n");
  EXPECT_EQ(allowed("scene 1\nsphere { radius: 1 } sphere { radius: |0 }"),
            "scene 1\nsphere { radius: 1 } sphere { radius: 0 }  // sdlc: allow(W402)");
}

TEST(AllowHere, BreaksTheLineOfAStatementBetweenOthers) {
  EXPECT_EQ(allowed("scene 1\ngroup {\n  sphere {} sphere { radius: |0 } sphere {}\n}\n"),
            "scene 1\ngroup {\n  sphere {}\n  // sdlc: allow(W402)\n  sphere { radius: 0 } sphere "
            "{}\n}\n");
}

TEST(AllowHere, IsNothingWhereNothingCanBeAllowed) {
  EXPECT_EQ(allowed("sc|ene 1\n"), "");
  EXPECT_EQ(allowed("scene 1\n|"), "");
  EXPECT_EQ(allowed("|"), "");
  EXPECT_EQ(allowed("scene 1\nsphere { radius: |0 }\n", lang::diag::unknown_property), "");
  EXPECT_EQ(allowed("scene 1\n// sdlc: |allow(W402)\n", lang::diag::unused_allowance), "");
  const lang::Document config("a.json", "{\"objects\": []}");
  EXPECT_FALSE(lang::allow_here(config, lang::diag::zero_radius, 3));
}

/// A finding without its place, since an edit moves places.
using Known = std::tuple<std::string_view, std::string, std::string>;

std::multimap<Known, const lang::Diagnostic*> findings_of(const lang::LintedText& linted) {
  std::multimap<Known, const lang::Diagnostic*> all;
  for (const lang::Diagnostic* found : linted.findings().shown) {
    const auto& [file, span] = found->where;
    const std::string text(file == nullptr ? "" : file->text(span));
    all.emplace(Known{found->info->code, found->message, text}, found);
  }
  return all;
}

class AllowHereFiles : public testing::TestWithParam<FileCase> {
 protected:
  std::unique_ptr<lang::LintedText> lint(std::string text) {
    return std::make_unique<lang::LintedText>(
        std::make_shared<const lang::Document>("case.scene", std::move(text)),
        program_options(GetParam(), workspace_), lang::FindingsFilter{.max_per_severity = 10'000});
  }

 private:
  CaseFiles files_{GetParam()};
  lang::Workspace workspace_{files_};
};

/// Each warning of the text can be allowed, one after the other, and nothing else is reported.
TEST_P(AllowHereFiles, SilencesEveryWarning) {
  std::string text = GetParam().texts.front().text();
  if (text.starts_with("{")) GTEST_SKIP() << "a config";
  for (int edits = 0; edits < 100; ++edits) {
    const auto linted = lint(text);
    const auto before = findings_of(*linted);
    bool is_changed = false;
    for (const auto& [known, found] : before) {
      if (found->where.file != &linted->file()) continue;
      const auto* document = dynamic_cast<const lang::Document*>(found->where.file);
      const auto edit = lang::allow_here(*document, *found->info, found->where.span.begin);
      if (!edit) continue;
      const std::string edited = lang::with_edits(text, std::span(&*edit, 1));
      const auto after_text = lint(edited);
      const auto after = findings_of(*after_text);
      EXPECT_LT(after.count(known), before.count(known)) << std::get<0>(known) << edited;
      for (const auto& [left, where] : after) {
        EXPECT_TRUE(before.contains(left)) << where->message << edited;
      }
      text = edited;
      is_changed = true;
      break;
    }
    if (!is_changed) break;
  }
  const auto linted = lint(text);
  for (const lang::Diagnostic* found : linted->findings().shown) {
    const std::string_view code = found->info->code;
    const bool has_place = found->where.file == &linted->file();
    EXPECT_TRUE(!has_place || code == "S604" || code == "S605" ||
                found->info->severity == lang::Severity::Error)
        << code << " " << found->message << "\n"
        << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Lint, AllowHereFiles, testing::ValuesIn(load_cases("lint")), CaseName());

}  // namespace
}  // namespace sdlc::test
