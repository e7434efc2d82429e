#include "cli/report/chart.hpp"

#include <limits>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "cli/report/marks.hpp"

namespace sdlc::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string tick(double value) { return figure(value) + "!"; }

ChartPoint point(double x, double y, std::string reading = "a reading") {
  return {.x = {.value = x}, .y = {.value = y}, .reading = std::move(reading)};
}

Chart chart_of(std::vector<ChartPoint> points) {
  Chart chart{.id = "test",
              .title = "A title",
              .description = "A description",
              .x = {"across", tick},
              .y = {"up", tick},
              .series = {},
              .front = {},
              .level = {}};
  chart.series.push_back({.style = 0,
                          .key = "A",
                          .name = "first",
                          .points = std::move(points),
                          .is_joined = false,
                          .slope = {}});
  return chart;
}

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
                           ">up<", ">10!<", ">0.1!<"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

TEST(Chart, EachMarkCanHaveTheFocusAndShowsItsFigures) {
  ChartPoint said = point(1, 1, "1 < 2");
  said.remark = "remarkable";
  const std::string svg = draw(chart_of({said, point(10, 0.1, "other")}));
  EXPECT_EQ(count(svg, "tabindex=\"0\" role=\"img\""), 2u);
  EXPECT_THAT(svg, HasSubstr("aria-label=\"first · remarkable: 1 &lt; 2\""));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"first: other\""));
  EXPECT_THAT(svg, HasSubstr(">1 &lt; 2</text>"));
}

TEST(Chart, IntervalsAreDrawnAsBars) {
  ChartPoint measured = point(10, 1);
  const std::string plain = draw(chart_of({measured}));
  measured.y.interval = {0.8, 1.2};
  const std::string with_y = draw(chart_of({measured}));
  measured.x.interval = {9, 11};
  const std::string with_both = draw(chart_of({measured}));
  EXPECT_THAT(plain, Not(HasSubstr("class=\"bar\"")));
  EXPECT_EQ(count(with_y, "h7.0"), 2u);
  EXPECT_THAT(with_y, Not(HasSubstr("v7.0")));
  EXPECT_EQ(count(with_both, "v7.0"), 2u);
}

TEST(Chart, AnIntervalThatReachesDownToZeroHasNoCapThere) {
  ChartPoint measured = point(10, 1);
  measured.y.interval = {0, 2};
  EXPECT_EQ(count(draw(chart_of({measured})), "h7.0"), 1u);
}

TEST(Chart, ZeroHasALaneBelowTheLogarithms) {
  EXPECT_THAT(draw(chart_of({point(1, 1)})), Not(HasSubstr("class=\"break\"")));
  const std::string svg = draw(chart_of({point(1, 1), point(10, 0)}));
  EXPECT_THAT(svg, HasSubstr("class=\"break\""));
  EXPECT_THAT(svg, HasSubstr(">0!<"));
}

TEST(Chart, WhatIsNoNumberHasNoMark) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Chart none = chart_of({point(1, kInfinity), point(kNan, 1)});
  EXPECT_FALSE(can_be_drawn(none));
  EXPECT_EQ(chart_figure(none, "caption"), "");
  const Chart one = chart_of({point(1, kInfinity), point(1, 1)});
  EXPECT_EQ(count(draw(one), "class=\"mark\""), 1u);
}

TEST(Chart, ASlopeIsAStraightLineThroughTheMiddleOfTheMarks) {
  Chart chart = chart_of({point(1, 1), point(100, 0.01)});
  EXPECT_THAT(draw(chart), Not(HasSubstr("class=\"line")));
  chart.series[0].slope = -1;
  const std::string exact = draw(chart);
  chart.series[0].is_joined = true;  // the marks are on that line
  chart.series[0].slope = {};
  EXPECT_EQ(exact, draw(chart));
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
  EXPECT_EQ(count(path, "L"), 1u);
  EXPECT_EQ(count(path, "H"), 1u);
}

TEST(Chart, ALevelThatIsNotFarBelowIsDrawn) {
  Chart chart = chart_of({point(1, 1), point(10, 0.1)});
  chart.level = ChartLevel{.y = {.value = 0.02, .interval = {0.01, 0.03}}, .label = "the level"};
  EXPECT_THAT(draw(chart), testing::AllOf(HasSubstr(">the level<"), HasSubstr("class=\"band\"")));
  chart.level->y = {.value = 1e-6, .interval = {}};
  EXPECT_THAT(draw(chart), Not(HasSubstr(">the level<")));
}

TEST(Chart, NoTwoOfEightSeriesLookAlike) {
  std::set<std::string> outlines, lines;
  for (std::size_t style = 0; style < kSeriesStyles; ++style) {
    outlines.insert(mark_outline(style, 5));
    lines.insert(std::string(dashes(style)));
  }
  EXPECT_EQ(outlines.size(), kSeriesStyles);
  EXPECT_EQ(lines.size(), kSeriesStyles);
}

}  // namespace
}  // namespace sdlc::cli
