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

TEST(DiagnosticSink, CountsWhatItDoesNotKeep) {
  const SourceFile file("a", "text");
  DiagnosticSink sink;
  constexpr std::size_t kErrors = DiagnosticSink::kMaxErrors;
  constexpr std::size_t kWarnings = DiagnosticSink::kMaxWarnings;
  for (std::uint32_t i = 0; i < kErrors + 10; ++i) {
    EXPECT_EQ(sink.report(diag::bad_utf8, {&file, {i, i + 1}}).is_kept(), i < kErrors);
  }
  for (std::uint32_t i = 0; i < kWarnings + 5; ++i) {
    EXPECT_EQ(sink.report(diag::zero_radius, {&file, {i, i + 1}}).is_kept(), i < kWarnings);
  }
  EXPECT_EQ(sink.error_count(), kErrors + 10);
  EXPECT_EQ(sink.warning_count(), kWarnings + 5);
  EXPECT_EQ(sink.not_kept().at(&diag::bad_utf8), 10u);
  EXPECT_EQ(sink.not_kept().at(&diag::zero_radius), 5u);
  EXPECT_EQ(sink.diagnostics().size(), kErrors + kWarnings);

  DiagnosticSink muted;
  muted.set_muted(true);
  muted.add(sink);
  EXPECT_EQ(muted.error_count() + muted.warning_count(), 0u);
  EXPECT_TRUE(muted.diagnostics().empty() && muted.not_kept().empty());
}

TEST(DiagnosticSink, AddsDiagnosticsOfAnotherSink) {
  const SourceFile file("a", "text");
  DiagnosticSink from, to;
  from.report(diag::zero_radius, {&file, {0, 1}}).help("look").label({&file, {1, 2}}, "here");
  for (int i = 0; i < 2; ++i) to.add(from.diagnostics().front());
  ASSERT_EQ(to.diagnostics().size(), 1u);
  EXPECT_EQ(to.diagnostics().front().help, from.diagnostics().front().help);
  EXPECT_EQ(to.diagnostics().front().labels.size(), 1u);
}

TEST(DiagnosticSink, StopsOnRequest) {
  StopRequest stop;
  const DiagnosticSink sink(&stop);
  sink.stop_if_requested();
  stop.make();
  EXPECT_THROW(sink.stop_if_requested(), StopRequested);
  DiagnosticSink().stop_if_requested();
}

TEST(DiagnosticSink, ReportsADuplicateOnce) {
  const SourceFile file("a", "text"), other("b", "text");
  DiagnosticSink sink;
  for (int i = 0; i < 3; ++i) sink.report(diag::unknown_name, {&file, {0, 1}}, "a").help("say it");
  sink.report(diag::unknown_name, {&file, {0, 1}}, "b");
  sink.report(diag::unknown_name, {&file, {0, 2}}, "a");
  sink.report(diag::unknown_name, {&other, {0, 1}}, "a");
  EXPECT_EQ(sink.error_count(), 4u);
  EXPECT_EQ(sink.diagnostics().front().help.size(), 1u);

  sink.clear();
  EXPECT_FALSE(sink.has_errors());
  sink.report(diag::unknown_name, {&file, {0, 1}}, "a");
  EXPECT_TRUE(sink.diagnostics().empty());
}

}  // namespace
}  // namespace sdlc::lang
