#include "cli/report/chart.hpp"

#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace sdlc::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string tick(double value) { return figure(value) + "!"; }

ChartPoint point(double x, double y, std::string reading = "a reading") {
  return {.x = {.value = x}, .y = {.value = y}, .reading = std::move(reading)};
}

Chart chart_of(std::vector<ChartPoint> points) {
  return {.id = "test",
          .title = "A title",
          .description = "A description",
          .x = {"across", tick},
          .y = {"up", tick},
          .series = {{.key = "A", .points = std::move(points)}}};
}

std::string draw(const Chart& chart) { return chart_figure(chart, "caption"); }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(Chart, HasATitleADescriptionAndLabels) {
  const std::string svg = draw(chart_of({point(1, 1), point(10, 0.1)}));
  for (const char* part : {"<title id=\"test-title\">A title<", ">A description<", ">across<",
                           ">up<", ">10!<", ">0.1!<", ">A</text>", ">caption<"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

TEST(Chart, EachMarkHasItsFigures) {
  const std::string svg = draw(chart_of({point(1, 1, "1 < 2"), point(10, 0.1, "other")}));
  EXPECT_THAT(svg, HasSubstr("<title>1 &lt; 2</title>"));
  EXPECT_THAT(svg, HasSubstr("<title>other</title>"));
}

TEST(Chart, IntervalsAreDrawnAsBars) {
  ChartPoint measured = point(10, 1);
  EXPECT_THAT(draw(chart_of({measured})), Not(HasSubstr("class=\"bar\"")));
  measured.y.interval = {0, 1.2};
  measured.x.interval = {9, 11};
  EXPECT_EQ(count(draw(chart_of({measured})), "class=\"bar\""), 1u);
}

TEST(Chart, PointsThatLogarithmicAxesCannotShowHaveNoMark) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(draw(chart_of({point(1, kInfinity), point(kNan, 1), point(1, 0)})), "");
  EXPECT_EQ(count(draw(chart_of({point(1, kInfinity), point(1, 1)})), "class=\"mark\""), 1u);
}

TEST(Chart, TheFrontIsAStaircase) {
  Chart chart = chart_of({point(1, 1), point(10, 0.1)});
  EXPECT_THAT(draw(chart), Not(HasSubstr("class=\"front\"")));
  chart.front = {{1, 1}, {10, 0.1}};
  const std::string svg = draw(chart);
  const std::size_t begin = svg.find("class=\"front\" d=\"");
  ASSERT_NE(begin, std::string::npos);
  const std::string path = svg.substr(begin, svg.find("/>", begin) - begin);
  EXPECT_EQ(count(path, "V"), 2u);
  EXPECT_EQ(count(path, "H"), 3u);
}

TEST(Chart, ALevelIsDrawnWithItsLabel) {
  Chart chart = chart_of({point(1, 1), point(10, 0.1)});
  EXPECT_THAT(draw(chart), Not(HasSubstr("class=\"level\"")));
  chart.level = ChartLevel{.y = 0.02, .label = "the level"};
  EXPECT_THAT(draw(chart), testing::AllOf(HasSubstr(">the level<"), HasSubstr("class=\"level\"")));
}

TEST(Chart, EightSeriesHaveColorsOfTheirOwn) {
  EXPECT_EQ(color_class(7), "s7");
  EXPECT_EQ(color_class(8), "s0");
}

}  // namespace
}  // namespace sdlc::cli
