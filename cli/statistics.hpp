#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "lang/compile/compile.hpp"
#include "render/session/render.hpp"

namespace sdlc::cli {

/// Data about one picture for `render --stats`, in addition to the counts of the render.
struct RenderStatistics {
  bool is_merged = false;     ///< from films: what one machine measured is null
  std::string scene;          ///< the file, as the user named it
  std::uint64_t spheres = 0;  ///< those of instances among them
  std::size_t instances = 0;
  std::vector<std::string> features;  ///< what the scene required, see required_features
  render::RenderSettings settings;
  lang::CompileTimes compile;
  double write_seconds = 0;
  std::size_t render_rss_bytes = 0;  ///< while tracing
};

/// The statistics as one line of JSON; its field names are fixed.
std::string to_json(const RenderStatistics& statistics, const render::RenderResult& result);

}  // namespace sdlc::cli
