#include "cli/unified_diff.hpp"

#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using cli::unified_diff;

TEST(UnifiedDiff, OfTheSameTextsIsEmpty) { EXPECT_EQ(unified_diff("f", "a\nb\n", "a\nb\n"), ""); }

TEST(UnifiedDiff, ShowsThreeLinesAroundAChange) {
  EXPECT_EQ(unified_diff("f", "1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nx\n6\n7\n8\n9\n"),
            "--- f\n+++ f\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+x\n 6\n 7\n 8\n");
}

TEST(UnifiedDiff, JoinsChangesThatAreNear) {
  EXPECT_EQ(unified_diff("f", "a\n1\n2\n3\n4\n5\n6\nb\n", "x\n1\n2\n3\n4\n5\n6\ny\n"),
            "--- f\n+++ f\n@@ -1,8 +1,8 @@\n-a\n+x\n 1\n 2\n 3\n 4\n 5\n 6\n-b\n+y\n");
  EXPECT_EQ(unified_diff("f", "a\n1\n2\n3\n4\n5\n6\n7\nb\n", "x\n1\n2\n3\n4\n5\n6\n7\ny\n"),
            "--- f\n+++ f\n@@ -1,4 +1,4 @@\n-a\n+x\n 1\n 2\n 3\n"
            "@@ -6,4 +6,4 @@\n 5\n 6\n 7\n-b\n+y\n");
}

TEST(UnifiedDiff, ReportsAMissingLineEnd) {
  EXPECT_EQ(unified_diff("f", "a", "a\n"),
            "--- f\n+++ f\n@@ -1 +1 @@\n-a\n\\ No newline at end of file\n+a\n");
}

TEST(UnifiedDiff, OfAnEmptyTextIsAfterLineZero) {
  EXPECT_EQ(unified_diff("f", "", "a\nb\n"), "--- f\n+++ f\n@@ -0,0 +1,2 @@\n+a\n+b\n");
}

TEST(UnifiedDiff, FindsWhatStaysAmongRepeatedLines) {
  EXPECT_EQ(unified_diff("f", "}\n}\na\n}\n", "}\n}\n}\n}\n"),
            "--- f\n+++ f\n@@ -1,4 +1,4 @@\n }\n }\n-a\n+}\n }\n");
}

/// A text of a few different lines, so that they repeat, with or without a final line end.
std::string random_text(std::uint64_t& state, bool has_end) {
  std::string text;
  const auto next = [&] {
    return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33;
  };
  for (std::uint64_t lines = next() % 40; lines > 0; --lines) {
    text += "line " + std::to_string(next() % 12) + (next() % 9 == 0 ? "\r\n" : "\n");
  }
  if (!has_end && !text.empty()) text.pop_back();
  return text;
}

TEST(UnifiedDiff, NamesAFileSoThatPatchFindsIt) {
  EXPECT_TRUE(unified_diff("a b", "x", "y").starts_with("--- a b\t\n+++ a b\t\n"));
  EXPECT_TRUE(unified_diff("a\"\n", "x", "y").starts_with("--- \"a\\\"\\012\"\n"));
  const TemporaryFolder folder;
  if (!has_program("patch")) GTEST_SKIP() << "no patch here";
  for (const char* name : {"a b.scene", " a.scene", "a\tb.scene", "a\"b\\.scene", "é b.scene",
                           "a'b (1).scene", "a\nb.scene"}) {
    write_text(folder / name, "x\n");
    write_text(folder / "diff", unified_diff(name, "x\n", "y\n"));
    const ProgramResult result =
        run_shell(folder.path(), "patch -p0 -s --no-backup-if-mismatch <diff");
    EXPECT_EQ(result.exit_code, 0) << name << result.out;
    EXPECT_EQ(content_of(folder / name), "y\n") << name;
  }
}

TEST(UnifiedDiff, IsWhatPatchReads) {
  const TemporaryFolder folder;
  if (!has_program("patch")) GTEST_SKIP() << "no patch here";
  std::uint64_t state = 1;
  for (int i = 0; i < 60; ++i) {
    const std::string before = random_text(state, i % 3 != 0);
    const std::string after = random_text(state, i % 4 != 0);
    write_text(folder / "f", before);
    write_text(folder / "diff", unified_diff("f", before, after));
    const ProgramResult result =
        run_shell(folder.path(), "patch -p0 -s --binary --no-backup-if-mismatch <diff");
    EXPECT_EQ(result.exit_code, 0) << result.out;
    const bool is_gone = after.empty() && !std::filesystem::exists(folder / "f");
    EXPECT_EQ(is_gone ? "" : content_of(folder / "f"), after) << content_of(folder / "diff");
  }
}

}  // namespace
}  // namespace sdlc::test
