#include "tests/cli/report/sample_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "render/image/image.hpp"

namespace sdlc::test {
namespace {

using render::Measured;

/// From -1 to 1, from a hash of the number.
double noise(std::uint32_t number) {
  number = (number ^ 61u ^ number >> 16) * 9u;
  number = (number ^ number >> 4) * 0x27d4eb2du;
  return static_cast<double>(number ^ number >> 15) / 0x80000000u - 1;
}

Measured around(double value, double relative) {
  return {.value = value, .interval = {value * (1 - relative), value * (1 + relative)}};
}

/// The cost and accuracy of a configuration: seconds and error of one sample, and the slope of the
/// error.
struct Law {
  render::Configuration configuration;
  double seconds, error, slope, bias;
};

void add_series(render::Measurement& measurement, const Law& law, int first, int count) {
  render::Series series{
      .configuration = law.configuration, .points = {}, .slope = around(law.slope, -0.04)};
  for (int i = 0; i < count; ++i) {
    const int samples = first << (2 * i);
    const auto number = static_cast<std::uint32_t>(measurement.points.size());
    render::Point point;
    point.configuration = law.configuration;
    point.samples = samples;
    const double seconds = 0.05 + law.seconds * samples * (1 + 0.03 * noise(number));
    point.seconds = around(seconds, samples < 64 ? 0.12 : 0.04);
    point.timings = {point.seconds.interval.from, seconds, point.seconds.interval.to};
    point.samples_per_second = 400.0 * 225 * samples / seconds;
    point.rays_per_second = 2.95 * point.samples_per_second;
    const double error = std::hypot(law.error * std::pow(samples, law.slope), law.bias);
    point.error = around(error * (1 + 0.05 * noise(number + 100)), samples < 16 ? 0.2 : 0.06);
    point.difference = {.rmse = 0.4 * error,
                        .relative_error = error,
                        .relative_mse = error * error,
                        .trimmed_relative_mse = 0.3 * error * error,
                        .psnr = 30,
                        .largest = {.value = 12 * error * noise(number + 7),
                                    .x = 211,
                                    .y = 97,
                                    .channel = static_cast<int>(number % 3)}};
    point.flip = 0.6 * std::sqrt(error);
    point.cut_paths = law.configuration.depth > 8 ? 0.0004 : 0.031;
    point.scarce_emitters =
        law.configuration.light_sampling == render::LightSampling::Off && samples < 64;
    series.points.push_back(measurement.points.size());
    measurement.points.push_back(point);
  }
  measurement.series.push_back(std::move(series));
}

void judge(std::vector<render::Point>& points) {
  for (render::Point& point : points) {
    for (const render::Point& other : points) {
      if (other.seconds.value < point.seconds.value && other.error.value < point.error.value) {
        const bool is_sure = other.seconds.interval.to < point.seconds.interval.from &&
                             other.error.interval.to < point.error.interval.from;
        const auto dominance =
            is_sure ? render::Dominance::Dominated : render::Dominance::NotDistinguished;
        point.dominance = std::max(point.dominance, dominance);
      }
    }
  }
}

/// A disc on a gradient, with grain.
std::string picture(int width, int height, double grain, double red) {
  render::Picture picture(width, height);
  std::uint32_t number = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double across = 2.0 * x / width - 1, down = (2.0 * y - height) / width;
      const double disc = std::hypot(across, down) < 0.4 ? 0.6 + 0.5 * across : 0;
      const double light = std::max(0.0, 0.3 - 0.3 * down + disc + grain * noise(++number));
      picture.at(x, y) = render::LinearRgb{light * red, light * 0.8, light};
    }
  }
  const auto bytes = render::encode_picture(picture, {});
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

cli::ReportRow row(std::string title, int width, int height, int count, double red) {
  cli::ReportRow row{.title = std::move(title), .images = {}};
  for (int i = 0; i < count; ++i) {
    const bool is_last = i + 1 == count;
    row.images.push_back({.title = is_last ? "reference"
                                           : fmt::format("{} samples, error {:.3g} %", 4 << (2 * i),
                                                         60 * std::pow(0.35, i)),
                          .png = picture(width, height, is_last ? 0 : 0.6 * std::pow(0.35, i), red),
                          .width = width,
                          .height = height});
  }
  return row;
}

}  // namespace

render::Measurement sample_measurement() {
  using enum render::SamplerKind;
  using enum render::LightSampling;
  render::Measurement measurement;
  measurement.own = {.sampler = Sobol, .light_sampling = Auto, .depth = 16};
  measurement.width = measurement.full_width = 400;
  measurement.height = measurement.full_height = 225;
  measurement.samples = 64;
  measurement.seed = 7;
  measurement.threads = 2;
  measurement.budget_seconds = 300;
  measurement.spent_seconds = 287;
  measurement.other_seconds = 0.034;
  measurement.is_complete = true;
  measurement.reference = render::Reference{.configuration = {.light_sampling = On, .depth = 64},
                                            .samples = 65536,
                                            .seed = 8,
                                            .seconds = 141,
                                            .error = around(0.0005, 0.2),
                                            .mean_radiance = 0.412};

  add_series(measurement, {measurement.own, 0.0172, 0.55, -0.62, 0.0004}, 4, 6);
  add_series(measurement,
             {{.sampler = Sobol, .light_sampling = On, .depth = 16}, 0.023, 0.50, -0.62, 0.0004}, 4,
             5);
  add_series(
      measurement,
      {{.sampler = Independent, .light_sampling = Auto, .depth = 16}, 0.0160, 0.75, -0.5, 0.0004},
      4, 5);
  add_series(measurement,
             {{.sampler = Sobol, .light_sampling = Off, .depth = 6}, 0.0110, 1.7, -0.55, 0.011}, 4,
             5);
  judge(measurement.points);

  for (const int depth : {2, 4, 8, 16, 32, 64}) {
    const double loss = depth == 64 ? 0 : std::exp(-0.35 * depth);
    measurement.depths.push_back(
        {.depth = depth,
         .loss = {.value = loss, .interval = {loss * 0.9 - 1e-5, loss * 1.1}},
         .relative_seconds = (1 - 0.6 * std::exp(-0.2 * depth)) / (1 - 0.6 * std::exp(-3.2)),
         .cut_paths = 2 * loss});
  }
  measurement.depths_have_converged = true;
  measurement.precision = render::PrecisionDifference{
      .refusal = {},
      .mean_difference = {.value = -2e-5, .interval = {-6e-5, 2e-5}},
      .rms_difference = 0.0021,
      .relative_seconds = 1.83,
      .bound = "a hit is off by 0.0021 of the smallest radius, where 0.01 is allowed"};
  for (const int threads : {1, 2, 3, 4, 6, 8}) {
    const double speed_up = threads / (1 + 0.03 * (threads - 1));
    measurement.thread_scaling.push_back({.threads = threads,
                                          .seconds = around(4.2 / speed_up, 0.03),
                                          .speed_up = around(speed_up, threads > 1 ? 0.02 : 0)});
  }
  measurement.thread_scaling_samples = 128;
  measurement.recommendations = {{.goal = 0.05,
                                  .configuration = measurement.own,
                                  .samples = 48,
                                  .relative_error = around(0.0498, 0.05),
                                  .seconds = around(0.876, 0.06)},
                                 {.goal = 0.01,
                                  .configuration = measurement.own,
                                  .samples = 1024,
                                  .is_measured = true,
                                  .relative_error = around(0.0075, 0.05),
                                  .seconds = around(17.7, 0.05)},
                                 {.goal = 0.002,
                                  .configuration = {.light_sampling = On, .depth = 16},
                                  .samples = 7424,
                                  .relative_error = around(0.00197, 0.05),
                                  .seconds = around(171, 0.05)}};
  measurement.recommendations[1].is_main = true;
  cli::add_flags(measurement);
  measurement.left_out = {{.configuration = measurement.series[2].configuration,
                           .samples = 4096,
                           .reason = "its render would take 65 s, and 13 s are left"},
                          {.configuration = {.precision = render::Precision::Double},
                           .samples = 64,
                           .reason = "float and double are not distinguished"}};
  return measurement;
}

cli::Report sample_report(const render::Measurement& measurement) {
  cli::Report report = bare_report(measurement);
  report.provenance.machine = {{"processor", "AMD EPYC 9B14"},
                               {"cores", "2"},
                               {"memory", "23 GiB"},
                               {"system", "Linux 6.1"},
                               {"instruction set", "avx512"}};
  report.picture = {
      .title = "The reference", .png = picture(400, 225, 0, 0.9), .width = 400, .height = 225};
  report.crops = {row("Reflection in the glass ball", 48, 32, 6, 0.9),
                  row("Shadow under the table", 48, 32, 6, 0.4)};
  report.error_maps = {row("Where the error is", 200, 112, 3, 1)};
  report.error_map_top = 0.5;
  render::Comparison against{.version = "sdlc 0.1.0 (5b41410)",
                             .points = {},
                             .time_ratio = around(0.91, 0.04),
                             .time = render::Verdict::Better,
                             .worse_errors = 1,
                             .notes = {"the earlier one was made with seed 3"}};
  for (std::size_t i = 0; i < 4; ++i) {
    const render::Point& point = measurement.points[i];
    against.points.push_back(
        {.configuration = point.configuration,
         .samples = point.samples,
         .relative_error_before = around(point.error.value * (i == 2 ? 1.4 : 1.01), 0.06),
         .relative_error = point.error,
         .seconds_before = around(point.seconds.value / 0.91, 0.05),
         .seconds = point.seconds,
         .error = i == 2   ? render::Verdict::Better
                  : i == 3 ? render::Verdict::Worse
                           : render::Verdict::NotDistinguished});
  }
  report.against = std::move(against);
  return report;
}

cli::Report bare_report(const render::Measurement& measurement) {
  return {.measurement = measurement,
          .provenance = {.scene = "lamps.scene",
                         .version = "sdlc 0.1.0 (458dee6)",
                         .command = "sdlc measure lamps.scene --time 5min -o lamps.html",
                         .machine = {}},
          .picture = {},
          .crops = {},
          .error_maps = {},
          .against = {},
          .notes = {}};
}

}  // namespace sdlc::test
