#include "cli/report/figures.hpp"

#include <limits>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Figures, NumbersHaveThreeDigits) {
  const std::pair<double, std::string> cases[] = {{0, "0"},
                                                  {-0.0, "0"},
                                                  {0.98, "0.98"},
                                                  {1, "1"},
                                                  {1234, "1230"},
                                                  {9.996, "10"},
                                                  {0.0001234, "0.000123"},
                                                  {-2.144, "-2.14"},
                                                  {99.95, "100"},
                                                  {1234567, "1230000"},
                                                  {1e7, "10000000"},
                                                  {1e-5, "1e-05"},
                                                  {-2.144e-12, "-2.14e-12"},
                                                  {kInfinity, "unknown"},
                                                  {-kInfinity, "unknown"},
                                                  {kNan, "unknown"}};
  for (const auto& [number, text] : cases) EXPECT_EQ(figure(number), text) << number;
}

TEST(Figures, SharesAreInPercent) {
  EXPECT_EQ(percent(0.00981), "0.981\u00a0%");
  EXPECT_EQ(percent(0), "0\u00a0%");
  EXPECT_EQ(percent(kNan), "unknown");
}

TEST(Figures, TimesHaveThreeDigitsBelowAMinute) {
  const std::pair<double, std::string> cases[] = {{0.00015, "0.15\u00a0ms"},
                                                  {0.876, "876\u00a0ms"},
                                                  {1.184, "1.18\u00a0s"},
                                                  {59.97, "60\u00a0s"},
                                                  {75, "1\u00a0min\u00a015\u00a0s"},
                                                  {-1, "unknown"},
                                                  {kNan, "unknown"},
                                                  {kInfinity, "unknown"}};
  for (const auto& [seconds, text] : cases) EXPECT_EQ(duration(seconds), text) << seconds;
}

TEST(Figures, AnIntervalHasItsUnitOnceIfBothEndsShareIt) {
  EXPECT_EQ(read({.value = 0.01, .interval = {0.009, 0.012}}, percent).text(),
            "1\u00a0% (0.9 to 1.2\u00a0%)");
  EXPECT_EQ(read({.value = 60, .interval = {58.2, 62}}, duration).interval,
            "58.2\u00a0s to 1\u00a0min\u00a002\u00a0s");
  EXPECT_EQ(read({.value = 100, .interval = {90, 110}}, duration).interval,
            "1\u00a0min\u00a030\u00a0s to 1\u00a0min\u00a050\u00a0s");
}

TEST(Figures, WithoutAnIntervalTheFigureIsAlone) {
  EXPECT_EQ(read({.value = 0.01, .interval = {}}, percent).text(), "1\u00a0%");
  EXPECT_EQ(read({.value = 0.01, .interval = {0.01, 0.01}}, percent).text(), "1\u00a0%");
  EXPECT_EQ(read({.value = kNan, .interval = {kNan, kNan}}, percent).text(), "unknown");
}

TEST(Figures, AnIntervalMayHaveNoUpperEnd) {
  EXPECT_EQ(read({.value = kInfinity, .interval = {0.02, kInfinity}}, percent).text(),
            "unknown (at least 2\u00a0%)");
}

}  // namespace
}  // namespace sdlc::cli
