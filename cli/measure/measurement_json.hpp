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

/// A measurement as JSON; docs/measure.md has the fields. `scene_digest`: of the scene that was
/// measured.
std::string to_json(const Report& report, const std::string& scene_digest);

/// What of an earlier measurement a later one is held against.
struct EarlierMeasurement {
  std::string version;
  std::string scene_digest;
  int width = 0, height = 0;  ///< that were measured
  int full_width = 0, full_height = 0;
  std::uint64_t seed = 0;
  int threads = 0;
  bool is_complete = false;
  std::vector<std::pair<std::string, std::string>> machine{};
  std::vector<render::Point> points{};
};

/// Reads what to_json wrote. Throws std::invalid_argument with the reason where the text is no
/// such thing.
EarlierMeasurement read_measurement(std::string_view text);

}  // namespace sdlc::cli
