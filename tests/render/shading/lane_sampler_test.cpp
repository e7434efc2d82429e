#define HWY_COMPILE_ONLY_SCALAR
#include <array>
#include <cstdint>

#include <gtest/gtest.h>

#include "render/shading/lane_sampler-inl.h"
#include "tests/support/reference/path_sampler.hpp"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {
namespace {

using test::reference::PathSampler;
using D = Lanes<double>;
using DU = hn::RebindToUnsigned<D>;
using Words = std::array<std::uint64_t, 2>;

auto load(const Words& words) { return hn::Load(DU(), words.data()); }

std::array<double, 2> numbers(hn::Vec<D> lanes) {
  std::array<double, 2> numbers{};
  hn::Store(lanes, D(), numbers.data());
  return numbers;
}

// The other instruction sets are compared by their pictures.
TEST(LaneSampler, GivesTheNumbersOfTheReferenceInEveryLane) {
  for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::Independent}) {
    for (std::uint32_t sample = 0; sample < 200; ++sample) {
      const Words samples{sample, 1'000'003 * sample};
      const Words keys{stream_key(7, sample, 0), stream_key(7, 1'000'000'007ULL * sample, 3)};
      const PathSampler left(kind, keys[0], static_cast<std::uint32_t>(samples[0]));
      const PathSampler right(kind, keys[1], static_cast<std::uint32_t>(samples[1]));
      const LaneSampler<D> lanes(kind, load({left.start(), right.start()}),
                                 load({keys[0] >> 32, keys[1] >> 32}),
                                 reverse_lane_bits(load(samples)));
      for (const std::uint32_t index : {0u, 1u, 2u, 17u, 400u}) {
        const auto [first, second] = lanes.pair(index);
        const std::array firsts{left.pair(index).first, right.pair(index).first};
        ASSERT_EQ(numbers(first), firsts);
        ASSERT_EQ(numbers(second), (std::array{left.pair(index).second, right.pair(index).second}));
        ASSERT_EQ(numbers(lanes.first(index)), firsts);
      }
    }
  }
}

}  // namespace
}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
