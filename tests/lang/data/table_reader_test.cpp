#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/data/data.hpp"

namespace sdlc::lang {
namespace {

std::shared_ptr<const Table> read(const std::string& name, const std::string& text) {
  const SourceFile file(name, text);
  DiagnosticSink sink;
  auto table = read_table(file, sink);
  for (const Diagnostic& diagnostic : sink.diagnostics()) ADD_FAILURE() << diagnostic.message;
  return table;
}

std::size_t errors_in(const std::string& text) {
  const SourceFile file("a.csv", text);
  DiagnosticSink sink;
  read_table(file, sink);
  return sink.error_count();
}

double number(const std::string& cell) {
  const auto table = read("a.csv", "x\n" + cell + "\n");
  return table == nullptr ? -1 : value_as<double>(table->cell(0, 0)).value_or(-1);
}

TEST(TableReader, ReadsTheNearestDoubles) {
  EXPECT_EQ(number("0.1"), 0.1);
  EXPECT_EQ(number("+.5"), 0.5);
  EXPECT_EQ(number("5."), 5);
  EXPECT_EQ(number("-2.5E-3"), -0.0025);
  EXPECT_EQ(number("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(number("5e-324"), 5e-324);
  EXPECT_EQ(number("1e-400"), 0.0);
  EXPECT_EQ(number("1.7976931348623157e308"), 1.7976931348623157e308);
}

TEST(TableReader, TakesWordsThatFromCharsWouldReadAsStrings) {
  for (const char* word :
       {"nan", "inf", "-inf", "infinity", "0x10", "1_000", "1 2", "+-1", "--1", "1e"}) {
    const auto table = read("a.csv", std::string("x\n") + word + "\n");
    ASSERT_NE(table, nullptr) << word;
    EXPECT_FALSE(table->columns()[0].has_numbers()) << word;
  }
}

TEST(TableReader, StoresNumbersInEightBytesAndStringsInFourMore) {
  std::string text = "x,name\n";
  constexpr std::size_t kRows = 10'000;
  for (std::size_t i = 0; i < kRows; ++i) text += fmt::format("{},ab\n", i);
  const auto table = read("a.csv", text);
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(table->row_count(), kRows);
  EXPECT_LE(table->bytes(), kRows * (8 + 4 + 2) + 1000);
}

TEST(TableReader, EndsAfterTooManyMistakes) {
  std::string text = "x\n1\n";
  for (int i = 0; i < 100'000; ++i) text += "a\n";
  const std::size_t errors = errors_in(text);
  EXPECT_GT(errors, 50u);
  EXPECT_LT(errors, 1000u);
}

TEST(TableReader, RefusesTooManyColumnsWithoutMemoryForThem) {
  EXPECT_EQ(errors_in(std::string(1'000'000, ',') + "\n1\n"), 1u);
}

TEST(TableReader, PollsForTheRequestToStop) {
  std::string text = "x\n";
  for (int i = 0; i < 5000; ++i) text += "1\n";
  const SourceFile file("a.csv", text);
  StopRequest stop;
  stop.make();
  DiagnosticSink sink(&stop);
  EXPECT_THROW(read_table(file, sink), StopRequested);
}

}  // namespace
}  // namespace sdlc::lang
