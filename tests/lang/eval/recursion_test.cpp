#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <pthread.h>

#include "lang/eval/eval.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/program/program.hpp"

namespace sdlc::lang {
namespace {

class IgnoredObjects final : public ObjectSink {
 public:
  void add(const Object& /*object*/) override {}
};

/// The codes of all errors.
std::vector<std::string> errors_of(const std::string& text, const Limits& limits = {}) {
  const Document file("test.scene", "scene 1\n" + text);
  DiagnosticSink sink;
  Program program(file, {.limits = limits}, sink);
  IgnoredObjects objects;
  Evaluation(program, {}, sink).run(objects);
  std::vector<std::string> codes;
  for (const Diagnostic& diagnostic : sink.diagnostics()) codes.emplace_back(diagnostic.info->code);
  return codes;
}

/// Runs the function on a thread with a small stack. Sanitizers need more for their own.
void run_on_small_stack(std::function<void()> function) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr std::size_t kBytes = std::size_t{2} << 20;
#else
  constexpr std::size_t kBytes = std::size_t{256} << 10;
#endif
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kBytes);
  pthread_t thread{};
  const auto call = [](void* f) -> void* {
    (*static_cast<std::function<void()>*>(f))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, call, &function), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

using Codes = std::vector<std::string>;

constexpr std::string_view kCount =
    "fn count(n) = if n == 0 then 0 else 1 + count(n - 1)\nlet deep = count(";
constexpr std::string_view kTower =
    "def tower(n) { if n > 1 { group { tower { n: n - 1, scale: 0.5 } } } }\ntower { n: ";

std::string with(std::string_view text, int number, std::string_view end) {
  return std::string(text) + std::to_string(number) + std::string(end);
}

TEST(Recursion, OfCallsHasALimitOfItsOwnOnAnyStack) {
  const auto check = [] {
    EXPECT_EQ(errors_of(with(kCount, 9'999, ")")), Codes{});
    EXPECT_EQ(errors_of(with(kCount, 10'000, ")")), Codes{"E301"});
  };
  check();
  run_on_small_stack(check);
}

TEST(Recursion, OfInstancesHasTheSameLimitOnAnyStack) {
  const auto check = [] {
    EXPECT_EQ(errors_of(with(kTower, 10'000, " }")), Codes{});
    EXPECT_EQ(errors_of(with(kTower, 10'001, " }")), Codes{"E301"});
  };
  check();
  run_on_small_stack(check);
}

TEST(Recursion, GoesOnUntilMemoryIsUsedUpIfCallsAreAllowed) {
  const Limits limits{.memory = std::uint64_t{64} << 20, .calls = 10'000'000};
  EXPECT_EQ(errors_of(with(kCount, 9'000'000, ")"), limits), Codes{"E315"});
  EXPECT_EQ(errors_of(with(kTower, 9'000'000, " }"), limits), Codes{"E315"});
}

TEST(Recursion, GivesItsMemoryBack) {
  const std::size_t before = CountedBytes::sum();
  EXPECT_EQ(errors_of(with(kCount, 9'999, ")")), Codes{});
  EXPECT_EQ(CountedBytes::sum(), before);
}

/// A request that is made at the 30th poll, some thousand calls deep.
class LateStop final : public StopRequest {
 public:
  bool is_made() const override { return ++polls_ > 30; }

 private:
  mutable int polls_ = 0;
};

TEST(Recursion, StopsOnRequest) {
  const LateStop stop;
  const Document file("test.scene", "scene 1\n" + with(kCount, 9'999, ")"));
  DiagnosticSink sink;
  Program program(file, {}, sink);
  const std::size_t before = CountedBytes::sum();
  DiagnosticSink stopping(&stop);
  EXPECT_THROW(Evaluation(program, {}, stopping), StopRequested);
  EXPECT_EQ(CountedBytes::sum(), before);
}

/// Lists that have two users in each list around them.
TEST(Recursion, DestroysListsThatShareElements) {
  run_on_small_stack([] {
    const std::string text =
        "fn pair(n) = if n == 0 then [1] else let a = pair(n - 1) in [a, a]\n"
        "let count = len(pair(9000))\nassert count == 2, \"a pair\"";
    EXPECT_EQ(errors_of(text), Codes{});
  });
}

/// Each of these loops runs at another depth, one of them at the end of a segment.
TEST(Recursion, LoopsAtAnyDepth) {
  const std::string text =
      "fn id(x) = x\n"
      "fn loop(n) = if n == 0 then 0 else id(n) - n + loop(n - 1)\n"
      "def at(n) { for i in range(3) { let x = loop(3) } if n > 1 { at { n: n - 1 } } }\n"
      "at { n: 5000 }";
  EXPECT_EQ(errors_of(text), Codes{});
}

}  // namespace
}  // namespace sdlc::lang
