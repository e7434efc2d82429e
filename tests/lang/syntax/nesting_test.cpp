#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "lang/repair/repaired_text.hpp"
#include "lang/source/limits.hpp"
#include "lang/syntax/syntax.hpp"
#include "tests/lang/syntax/tree_checks.hpp"

namespace sdlc::lang {
namespace {

/// One way to nest: what is repeated in front of and behind the inside.
struct Nesting {
  const char* name;
  const char* begin;
  const char* open;
  const char* inside;
  const char* close;
  const char* end;
};
void PrintTo(const Nesting& nesting, std::ostream* out) { *out << nesting.name; }

std::string nested(const Nesting& nesting, int depth) {
  std::string text = std::string("scene 1\n") + nesting.begin;
  for (int i = 0; i < depth; ++i) text += nesting.open;
  text += nesting.inside;
  for (int i = 0; i < depth; ++i) text += nesting.close;
  return text + nesting.end + "\nlet behind = x\n";
}

class Nestings : public testing::TestWithParam<Nesting> {};

TEST_P(Nestings, MayBeAsDeepAsTheLimit) {
  const SourceFile file("test.scene", nested(GetParam(), kMaxNesting));
  DiagnosticSink sink;
  parse(file, sink);
  EXPECT_EQ(sink.error_count(), 0u);
}

TEST_P(Nestings, AreAnErrorAtTheLevelBeyond) {
  const SourceFile file("test.scene", nested(GetParam(), kMaxNesting + 1));
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  ASSERT_EQ(sink.error_count(), 1u);
  const Diagnostic& error = sink.diagnostics().front();
  EXPECT_EQ(error.info->code, "E301");
  const std::string begin = std::string("scene 1\n") + GetParam().begin;
  const std::size_t step = std::string(GetParam().open).size();
  EXPECT_GE(error.where.span.begin, begin.size() + step * kMaxNesting);
  EXPECT_LT(error.where.span.begin, begin.size() + step * (kMaxNesting + 1));
  EXPECT_EQ(test::fault_of(tree), "");
}

TEST_P(Nestings, OfAMillionDoNotOverflowTheStack) {
  const SourceFile file("test.scene", nested(GetParam(), 1'000'000));
  DiagnosticSink sink;
  parse(file, sink);
  EXPECT_TRUE(sink.has_errors());
  EXPECT_EQ(test::spelling_of(file.text()), file.text());
}

INSTANTIATE_TEST_SUITE_P(All, Nestings,
                         testing::Values(Nesting{"Parentheses", "let a = ", "(", "1", ")", ""},
                                         Nesting{"Lists", "let a = ", "[", "1", "]", ""},
                                         Nesting{"Calls", "let a = ", "f(", "1", ")", ""},
                                         Nesting{"Labels", "let a = ", "f(a: ", "1", ")", ""},
                                         Nesting{"Indices", "let a = ", "x[", "1", "]", ""},
                                         Nesting{"Triples", "let a = ", "(1, 2, ", "1", ")", ""},
                                         Nesting{"Signs", "let a = ", "-", "1", "", ""},
                                         Nesting{"Negations", "let a = ", "not ", "b", "", ""},
                                         Nesting{"Powers", "let a = 1", "^1", "", "", ""},
                                         Nesting{"Conditionals", "let a = ", "if b then ", "1",
                                                 " else 2", ""},
                                         Nesting{"Lets", "let a = ", "let b = 1 in ", "1", "", ""},
                                         Nesting{"Objects", "", "group { ", "", "} ", ""},
                                         Nesting{"Ifs", "", "if a { ", "", "} ", ""},
                                         Nesting{"Loops", "", "for i in a { ", "", "} ", ""},
                                         Nesting{"Comments", "", "/*", "", "*/", ""}),
                         [](const auto& nesting) { return std::string(nesting.param.name); });

/// Of this process so far.
long megabytes_at_most() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// The longest text whose brackets are mended has a quarter of a million of them. The search for
/// the ones that are missing once kept all that it had thought of: 1.5 GB.
TEST(Nestings, ThatAreNeverClosedTakeLittleMemory) {
  const std::string begin = "scene 1\nlet a = ";
  const SourceFile file("test.scene", begin + std::string(kMaxRepairedText - begin.size(), '('));
  const auto parse_alone = [&] {
    DiagnosticSink sink;
    parse(file, sink);
    const bool is_told = sink.error_count() > 0;
    constexpr long kMost = 400;  // 8 are needed, and more by a sanitizer
    std::exit(is_told && megabytes_at_most() < kMost ? 0 : 1);
  };
  EXPECT_EXIT(parse_alone(), testing::ExitedWithCode(0), "");
}

TEST(Chains, OfTwoMillionTermsAreOneNode) {
  std::string text = "scene 1\nlet a = 1";
  for (int i = 1; i < 2'000'000; ++i) text += "+1";
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_FALSE(sink.has_errors());
  EXPECT_EQ(tree.nodes().size(), 2'000'000u + 5u);  // file, version, let, name, sum
}

TEST(Chains, OfElseIfsAreOneNode) {
  std::string text = "scene 1\nif a { }";
  for (int i = 0; i < 100'000; ++i) text += " else if a { }";
  const SourceFile file("test.scene", text);
  DiagnosticSink sink;
  parse(file, sink);
  EXPECT_FALSE(sink.has_errors());
}

}  // namespace
}  // namespace sdlc::lang
