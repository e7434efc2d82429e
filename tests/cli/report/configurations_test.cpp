#include <string>

#include <gtest/gtest.h>

#include "cli/report/report.hpp"

namespace sdlc::cli {
namespace {

using enum render::SamplerKind;
using enum render::LightSampling;
using enum render::Precision;
using render::Configuration;

TEST(RenderFlags, SayWhatDiffersFromTheScenesOwn) {
  const Configuration own{
      .sampler = Sobol, .light_sampling = Auto, .precision = Float, .depth = 16};
  const struct {
    Configuration own, configuration;
    const char* flags;
  } cases[] = {
      {own, own, "--samples 64"},
      {own, {.sampler = Independent}, "--samples 64 --sampler independent"},
      {{.sampler = Independent}, own, "--samples 64 --sampler sobol"},
      {own, {.light_sampling = On}, "--samples 64 --light-sampling on"},
      {own, {.light_sampling = Off}, "--samples 64 --light-sampling off"},
      {own, {.precision = Double}, "--samples 64 --precision double"},
      {{.precision = Double}, own, "--samples 64 --precision float"},
      {{.precision = Double}, {.precision = Mixed}, "--samples 64 --precision float"},
      {own, {.precision = Mixed}, "--samples 64"},
      {{.precision = Mixed}, own, "--samples 64"},
      {own, {.depth = 64}, "--samples 64 --depth 64"},
      {own,
       {.sampler = Independent, .light_sampling = On, .precision = Double, .depth = 4},
       "--samples 64 --sampler independent --light-sampling on --precision double --depth 4"},
      {own, {.is_denoised = true}, "--samples 64 --denoise"},
  };
  for (const auto& [of, configuration, flags] : cases) {
    render::Measurement measurement;
    measurement.own = of;
    EXPECT_EQ(render_flags(measurement, configuration, 64), flags);
  }
}

TEST(DescribeConfiguration, NamesAllOfIt) {
  EXPECT_EQ(describe(Configuration{
                .sampler = Sobol, .light_sampling = On, .precision = Float, .depth = 16}),
            "sobol, light sampling on, float, depth 16");
  EXPECT_EQ(describe(Configuration{.sampler = Independent, .precision = Mixed, .depth = 4}),
            "independent, light sampling auto, mixed, depth 4");
  EXPECT_EQ(describe(Configuration{.depth = 4, .is_denoised = true}),
            "sobol, light sampling auto, float, depth 4, denoised");
}

TEST(DescribeConfiguration, AmongOthersLeavesOutWhatAllShare) {
  render::Measurement measurement;
  const auto add = [&](Configuration configuration) {
    measurement.series.push_back({.configuration = configuration, .points = {}, .slope = {}});
  };
  add({.sampler = Sobol});
  EXPECT_EQ(describe_configuration(measurement, measurement.series[0].configuration),
            "sobol, light sampling auto, float, depth 16");
  add({.sampler = Independent});
  EXPECT_EQ(describe_configuration(measurement, measurement.series[0].configuration), "sobol");
  add({.sampler = Sobol, .depth = 4});
  EXPECT_EQ(describe_configuration(measurement, measurement.series[2].configuration),
            "sobol, depth 4");
  add({.sampler = Sobol, .depth = 4, .is_denoised = true});
  EXPECT_EQ(describe_configuration(measurement, measurement.series[3].configuration),
            "sobol, depth 4, denoised");
}

}  // namespace
}  // namespace sdlc::cli
