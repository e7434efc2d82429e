#include "cli/progress.hpp"

#include <chrono>
#include <memory>
#include <sstream>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sdlc::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// The output of a reporter for a render that is half done after the given time.
std::string reported(ProgressStyle style, std::chrono::milliseconds time) {
  render::RenderMonitor monitor;
  monitor.samples_done = 500;
  monitor.rays_done = 2000;
  std::ostringstream err;
  {
    const render::RenderSettings settings{.width = 10, .height = 10, .samples = 10};
    StatusLine line(err);
    ProgressPart part;
    part.schedule->line = &line;
    const ProgressReporter reporter(style, monitor, settings, line, part);
    std::this_thread::sleep_for(time);
  }
  return err.str();
}

TEST(ProgressReporter, RewritesOneLineOfATerminalAndClearsIt) {
  const std::string text = reported(ProgressStyle::Line, std::chrono::milliseconds(350));
  EXPECT_THAT(text, HasSubstr("\r 50.0 %  500 samples"));
  EXPECT_THAT(text, HasSubstr(" left"));
  EXPECT_THAT(text, EndsWith("\r\x1b[K"));
}

TEST(ProgressReporter, ShowsTheProgressTowardsAGoal) {
  render::RenderMonitor monitor;
  monitor.samples_done = 500;
  monitor.goal_share = 0.25;
  std::ostringstream err;
  {
    const render::RenderSettings settings{.error = 0.01};
    StatusLine line(err);
    ProgressPart part;
    part.schedule->line = &line;
    const ProgressReporter reporter(ProgressStyle::Line, monitor, settings, line, part);
    std::this_thread::sleep_for(std::chrono::milliseconds(350));
  }
  EXPECT_THAT(err.str(), HasSubstr("\r 25.0 %  500 samples"));
}

TEST(ProgressReporter, ShowsTheProgressOfManyShortRenders) {
  const render::RenderMonitor monitor;
  std::ostringstream terminal;
  StatusLine line(terminal);
  const auto schedule = std::make_shared<ProgressSchedule>();
  schedule->line = &line;
  std::string last;
  while (last.empty()) {
    const ProgressReporter reporter(
        ProgressStyle::Line, monitor, {}, line,
        {.before = 0.25, .share = 0.1, .label = "frame 3 of 10", .schedule = schedule});
    last = terminal.str();
  }
  EXPECT_THAT(last, HasSubstr("\r 25.0 %  frame 3 of 10  "));
  line << "a.png\n";
  EXPECT_THAT(terminal.str(), EndsWith("left\x1b[K\x1b[?7h\r\x1b[Ka.png\n"));
}

TEST(ProgressReporter, WritesAnObjectASecond) {
  const std::string text = reported(ProgressStyle::Json, std::chrono::milliseconds(1300));
  const auto json = nlohmann::json::parse(text.substr(0, text.find('\n')));
  EXPECT_EQ(json["fraction"], 0.5);
  EXPECT_EQ(json["part"], "");
  EXPECT_EQ(json["samples"], 500);
  EXPECT_GT(json["rays_per_second"], 0);
  EXPECT_GT(json["eta_seconds"], 0.5);
}

TEST(ProgressReporter, IsSilentElsewhere) {
  EXPECT_EQ(reported(ProgressStyle::None, std::chrono::milliseconds(300)), "");
  EXPECT_EQ(reported(ProgressStyle::Plain, std::chrono::milliseconds(300)), "")
      << "ten seconds are not over";
}

}  // namespace
}  // namespace sdlc::cli
