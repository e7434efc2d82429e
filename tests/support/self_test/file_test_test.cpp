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
  const lang::SourceFile file("a", file_case.texts[0].text());
  lang::DiagnosticSink sink;
  const lang::Location where{&file, {begin, end}};
  sink.report(lang::diag::bad_utf8, where).fix(where, std::string(fix));
  return remarks_of(sink, file_case, "a");
}

TEST(FileTest, SeparatesTextAndExpectations) {
  const auto cases = parse_cases(kFile, "a.txt");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].name, "first");
  EXPECT_EQ(cases[0].texts[0].text(), "one two\n// a comment\n");
  EXPECT_EQ(cases[0].expected[0], (Remark{1, 5, 3, "E007", "the text is not valid UTF-8 here"}));
  EXPECT_EQ(cases[1].texts[0].text(), "é\xff x\n");
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

constexpr std::string_view kSeveral =
    "--- first ---\n"
    "one two\n"
    "//  ^^^ label: below\n"
    "\n"
    "=== lib/other.scene ===\n"
    "three\n"
    "// @1+5 E007: the text is not valid UTF-8 here\n"
    "// help: save the file as UTF-8\n"
    "=== --set count ===\n"
    "12\n"
    "// @1+2 chain: 1 in `f`\n"
    "\n"
    "--- second ---\n"
    "=== lib/other.scene ===\n"
    "four\n";

/// "three" in the case's other file is wrong, as reported in a call by the flag's text.
std::vector<Remark> remarks_of_several(const FileCase& file_case, std::string_view other_name) {
  const lang::SourceFile first("root.scene", file_case.texts[0].text());
  const lang::SourceFile other(std::string(other_name), file_case.texts[1].text());
  const lang::SourceFile flag("--set count", "12");
  lang::DiagnosticSink sink;
  sink.report(lang::diag::bad_utf8, {&other, {0, 5}})
      .label({&first, {4, 7}}, "below")
      .help("save the file as UTF-8")
      .chain({{{&flag, {0, 2}}, "in `f`"}});
  return remarks_of(sink, file_case, "root.scene");
}

TEST(FileTest, ReadsSeveralTextsOfACase) {
  const auto cases = parse_cases(kSeveral, "a.txt");
  ASSERT_EQ(cases.size(), 2u);
  ASSERT_EQ(cases[0].texts.size(), 3u);
  EXPECT_EQ(cases[0].texts[0].text(), "one two\n");
  EXPECT_EQ(cases[0].texts[1].name, "lib/other.scene");
  EXPECT_EQ(cases[0].texts[1].text(), "three\n");
  EXPECT_FALSE(cases[0].texts[1].is_flag());
  EXPECT_TRUE(cases[0].texts[2].is_flag());
  EXPECT_EQ(cases[0].texts[2].text(), "12\n");
  EXPECT_EQ(cases[0].expected[1], (Remark{1, 1, 5, "E007", "the text is not valid UTF-8 here", 1}));
  EXPECT_EQ(cases[1].texts[0].text(), "");
}

TEST(FileTest, GivesTheOtherTextsAsFiles) {
  const auto cases = parse_cases(kSeveral, "a.txt");
  const CaseFiles files(cases[0]);
  std::error_code error;
  EXPECT_EQ(files.read("lib/other.scene", UINT64_MAX, error), "three\n");
  EXPECT_FALSE(error);
  for (const char* name : {"", "other.scene", "--set count"}) {
    error.clear();
    EXPECT_EQ(files.read(name, UINT64_MAX, error), std::nullopt) << name;
    EXPECT_EQ(error, std::errc::no_such_file_or_directory) << name;
  }
}

TEST(FileTest, ExpectsEachRemarkInItsOwnText) {
  const FileCase file_case = parse_cases(kSeveral, "a.txt").at(0);
  EXPECT_EQ(compare(file_case, remarks_of_several(file_case, "lib/other.scene")), "");
  EXPECT_EQ(
      replace_expectations(kSeveral, file_case, remarks_of_several(file_case, "lib/other.scene")),
      kSeveral);
  // Remarks about none of the texts are at the beginning of the first.
  const std::string problems = compare(file_case, remarks_of_several(file_case, "elsewhere.scene"));
  EXPECT_NE(problems.find("expected, but not reported at line 1 of lib/other.scene"),
            std::string::npos)
      << problems;
  EXPECT_NE(problems.find("reported, but not expected at line 1 of the case"), std::string::npos)
      << problems;
}

TEST(FileTest, ComparesTheNumbersOfAChainsLinks) {
  FileCase file_case = parse_cases(kSeveral, "a.txt").at(0);
  file_case.expected.back().message = "2 in `f`";
  EXPECT_NE(compare(file_case, remarks_of_several(file_case, "lib/other.scene")), "");
}

TEST(FileTest, PlacesWhatIsAboutNoTextEvenInAnEmptyCase) {
  const FileCase file_case{.file = "a.txt", .name = "empty"};
  lang::DiagnosticSink sink;
  sink.report(lang::diag::unknown_param, {}, "count");
  const auto remarks = remarks_of(sink, file_case, "root.scene");
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0].line, 0u);
  EXPECT_NE(compare(file_case, remarks), "");
}

}  // namespace
}  // namespace sdlc::test
