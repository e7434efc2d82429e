#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"

namespace sdlc::cli {
namespace {

std::string picture_row(const ReportRow& row, const char* of) {
  std::string html = fmt::format("<h3>{}</h3>\n<div class=\"row {}\">\n", escaped(row.title), of);
  for (const ReportImage& image : row.images) {
    html += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture_element(image),
                        escaped(image.title));
  }
  return html + "</div>\n";
}

}  // namespace

std::string picture_element(const ReportImage& image) {
  if (image.png.empty()) return "";
  return fmt::format(
      "<img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" alt=\"{}\"/>",
      base64(image.png), image.width, image.height, escaped(image.title));
}

Section pictures_section(const Report& report) {
  Section section;
  for (const ReportRow& row : report.crops) section.page_only(picture_row(row, "crops"));
  for (const ReportRow& row : report.error_maps) section.page_only(picture_row(row, "maps"));
  if (!report.error_maps.empty()) {
    section.page_only(fmt::format(
        "<p class=\"fine\">Error maps: black is no error, the brightest colour {} of the mean of "
        "the reference, or more.</p>\n",
        percent(report.error_map_top)));
  }
  return section;
}

}  // namespace sdlc::cli
