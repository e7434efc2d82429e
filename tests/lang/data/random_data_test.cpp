#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "lang/data/data.hpp"

// Readers of data files on texts that no program writes: random bytes, and files with mutations.
namespace sdlc::lang {
namespace {

void check_place(const Location& where) {
  if (where.file == nullptr) return;
  EXPECT_LE(where.span.begin, where.span.end);
  EXPECT_LE(where.span.end, where.file->text().size());
}

/// Reads the text: a table with cells for all rows and columns, or errors in the text.
void check(const std::string& name, const std::string& text) {
  const SourceFile file(name, text);
  DiagnosticSink sink;
  const std::shared_ptr<const Table> table = read_table(file, sink);
  ASSERT_EQ(table == nullptr, sink.has_errors()) << name << ": " << text;
  for (const Diagnostic& diagnostic : sink.diagnostics()) {
    check_place(diagnostic.where);
    for (const Label& label : diagnostic.labels) check_place(label.where);
  }
  if (table == nullptr) return;
  for (std::size_t row = 0; row < table->row_count(); ++row) {
    for (std::size_t column = 0; column < table->columns().size(); ++column) {
      const Value cell = table->cell(row, column);
      EXPECT_TRUE(holds_alternative<Scalar>(cell) || holds_alternative<std::string>(cell));
    }
  }
}

class DataOf : public testing::TestWithParam<const char*> {
 protected:
  std::uint32_t below(std::uint32_t end) { return static_cast<std::uint32_t>(random_() % end); }
  std::mt19937 random_{7};
};

TEST_P(DataOf, RandomBytesIsReadOrRefused) {
  constexpr std::string_view kLikely = "\",;\n\r\t #-+.0123456789eExyz\xEF\xBB\xBF\xC3\xA9";
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    const std::uint32_t size = below(60);
    while (text.size() < size) {
      text += below(20) == 0 ? static_cast<char>(below(256))
                             : kLikely[below(static_cast<std::uint32_t>(kLikely.size()))];
    }
    check(GetParam(), text);
    check(GetParam(), "x,y\tz\n" + text);
    check(GetParam(), "2\n\n" + text);
  }
}

TEST_P(DataOf, MutatedFilesIsReadOrRefused) {
  constexpr std::string_view kFiles[] = {
      "name,mass,\"radius (km)\"\nEarth,1,6371\n\"a \"\"b\"\"\r\nc\",2.5e-3,-1\r\n\n",
      "name\tmass\nEarth\t1\nMars\t.1\n", "3\nwater\nO 0 0 0.12 a\nH 0 .76 -4.8e-1 b\nH 1 2 3 c\n"};
  for (int i = 0; i < 20'000; ++i) {
    std::string text(kFiles[below(3)]);
    for (std::uint32_t edits = 1 + below(4); edits > 0; --edits) {
      const std::size_t at = below(static_cast<std::uint32_t>(text.size()));
      const std::size_t other = below(static_cast<std::uint32_t>(text.size()));
      switch (below(3)) {
        case 0: text.erase(at, 1 + below(5)); break;
        case 1: text.insert(at, text.substr(other, below(8))); break;
        default: text[at] = text[other];
      }
      if (text.empty()) text = "x";
    }
    check(GetParam(), text);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DataOf, testing::Values("a.csv", "a.tsv", "a.xyz"),
                         [](const auto& format) { return std::string(format.param).substr(2); });

}  // namespace
}  // namespace sdlc::lang
