#include "tests/support/file_test.hpp"

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

constexpr std::string_view kFile =
    "about the file\n"
    "--- first ---\n"
    "one two\n"
    "//  ^^^ E007: the text is not valid UTF-8 here\n"
    "//  ^^^ fix: `zwei`\n"
    "// a comment\n"
    "\n"
    "--- second ---\n"
    "é⟦FF⟧ x\n";

FileCase first_case() { return parse_cases(kFile, "a.txt").at(0); }

/// The remarks about a text in which "two" is wrong from `begin` to `end`.
std::vector<Remark> remarks_at(std::uint32_t begin, std::uint32_t end, std::string_view fix) {
  const FileCase file_case = first_case();
  const lang::SourceFile file("a", file_case.text());
  lang::DiagnosticSink sink;
  const lang::Location where{&file, {begin, end}};
  sink.report(lang::diag::bad_utf8, where).fix(where, std::string(fix));
  return remarks_of(sink, file_case);
}

TEST(FileTest, SeparatesTextAndExpectations) {
  const auto cases = parse_cases(kFile, "a.txt");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "first");
  EXPECT_EQ(cases[0].text(), "one two\n// a comment\n");
  EXPECT_EQ(cases[0].expected[0], (Remark{1, 5, 3, "E007", "the text is not valid UTF-8 here"}));
  EXPECT_EQ(cases[1].text(), "é\xff x\n");
  EXPECT_TRUE(cases[1].expected.empty());
}

TEST(FileTest, PassesWhatIsExpected) {
  EXPECT_EQ(compare(first_case(), remarks_at(4, 7, "zwei")), "");
}

TEST(FileTest, FailsWhatIsElsewhereOrElse) {
  EXPECT_NE(compare(first_case(), remarks_at(3, 7, "zwei")), "");
  EXPECT_NE(compare(first_case(), remarks_at(4, 6, "zwei")), "");
  EXPECT_NE(compare(first_case(), remarks_at(4, 7, "drei")), "");
}

TEST(FileTest, FailsWhatIsMissingOrTooMuch) {
  EXPECT_NE(compare(first_case(), {}), "");
  auto twice = remarks_at(4, 7, "zwei");
  twice.push_back(twice.front());
  EXPECT_NE(compare(first_case(), twice), "");
  EXPECT_NE(compare(parse_cases(kFile, "").at(1), remarks_at(4, 7, "")), "");
}

TEST(FileTest, RewritesOnlyTheExpectationsOfItsCase) {
  EXPECT_EQ(replace_expectations(kFile, first_case(), remarks_at(4, 7, "zwei")), kFile);
  EXPECT_EQ(replace_expectations(kFile, first_case(), remarks_at(0, 3, "")),
            "about the file\n"
            "--- first ---\n"
            "one two\n"
            "// @1+3 E007: the text is not valid UTF-8 here\n"
            "// @1+3 fix: ``\n"
            "// a comment\n"
            "\n"
            "--- second ---\n"
            "é⟦FF⟧ x\n");
}

}  // namespace
}  // namespace sdlc::test
