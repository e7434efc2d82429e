#include <fmt/format.h>

#include "cli/report/section.hpp"

namespace sdlc::cli {

Section depth_section(const Report& report) {
  const render::Measurement& measurement = report.measurement;
  Section section;
  if (measurement.depths.empty()) return section;
  section.page_only(
      "<p>The same paths with each depth and with the greatest one measured. The light that a "
      "depth loses is missing with any number of samples. Most paths end by themselves, so depth "
      "is cheap if light can escape.</p>\n");
  Table table("Loss and cost of each depth",
              measurement.depths_have_converged
                  ? "#Depth|#Light lost|#Paths cut|#Time, relative"
                  : "#Depth|#Light lost, at least|#Paths cut|#Time, relative");
  for (const render::DepthLoss& depth : measurement.depths) {
    table.row({{fmt::to_string(depth.depth),
                depth.depth == measurement.own.depth ? "the scene's own" : ""},
               read(depth.loss, percent),
               percent(depth.cut_paths),
               times(depth.relative_seconds)});
  }
  section.table(table);
  return section;
}

}  // namespace sdlc::cli
