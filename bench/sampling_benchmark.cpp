#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/sampling_benchmark.cpp"
#include <hwy/foreach_target.h>

// Random numbers and the directions made from them, for the scalar and the wide kernels.

#include "render/lanes/vector_math-inl.h"
#include "render/shading/lane_sampler-inl.h"

#ifndef SDLC_LANE_FUNCTION
#define SDLC_LANE_FUNCTION
namespace sdlc::render {
using LaneFunction = double(SamplerKind, std::uint32_t);
}
#endif

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

/// Calls `draw` with the samplers of many paths, one vector at a time, and sums the results, so
/// that the compiler cannot remove the work. `count`: number of paths, a multiple of the vector
/// size.
template <typename T, typename Draw>
HWY_INLINE double sum_over_paths(SamplerKind kind, std::uint32_t count, const Draw& draw) {
  const hn::ScalableTag<T> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const auto mixer = hn::Set(du, 0x5A17C0DE);
  const auto step = hn::Set(du, static_cast<hn::TFromD<decltype(du)>>(hn::Lanes(d)));
  auto key = hn::Iota(du, 1);
  auto sum = hn::Zero(d);
  for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(d))) {
    const LaneSampler<decltype(d)> sampler(kind, key, mixer, reverse_lane_bits(key));
    sum = hn::Add(sum, draw(sampler));
    key = hn::Add(key, step);
  }
  return static_cast<double>(hn::GetLane(hn::SumOfLanes(d, sum)));
}

template <typename T>
double lane_numbers(SamplerKind kind, std::uint32_t paths) {
  return sum_over_paths<T>(kind, paths, [](const auto& sampler) HWY_ATTR {
    auto sum = hn::Zero(hn::ScalableTag<T>());
    for (std::uint32_t i = 0; i < 4; ++i) {
      const auto pair = sampler.pair(i);
      sum = hn::Add(sum, hn::Add(pair.first, pair.second));
    }
    return sum;
  });
}

template <typename T>
double lane_directions(SamplerKind kind, std::uint32_t paths) {
  return sum_over_paths<T>(kind, paths, [](const auto& sampler) HWY_ATTR {
    const hn::ScalableTag<T> d;
    const auto [u, turn] = sampler.pair(kDirection);
    const auto circle = hn::Sqrt(hn::Mul(u, hn::Sub(hn::Set(d, T{1}), u)));
    auto x = hn::Zero(d), y = hn::Zero(d);
    point_on_circle(turn, hn::Add(circle, circle), x, y);
    return hn::Add(hn::Add(x, y), hn::Sub(hn::Set(d, T{1}), hn::Add(u, u)));
  });
}

LaneFunction* lane_function(bool is_double, bool is_direction) {
  if (is_double) return is_direction ? &lane_directions<double> : &lane_numbers<double>;
  return is_direction ? &lane_directions<float> : &lane_numbers<float>;
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <string>

#include <benchmark/benchmark.h>

#include "bench/benchmarks.hpp"

namespace sdlc::render {
namespace {

HWY_EXPORT(lane_function);
LaneFunction* portable_function(bool is_double, bool is_direction) {
  return HWY_STATIC_DISPATCH(lane_function)(is_double, is_direction);
}
/// With the only supported instruction set.
LaneFunction* vector_function(bool is_double, bool is_direction) {
  return HWY_DYNAMIC_DISPATCH(lane_function)(is_double, is_direction);
}

}  // namespace
}  // namespace sdlc::render

namespace sdlc::bench {
namespace {

using render::LaneFunction;
using render::SamplerKind;

constexpr std::uint32_t kPaths = 1 << 14;
constexpr std::uint32_t kNumbersAPath = 8;

void register_drawing(const std::string& name, LaneFunction* draw, double drawn_a_path) {
  for (const SamplerKind kind : {SamplerKind::Independent, SamplerKind::Sobol}) {
    const std::string sampler = kind == SamplerKind::Sobol ? "sobol/" : "independent/";
    benchmark::RegisterBenchmark(("sampling/" + sampler + name).c_str(), [=](benchmark::State&
                                                                                 state) {
      for (auto _ : state) benchmark::DoNotOptimize(draw(kind, kPaths));
      using benchmark::Counter;
      state.counters["drawn"] = Counter(drawn_a_path * kPaths, Counter::kIsIterationInvariantRate);
    })->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

void register_sampling_benchmarks() {
  const auto add = [](const std::string& form, auto* function, bool is_double) {
    register_drawing("numbers/" + form, function(is_double, false), kNumbersAPath);
    register_drawing("directions/" + form, function(is_double, true), 1);
  };
  add("portable", &render::portable_function, true);
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    for (const bool is_double : {false, true}) {
      const char* precision = is_double ? "/double" : "/float";
      add(std::string(hwy::TargetName(target)) + precision, &render::vector_function, is_double);
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace sdlc::bench
#endif
