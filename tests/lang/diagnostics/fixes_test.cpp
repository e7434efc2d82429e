#include "lang/diagnostics/fixes.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/report/findings.hpp"

namespace sdlc::lang {
namespace {

class ApplyFixes : public testing::Test {
 protected:
  DiagnosticBuilder report(std::uint32_t begin, std::uint32_t end) {
    return sink_.report(diag::zero_radius, at(begin, end));
  }
  Location at(std::uint32_t begin, std::uint32_t end) const { return {&file_, {begin, end}}; }
  FixedText apply(bool applies_unsafe = false) {
    return apply_fixes(file_, select_findings(sink_).shown, applies_unsafe);
  }

  SourceFile file_{"a.scene", "one two three"};
  DiagnosticSink sink_;
};

TEST_F(ApplyFixes, ReplacesInsertsAndRemoves) {
  report(8, 13).fix(at(8, 13), "3");
  report(4, 7).fix(at(3, 7), "");
  report(0, 3).fix(at(0, 0), "[");
  const FixedText fixed = apply();
  EXPECT_EQ(fixed.text, "[one 3");
  EXPECT_EQ(fixed.applied, 3u);
}

TEST_F(ApplyFixes, LeavesGuessesAloneUnlessAskedForThem) {
  report(0, 3).suggest("One");
  report(4, 7).unsafe_fix(at(4, 7), "2");
  EXPECT_EQ(apply().text, "one two three");
  EXPECT_EQ(apply().applied, 0u);
  EXPECT_EQ(apply(true).text, "One 2 three");
}

TEST_F(ApplyFixes, TakesTheFirstOfThoseThatTouch) {
  report(0, 3).fix(at(0, 5), "A");
  report(4, 7).fix(at(5, 7), "B");
  report(8, 13).fix(at(8, 13), "C");
  EXPECT_EQ(apply().text,
            "A"
            "wo C");
  EXPECT_EQ(apply().applied, 2u);
}

TEST_F(ApplyFixes, AppliesAllFixesOfADiagnosticOrNone) {
  report(0, 3).fix(at(0, 3), "1").unsafe_fix(at(8, 13), "3");
  EXPECT_EQ(apply().text, "one two three");
  EXPECT_EQ(apply(true).text, "1 two 3");
}

TEST_F(ApplyFixes, SeesALaterFixBetweenThoseOfAnEarlierDiagnostic) {
  report(0, 3).fix(at(0, 3), "1").fix(at(8, 13), "3");
  report(4, 7).fix(at(4, 7), "2");
  report(8, 9).fix(at(9, 10), "X");
  EXPECT_EQ(apply().text, "1 2 3");
  EXPECT_EQ(apply().applied, 2u);
}

TEST_F(ApplyFixes, LeavesOtherFilesAlone) {
  const SourceFile other("b.scene", "x");
  sink_.report(diag::zero_radius, {&other, {0, 1}}).fix({&other, {0, 1}}, "y");
  EXPECT_EQ(apply().text, "one two three");
}

}  // namespace
}  // namespace sdlc::lang
