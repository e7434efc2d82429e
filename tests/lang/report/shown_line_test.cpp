#include "lang/report/shown_line.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(ShownLine, WidensTabsToTheNextStop) {
  const ShownLine line("\ta\tb", 0);
  EXPECT_EQ(line.text(), "    a   b");
  EXPECT_EQ(line.column(1), 4);
  EXPECT_EQ(line.column(3), 8);
  EXPECT_EQ(line.first_column(), 4);
}

TEST(ShownLine, CountsColumnsNotBytes) {
  const ShownLine line("é日e\u0301x", 0);
  EXPECT_EQ(line.column(2), 1);  // after é
  EXPECT_EQ(line.column(5), 3);  // after the ideograph
  EXPECT_EQ(line.column(8), 4);  // after e and its accent
  EXPECT_EQ(line.width(), 5);
  EXPECT_EQ(line.column(100), 5);
}

TEST(ShownLine, ShowsNothingThatSteersATerminal) {
  EXPECT_EQ(ShownLine("a\x1b[31m\x7f", 0).text(), "a␛[31m␡");
  EXPECT_EQ(ShownLine("\xff\xc2\x9b\u202e", 0).text(), "\uFFFD\uFFFD\uFFFD");
}

TEST(ShownLine, KeepsALineThatFits) {
  EXPECT_EQ(ShownLine(std::string(120, 'x'), 119).text(), std::string(120, 'x'));
}

TEST(ShownLine, ShortensALongLineAroundAPlace) {
  std::string text(1000, 'x');
  text[500] = 'Y';
  const ShownLine line(text, 500);
  const std::string shown = line.text();
  EXPECT_TRUE(shown.starts_with("…x"));
  EXPECT_TRUE(shown.ends_with("x…"));
  EXPECT_EQ(line.width(), 102);
  // The sign for omitted text is one column of three bytes.
  EXPECT_EQ(shown.find('Y') - 2, static_cast<std::size_t>(line.column(500)));
  EXPECT_EQ(line.column(0), 0);
  EXPECT_EQ(line.column(999), 102);
}

TEST(ShownLine, ShortensOnlyTheFarSideAtTheEnds) {
  EXPECT_EQ(ShownLine(std::string(1000, 'x'), 3).text(), std::string(100, 'x') + "…");
  EXPECT_EQ(ShownLine(std::string(1000, 'x'), 1000).text(), "…" + std::string(100, 'x'));
}

TEST(ShownLine, LooksOnlyAtWhatIsNear) {
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "日本";
  const auto middle = static_cast<std::uint32_t>(text.size() / 2);
  const ShownLine line(text, middle);
  EXPECT_EQ(line.text().find("\uFFFD"), std::string::npos);
  EXPECT_TRUE(line.text().starts_with("…"));
  EXPECT_TRUE(line.text().ends_with("…"));
  EXPECT_EQ(line.column(middle), 41);
}

}  // namespace
}  // namespace sdlc::lang
