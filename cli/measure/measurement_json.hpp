#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/report/report.hpp"
#include "render/measure/against.hpp"
#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// A measurement as JSON; docs/measure.md lists the fields. `scene_digest` is that of the measured
/// scene.
std::string to_json(const Report& report, const std::string& scene_digest);

/// The parts of an earlier measurement that are needed for a comparison.
struct EarlierMeasurement {
  std::string version;
  std::string scene_digest;
  int width = 0, height = 0;  ///< measured size
  int full_width = 0, full_height = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  bool is_complete = false;
  std::vector<std::pair<std::string, std::string>> machine{};
  std::vector<render::Point> points{};
};

/// Reads the output of to_json. Throws std::invalid_argument with the reason if the text is
/// something else.
EarlierMeasurement read_measurement(std::string_view text);

}  // namespace sdlc::cli
