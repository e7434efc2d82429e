#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/measure/against.hpp"
#include "render/measure/measurement.hpp"

namespace sdlc::cli {

/// The origin of a measurement, shown at the end of the page.
struct Provenance {
  std::string scene{};    ///< name of the file
  std::string version{};  ///< of sdlc, with its commit
  std::string command{};  ///< the command line, quoted for a shell
  std::string scene_digest{};
  /// "processor", "cores", "memory", "system", "instruction set" …, with their values.
  std::vector<std::pair<std::string, std::string>> machine{};
};

/// A picture on the page.
struct ReportImage {
  std::string title;  ///< "16 samples, error 4.1 %"
  std::string png;    ///< bytes of the file
  int width = 0, height = 0;
};

/// Pictures shown side by side: the same detail with increasing samples.
struct ReportRow {
  std::string title;
  std::vector<ReportImage> images{};
};

struct Report {
  const render::Measurement& measurement;
  Provenance provenance{};
  ReportImage picture{};           ///< the reference, reduced
  std::vector<ReportRow> crops{};  ///< the last one of each row is the reference
  std::vector<ReportRow> error_maps{};
  double error_map_top = 0;  ///< the error of the brightest colour, relative to the mean
  std::optional<render::Comparison> against{};
  std::vector<std::string> notes{};  ///< what a reader has to know first: warnings, as sentences
};

/// The flags of `sdlc render` for a configuration and samples: those that differ from the scene's
/// own, and those that were given and affect the picture.
std::string render_flags(const render::Measurement& measurement,
                         const render::Configuration& configuration, int samples);

/// Fills in Recommendation::flags.
void add_flags(render::Measurement& measurement);

/// A configuration without the parts that all series of the measurement share; complete if nothing
/// would be left.
std::string describe_configuration(const render::Measurement& measurement,
                                   const render::Configuration& configuration);

/// The page: self-contained HTML, without scripts and network access.
std::string html_report(const Report& report);

/// The report for a terminal.
std::string text_report(const Report& report);

}  // namespace sdlc::cli
