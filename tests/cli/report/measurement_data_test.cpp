#include "cli/measure/measurement_data.hpp"

#include <algorithm>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/report/sample_measurement.hpp"

namespace sdlc::cli {
namespace {

using nlohmann::json;
using test::sample_measurement;
using test::sample_report;

TEST(MeasurementData, IsReadBackForAComparison) {
  const render::Measurement measurement = sample_measurement();
  const Report report = sample_report(measurement);
  const EarlierMeasurement earlier = read_measurement(to_json(report));
  EXPECT_EQ(earlier.provenance.version, report.provenance.version);
  EXPECT_EQ(earlier.provenance.machine, report.provenance.machine);
  EXPECT_EQ(earlier.measurement.full_height, 225);
  EXPECT_EQ(earlier.measurement.seed, 7u);
  ASSERT_EQ(earlier.measurement.points.size(), measurement.points.size());
  for (std::size_t i = 0; i < measurement.points.size(); ++i) {
    const render::Point &expected = measurement.points[i], &point = earlier.measurement.points[i];
    EXPECT_EQ(point.configuration, expected.configuration);
    EXPECT_EQ(point.samples, expected.samples);
    EXPECT_EQ(point.timings, expected.timings);
    EXPECT_EQ(point.error.interval, expected.error.interval);
    EXPECT_EQ(point.difference.largest.channel, expected.difference.largest.channel);
    EXPECT_EQ(point.dominance, expected.dominance);
  }
}

TEST(MeasurementData, IsReadFromVersionsThatDidNotWriteRays) {
  const render::Measurement measurement = sample_measurement();
  json report = json::parse(to_json(sample_report(measurement)));
  for (json& point : report["points"]) {
    point.erase("rays");
    point.erase("denoise");
  }
  EXPECT_EQ(read_measurement(report.dump()).measurement.points.size(), measurement.points.size());
}

TEST(MeasurementData, HasTheSameFiguresInCsv) {
  render::Measurement measurement = sample_measurement();
  measurement.points[0].difference.psnr = INFINITY;
  std::istringstream csv(to_csv(measurement));
  std::string names, first;
  std::getline(csv, names);
  std::getline(csv, first);
  EXPECT_EQ(names,
            "samples,sampler,light_sampling,precision,depth,denoise,seconds,seconds_from,seconds_"
            "to,timings,"
            "samples_per_second,rays_per_second,relative_error,relative_error_from,"
            "relative_error_to,relative_error_spread,rmse,relative_mse,relative_mse_trimmed,psnr,"
            "flip,max_difference,max_difference_x,max_difference_y,cut_paths,scarce_emitters,"
            "standing,rays\r");
  EXPECT_EQ(std::ranges::count(first, ','), std::ranges::count(names, ','));
  EXPECT_THAT(first, testing::StartsWith("4,sobol,auto,float,16,false,0.1"));
  EXPECT_THAT(first, testing::HasSubstr(",,0.28953"));  // JSON and CSV have no infinity
  EXPECT_THAT(first, testing::EndsWith(",211,97,0.0004,0,front,0\r"));
}

}  // namespace
}  // namespace sdlc::cli
