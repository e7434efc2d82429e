#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/measure/against.hpp"
#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// Where a measurement comes from, as the page says at its end.
struct Provenance {
  std::string scene;    ///< name of the file
  std::string version;  ///< of sdlc, with its commit
  std::string command;  ///< with which it was made, as a shell takes it
  /// "processor", "cores", "memory", "system", "instruction set" …, with their values.
  std::vector<std::pair<std::string, std::string>> machine{};
};

/// A picture on the page.
struct ReportImage {
  std::string title;  ///< "16 samples, error 4.1 %"
  std::string png;    ///< bytes of the file
  int width = 0, height = 0;
};

/// Pictures that belong side by side: the same place with more and more samples.
struct ReportRow {
  std::string title;
  std::vector<ReportImage> images{};
};

struct Report {
  const render::Measurement& measurement;
  Provenance provenance{};
  ReportImage picture{};           ///< the reference, small
  std::vector<ReportRow> crops{};  ///< details; the reference is the last of each
  std::vector<ReportRow> error_maps{};
  double error_map_top = 0;  ///< the error of the brightest colour, relative to the mean
  std::optional<render::Comparison> against{};
  std::vector<std::string> notes{};  ///< what a reader has to know first: warnings, in sentences
};

/// The flags of `sdlc render` for a way and samples: those that differ from the scene's own, and
/// those that were given, without which it would be another picture.
std::string render_flags(const render::Measurement& measurement, const render::Way& way,
                         int samples);

/// "Sobol', light sampling on, float, depth 16".
std::string describe_way(const render::Way& way);

/// The same without what all series of the measurement share; all of it where nothing is left.
std::string describe_way(const render::Measurement& measurement, const render::Way& way);

/// The page: HTML of its own, without scripts and without a network.
std::string html_report(const Report& report);

}  // namespace sdlc::cli
