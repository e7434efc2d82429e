#include "cli/frame_writer.hpp"

#include <atomic>
#include <chrono>
#include <latch>
#include <new>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::cli {
namespace {

class PendingFramesTest : public testing::Test {
 protected:
  lang::DiskFileSystem files_;
  lang::Workspace workspace_{files_};
  std::ostringstream out_, err_;
  Environment env_{.workspace = workspace_, .out = out_, .err = err_};
  RenderOptions options_;
};

TEST_F(PendingFramesTest, AreTakenInTheirOrder) {
  PendingFrames frames(options_, env_);
  std::latch last_is_rendered(1);
  frames.add(
      {.index = 3}, [&](RenderedFrame&, render::RenderMonitor&) { last_is_rendered.wait(); }, 2);
  frames.add(
      {.index = 4}, [&](RenderedFrame&, render::RenderMonitor&) { last_is_rendered.count_down(); },
      2);
  EXPECT_EQ(frames.first(), 3U);
  EXPECT_EQ(frames.take().first.index, 3U);
  EXPECT_EQ(frames.first(), 4U);
  EXPECT_EQ(frames.take().first.index, 4U);
  EXPECT_EQ(frames.size(), 0U);
}

TEST_F(PendingFramesTest, AreRenderedByAsManyThreadsAsAllowed) {
  PendingFrames frames(options_, env_);
  std::atomic<int> rendering = 0, most = 0;
  for (std::size_t i = 0; i < 40; ++i) {
    frames.add(
        {.index = i},
        [&](RenderedFrame&, render::RenderMonitor&) {
          const int now = ++rendering;
          if (now > most) most = now;
          std::this_thread::yield();
          --rendering;
        },
        2);
  }
  while (frames.size() > 0) frames.take();
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

TEST_F(PendingFramesTest, AreInterruptedWhenTheyAreCanceled) {
  PendingFrames frames(options_, env_);
  std::latch has_begun(1);
  bool is_rendered = false;
  frames.add(
      {.index = 0},
      [&](RenderedFrame&, render::RenderMonitor& monitor) {
        has_begun.count_down();
        while (!monitor.cancel) std::this_thread::yield();
      },
      1);
  has_begun.wait();  // else the other could be the first
  frames.add(
      {.index = 1}, [&](RenderedFrame&, render::RenderMonitor&) { is_rendered = true; }, 1);
  EXPECT_FALSE(frames.wait(std::chrono::milliseconds(0)));
  frames.cancel();
  EXPECT_EQ(frames.take().second, ExitCode::Interrupted);
  EXPECT_EQ(frames.take().second, ExitCode::Interrupted);
  EXPECT_FALSE(is_rendered) << "it had not begun";
  EXPECT_EQ(err_.str(), "");
}

TEST_F(PendingFramesTest, ThatFailDoNotStopTheOthers) {
  PendingFrames frames(options_, env_);
  frames.add(
      {.index = 0}, [](RenderedFrame&, render::RenderMonitor&) { throw std::bad_alloc(); }, 1);
  bool is_rendered = false;
  frames.add(
      {.index = 1}, [&](RenderedFrame&, render::RenderMonitor&) { is_rendered = true; }, 1);
  EXPECT_NE(frames.take().second, ExitCode::Success);
  EXPECT_NE(err_.str(), "");
  frames.take();
  EXPECT_TRUE(is_rendered);
}

}  // namespace
}  // namespace sdlc::cli
