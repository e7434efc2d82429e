#include "lang/diagnostics/diagnostics.hpp"

#include <set>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(Diagnostics, CodesAndNamesAreUsedOnce) {
  std::set<std::string_view> seen;
  for (const DiagnosticInfo* info : all_diagnostics()) {
    EXPECT_TRUE(seen.insert(info->code).second) << info->code;
    EXPECT_TRUE(seen.insert(info->name).second) << info->name;
    EXPECT_EQ(info->code[0] == 'E', info->severity == Severity::Error) << info->code;
    EXPECT_FALSE(info->message.ends_with('.')) << info->code;
  }
}

TEST(DiagnosticSink, KeepsTheFirstFiftyAndCountsTheRest) {
  const SourceFile file("a", "text");
  DiagnosticSink sink;
  for (std::uint32_t i = 0; i < 60; ++i) {
    sink.report(diag::bad_utf8, {&file, {i, i + 1}}).help("say it");
  }
  sink.report(diag::zero_radius, {&file, {0, 1}});
  EXPECT_EQ(sink.counts(), (DiagnosticCounts{.errors = 60, .warnings = 1, .omitted = 10}));
  EXPECT_EQ(sink.diagnostics().size(), 51u);
}

TEST(DiagnosticSink, KeepsWhatIsWantedAndKnowsOfOtherErrors) {
  const SourceFile file("a", "text");
  DiagnosticSink sink;
  sink.set_filter([](const DiagnosticInfo& info) { return info.code == "E101"; });
  sink.report(diag::bad_utf8, {&file, {0, 1}}).help("lost");
  EXPECT_TRUE(sink.has_errors());
  EXPECT_EQ(sink.counts(), DiagnosticCounts{});
  sink.report(diag::unknown_name, {&file, {1, 2}}, "a");
  sink.report(diag::zero_radius, {&file, {1, 2}});
  EXPECT_EQ(sink.counts(), (DiagnosticCounts{.errors = 1, .warnings = 0, .omitted = 0}));
  EXPECT_EQ(sink.diagnostics().size(), 1u);
}

TEST(DiagnosticSink, TellsTheSameOfOnePlaceOnce) {
  const SourceFile file("a", "text"), other("b", "text");
  DiagnosticSink sink;
  for (int i = 0; i < 3; ++i) sink.report(diag::unknown_name, {&file, {0, 1}}, "a").help("say it");
  sink.report(diag::unknown_name, {&file, {0, 1}}, "b");
  sink.report(diag::unknown_name, {&file, {0, 2}}, "a");
  sink.report(diag::unknown_name, {&other, {0, 1}}, "a");
  EXPECT_EQ(sink.error_count(), 4u);
  EXPECT_EQ(sink.diagnostics().front().help.size(), 1u);

  sink.forget_shown();
  EXPECT_FALSE(sink.has_errors());
  sink.report(diag::unknown_name, {&file, {0, 1}}, "a");
  EXPECT_TRUE(sink.diagnostics().empty());
}

TEST(DiagnosticSink, SortsByFileAndThenByPlace) {
  const SourceFile a("a", "text"), b("b", "text");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&b, {3, 4}});
  sink.report(diag::bad_utf8, {&a, {2, 3}});
  sink.report(diag::bad_utf8, {&b, {0, 1}});
  const auto sorted = sink.sorted();
  EXPECT_EQ(sorted[0]->where.file, &b);
  EXPECT_EQ(sorted[0]->where.span.begin, 0u);
  EXPECT_EQ(sorted[1]->where.span.begin, 3u);
  EXPECT_EQ(sorted[2]->where.file, &a);
}

}  // namespace
}  // namespace sdlc::lang
