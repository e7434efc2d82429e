#include "render/parallel/parallel_for.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <latch>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/parallel/ranges.hpp"
#include "render/parallel/workers.hpp"

namespace sdlc::render {
namespace {

TEST(ParallelFor, CallsTheBodyOnceForEachIndex) {
  for (const int threads : {1, 2, 7}) {
    const Workers workers(threads);
    EXPECT_EQ(workers.count(), threads);
    for (const std::size_t count : {0, 1, 2, 99, 1000}) {
      for (const std::size_t grain : {1, 3, 99, 5000}) {
        std::vector<std::atomic<int>> calls(count);
        workers.run([&] {
          parallel_for(
              count, [&](std::size_t i) { ++calls[i]; }, grain);
        });
        EXPECT_TRUE(std::ranges::all_of(calls, [](int n) { return n == 1; }))
            << threads << " threads, " << count << " by " << grain;
      }
    }
  }
}

TEST(ParallelFor, DividesIntoRangesOfTheGrain) {
  std::mutex mutex;
  std::set<std::pair<std::size_t, std::size_t>> ranges;
  Workers(3).run([&] {
    parallel_ranges(10, 4, [&](std::size_t begin, std::size_t end) {
      const std::lock_guard lock(mutex);
      ranges.emplace(begin, end);
    });
  });
  EXPECT_THAT(ranges,
              testing::ElementsAre(testing::Pair(0, 4), testing::Pair(4, 8), testing::Pair(8, 10)));
}

// Each call waits for the others, so the test ends only if all threads are in the loop.
TEST(ParallelFor, UsesAllThreadsOfTheWorkers) {
  constexpr int kThreads = 5;
  std::latch all(kThreads);
  Workers(kThreads).run(
      [&] { parallel_for(kThreads, [&](std::size_t) { all.arrive_and_wait(); }); });
}

TEST(ParallelFor, OneThreadIsTheCaller) {
  std::set<std::thread::id> threads;
  Workers(1).run(
      [&] { parallel_for(100, [&](std::size_t) { threads.insert(std::this_thread::get_id()); }); });
  EXPECT_THAT(threads, testing::ElementsAre(std::this_thread::get_id()));
}

// Otherwise a short loop would last as long as a long one that has nothing to do with it.
TEST(ParallelFor, WaitingThreadsDoNotHelpLoopsOfOthers) {
  for (int round = 0; round < 20; ++round) {
    std::latch both(2), short_is_begun(2);
    std::thread::id waiting;
    std::atomic<bool> waits = false, has_helped = false, ends = false;
    const auto short_loop = [&] {
      parallel_for(2, [&](std::size_t) {
        short_is_begun.arrive_and_wait();  // by two of the three threads
        if (std::this_thread::get_id() == waiting) {
          waits = true;
        } else {
          while (!ends) std::this_thread::yield();
        }
      });
      waits = false;
    };
    const auto long_loop = [&] {
      while (!waits) std::this_thread::yield();
      parallel_for(100, [&](std::size_t) {
        if (waits && std::this_thread::get_id() == waiting) has_helped = true;
        std::this_thread::yield();
      });
      ends = true;
    };
    Workers(3).run([&] {
      parallel_for(2, [&](std::size_t i) {
        if (i == 0) waiting = std::this_thread::get_id();
        both.arrive_and_wait();
        i == 0 ? short_loop() : long_loop();
      });
    });
    EXPECT_FALSE(has_helped);
  }
}

TEST(ParallelFor, MayBeNested) {
  for (const int threads : {1, 2, 5}) {
    std::atomic<int> calls = 0;
    Workers(threads).run([&] {
      parallel_for(6, [&](std::size_t) {
        parallel_for(5, [&](std::size_t) { parallel_for(4, [&](std::size_t) { ++calls; }); });
      });
    });
    EXPECT_EQ(calls, 6 * 5 * 4);
  }
}

// The last range of the outer loop takes all threads: each inner call waits for the others.
TEST(ParallelFor, ThreadsThatHaveFinishedHelpWithInnerLoops) {
  constexpr int kThreads = 4;
  std::latch all(kThreads);
  Workers(kThreads).run([&] {
    parallel_for(2 * kThreads, [&](std::size_t i) {
      if (i == 0) parallel_for(kThreads, [&](std::size_t) { all.arrive_and_wait(); });
    });
  });
}

TEST(ParallelFor, RethrowsAnExceptionAndBeginsNothingElse) {
  for (const int threads : {1, 3}) {
    std::atomic<int> calls = 0;
    const Workers workers(threads);
    const auto fail = [&](std::size_t) {
      ++calls;
      throw std::runtime_error("no");
    };
    EXPECT_THROW(workers.run([&] { parallel_for(1000, fail); }), std::runtime_error);
    EXPECT_LE(calls, threads);
    // And the threads go on.
    calls = 0;
    workers.run([&] { parallel_for(1000, [&](std::size_t) { ++calls; }); });
    EXPECT_EQ(calls, 1000);
  }
}

TEST(ParallelFor, ExceptionsLeaveNestedLoops) {
  const auto outer = [](std::size_t i) {
    parallel_for(8, [i](std::size_t k) {
      if (i == 3 && k == 5) throw std::runtime_error("inner");
    });
  };
  EXPECT_THROW(Workers(3).run([&] { parallel_for(8, outer); }), std::runtime_error);
}

TEST(ParallelFor, WorksWithoutWorkersFromSeveralThreads) {
  std::atomic<int> calls = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t) {
      threads.emplace_back([&] { parallel_for(1000, [&](std::size_t) { ++calls; }); });
    }
  }
  EXPECT_EQ(calls, 4000);
}

// Sums of strings are in order, and sums of rounded numbers equal, for any number of threads.
TEST(ReduceIndices, DoesNotDependOnTheNumberOfThreads) {
  const auto digits = [] {
    return reduce_indices(
        3 * kRange + 5, std::string(),
        [](std::string& text, std::size_t i) {
          if (i % kRange < 3) text += std::to_string(i % 10);
        },
        [](std::string& text, const std::string& later) { text += later; });
  };
  const auto sum = [] {
    return reduce_indices(
        5 * kRange + 7, 0.0,
        [](double& all, std::size_t i) { all += 1 / static_cast<double>(i + 1); },
        [](double& all, double later) { all += later; });
  };
  const std::string text = Workers(1).run(digits);
  const double number = Workers(1).run(sum);
  EXPECT_EQ(text, "012456890234");
  for (const int threads : {2, 3, 8}) {
    EXPECT_EQ(Workers(threads).run(digits), text);
    EXPECT_EQ(Workers(threads).run(sum), number);
  }
}

}  // namespace
}  // namespace sdlc::render
