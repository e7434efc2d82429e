#include "cli/progress.hpp"

#include <chrono>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sdlc::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

/// What a reporter says of a render that is half done, in the given time.
std::string reported(ProgressStyle style, std::chrono::milliseconds time) {
  render::RenderMonitor monitor;
  monitor.samples_done = 500;
  monitor.rays_done = 2000;
  std::ostringstream err;
  {
    const ProgressReporter reporter(style, monitor, 1000, err);
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

TEST(ProgressReporter, WritesAnObjectASecond) {
  const std::string text = reported(ProgressStyle::Json, std::chrono::milliseconds(1300));
  const auto json = nlohmann::json::parse(text.substr(0, text.find('\n')));
  EXPECT_EQ(json["fraction"], 0.5);
  EXPECT_EQ(json["samples"], 500);
  EXPECT_GT(json["rays_per_second"], 0);
  EXPECT_GT(json["eta_seconds"], 0.5);
}

TEST(ProgressReporter, IsSilentElsewhere) {
  EXPECT_EQ(reported(ProgressStyle::None, std::chrono::milliseconds(300)), "");
  EXPECT_EQ(reported(ProgressStyle::Plain, std::chrono::milliseconds(300)), "")
      << "ten seconds are not over";
}

TEST(FormatSeconds, UsesTheUnitThatReadsBest) {
  EXPECT_EQ(format_seconds(0.0123), "12 ms");
  EXPECT_EQ(format_seconds(59.94), "59.9 s");
  EXPECT_EQ(format_seconds(245), "4 min 05 s");
  EXPECT_EQ(format_seconds(7800), "2 h 10 min");
}

TEST(FormatCount, KeepsThreeDigits) {
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1234), "1.23 k");
  EXPECT_EQ(format_count(71.2e6), "71.2 M");
  EXPECT_EQ(format_count(7.1e14), "710 T");
}

}  // namespace
}  // namespace sdlc::cli
