#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/program/program.hpp"
#include "tests/support/compilation/compilation.hpp"

// The work that suggestions may take.
namespace sdlc::test {
namespace {

using namespace lang;

TEST(UnknownNames, ComparesAMemberWithLimitedNumbersOfNames) {
  constexpr int kCount = 3000;  // names and mistakes: 9 million comparisons
  std::string part = "scene 1\n", root = "scene 1\nimport \"part.scene\" as p\n";
  for (int i = 0; i < kCount; ++i) {
    part += fmt::format("let name_{} = 1\n", i);
    root += fmt::format("let b{0} = p.nome_{0}\n", i);
  }
  const MemoryFiles files({{"part.scene", part}});
  Workspace workspace(files);
  const Document file("root.scene", root);
  DiagnosticSink sink;
  const Program program(file, {.workspace = &workspace, .limits = {}}, sink);
  const auto suggestions = std::ranges::count_if(
      sink.diagnostics(), [](const Diagnostic& found) { return !found.suggestion.empty(); });
  EXPECT_EQ(sink.error_count(), static_cast<std::size_t>(kCount));
  EXPECT_GT(suggestions, 0);
  EXPECT_LE(suggestions * kCount, 2'000'000);
}

}  // namespace
}  // namespace sdlc::test
