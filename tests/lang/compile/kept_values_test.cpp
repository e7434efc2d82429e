#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/source/source.hpp"
#include "render/scene/digest.hpp"

// A compiler keeps values that do not depend on the time from frame to frame.
namespace sdlc::lang {
namespace {

constexpr const char* kScene =
    "scene 1\n"
    "animation { frames: 1 .. 9, fps: 10 }\n"
    "param count = 3\n"
    "let places = [random(i) for i in range(0, 2 * count)]\n"
    "let wave = [sin(time / 1s * 1turn + p * 1turn) for p in places]\n"
    "fn tall(i) = wave[i] + places[i]\n"
    "camera main { from: (0, 1 + time / 1s, 9), at: (0, 0, 0), fov: 40deg }\n"
    "for i, p in places { sphere { center: (p, tall(i), 0), radius: 0.1, material: unlit(red) } "
    "}\n";

struct Frame {
  std::uint64_t digest = 0;
  std::string messages;

  friend bool operator==(const Frame&, const Frame&) = default;
};

/// The frames as one compiler lowers them, or each by a compiler of its own.
std::vector<Frame> frames(const std::string& text, bool by_one, std::vector<SetOption> sets = {}) {
  const Document file("a.scene", text);
  DiagnosticSink sink;
  std::optional<Compiler> compiler;
  std::vector<Frame> all;
  for (const int frame : {1, 4, 2, 9}) {
    sink.clear();
    if (!by_one || !compiler) {
      compiler.emplace(file, ProgramOptions{.workspace = nullptr, .limits = {}, .sets = sets},
                       sink);
    }
    const auto lowered = compiler->lower({}, frame);
    Frame& result = all.emplace_back();
    if (lowered) result.digest = render::digest_of(lowered->scene);
    for (const Diagnostic& each : sink.diagnostics()) {
      result.messages += fmt::format("{} ", each.info->code);
    }
  }
  return all;
}

TEST(KeptValues, GiveTheScenesOfCompilersThatKeepNothing) {
  const std::vector<Frame> kept = frames(kScene, true);
  EXPECT_EQ(kept, frames(kScene, false));
  EXPECT_NE(kept[0].digest, 0u);
  EXPECT_NE(kept[0].digest, kept[1].digest) << "frames differ";
  EXPECT_NE(kept, frames(kScene, true, {{.name = "count", .value = "4"}}));
}

// A sink reports an error once, and no frame has a scene.
TEST(KeptValues, AreNoneWhereOneIsWrong) {
  const std::string wrong = std::string(kScene) + "let bad = places[99]\n";
  const std::vector<Frame> kept = frames(wrong, true);
  EXPECT_EQ(kept, frames(wrong, false));
  EXPECT_NE(kept[0].messages, "");
  for (const Frame& frame : kept) EXPECT_EQ(frame.digest, 0u);
}

// A frame takes the same number of steps, and exceeds the limit in the same place.
TEST(KeptValues, CountForTheLimitOfSteps) {
  const std::string more = "for i in range(0, if time < 0.25s then 0 else 40) { if i < 0 {} }\n";
  const Document file("a.scene", kScene + more);
  std::set<std::pair<int, bool>> outcomes;
  for (std::uint64_t steps = 10; steps < 2000; steps += 10) {
    const ProgramOptions options{.workspace = nullptr, .limits = {.steps = steps}, .sets = {}};
    DiagnosticSink sink;
    Compiler one(file, options, sink);
    for (const int frame : {2, 3}) {
      const bool kept = one.lower({}, frame).has_value();
      DiagnosticSink other_sink;
      EXPECT_EQ(kept, Compiler(file, options, other_sink).lower({}, frame).has_value()) << steps;
      outcomes.emplace(frame, kept);
    }
  }
  EXPECT_EQ(outcomes.size(), 4u);
}

}  // namespace
}  // namespace sdlc::lang
