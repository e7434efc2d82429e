#include "lang/report/findings.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(Findings, AreSortedByFileAndThenByPlace) {
  const SourceFile a("a", "text"), b("b", "text");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&b, {3, 4}});
  sink.report(diag::bad_utf8, {&a, {2, 3}});
  sink.report(diag::bad_utf8, {&b, {0, 1}});
  const Findings findings = select_findings(sink);
  EXPECT_EQ(findings.shown[0]->where.file, &b);
  EXPECT_EQ(findings.shown[0]->where.span.begin, 0u);
  EXPECT_EQ(findings.shown[1]->where.span.begin, 3u);
  EXPECT_EQ(findings.shown[2]->where.file, &a);
}

TEST(Findings, ShowTheFirstFiftyByPlaceAndCountTheRest) {
  const SourceFile file("a", "text");
  DiagnosticSink sink;
  for (std::uint32_t i = 60; i > 0; --i) sink.report(diag::bad_utf8, {&file, {i, i + 1}});
  sink.report(diag::zero_radius, {&file, {0, 1}});
  const Findings findings = select_findings(sink);
  EXPECT_EQ(findings.counts, (DiagnosticCounts{.errors = 60, .warnings = 1, .omitted = 10}));
  EXPECT_EQ(findings.shown.size(), 51u);
  EXPECT_EQ(findings.shown[1]->where.span.begin, 1u);
  EXPECT_EQ(findings.shown.back()->where.span.begin, 50u);
}

TEST(Findings, CountWhatTheSinkDidNotKeep) {
  const SourceFile file("a", "text");
  DiagnosticSink sink;
  constexpr std::size_t kErrors = DiagnosticSink::kMaxErrors + 3;
  for (std::uint32_t i = 0; i < kErrors; ++i) sink.report(diag::bad_utf8, {&file, {i, i + 1}});
  EXPECT_EQ(select_findings(sink, {.max_per_severity = kErrors}).counts,
            (DiagnosticCounts{.errors = kErrors, .warnings = 0, .omitted = 3}));
  const auto is_wanted = [](const DiagnosticInfo& info, const SourceFile*) {
    return info.code == "E101";
  };
  EXPECT_EQ(select_findings(sink, {.is_wanted = is_wanted}).counts, DiagnosticCounts{});
}

TEST(Findings, PassTheFilter) {
  const SourceFile file("a", "text"), other("b", "text");
  DiagnosticSink sink;
  sink.report(diag::unknown_name, {&file, {1, 2}}, "a");
  sink.report(diag::unknown_name, {&other, {1, 2}}, "a");
  sink.report(diag::bad_utf8, {&file, {2, 3}});
  sink.report(diag::zero_radius, {&file, {3, 4}});
  const auto is_wanted = [&](const DiagnosticInfo& info, const SourceFile* where) {
    return where == &file && info.code != "E007";
  };
  const auto is_allowed = [](const DiagnosticInfo&, Location) { return true; };
  const Findings findings =
      select_findings(sink, {.is_wanted = is_wanted, .is_allowed = is_allowed});
  ASSERT_EQ(findings.shown.size(), 1u);  // errors cannot be allowed
  EXPECT_EQ(findings.shown[0]->info->code, "E101");
  EXPECT_EQ(findings.counts, (DiagnosticCounts{.errors = 1, .warnings = 0, .omitted = 0}));
}

}  // namespace
}  // namespace sdlc::lang
