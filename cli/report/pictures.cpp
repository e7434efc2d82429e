#include <fmt/format.h>

#include "cli/report/figures.hpp"
#include "cli/report/html.hpp"
#include "cli/report/section.hpp"
#include "render/compare/color_map.hpp"
#include "render/image/tone.hpp"
#include "render/math/color.hpp"

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

/// From zero error to the brightest colour.
std::string color_bar(double top) {
  constexpr int kStops = 16;
  std::string stops;
  for (int i = 0; i <= kStops; ++i) {
    const double share = static_cast<double>(i) / kStops;
    const render::LinearRgb color = render::mapped_color(share);
    const auto code = [](double v) { return to_code8(render::Tone::Srgb, v); };
    stops += fmt::format("<stop offset=\"{:.4f}\" stop-color=\"#{:02x}{:02x}{:02x}\"/>", share,
                         code(color.r), code(color.g), code(color.b));
  }
  return fmt::format(
      "<figure class=\"color-bar\"><svg viewBox=\"0 0 100 6\" preserveAspectRatio=\"none\" "
      "aria-hidden=\"true\"><defs><linearGradient id=\"colors\">{}</linearGradient></defs>"
      "<rect width=\"100\" height=\"6\" fill=\"url(#colors)\"/></svg>\n<figcaption><span>0</span> "
      "<span>the error of a pixel, relative to the mean of the reference</span> "
      "<span>{}</span></figcaption></figure>\n",
      stops, percent(top));
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
  if (!report.error_maps.empty()) section.page_only(color_bar(report.error_map_top));
  return section;
}

}  // namespace sdlc::cli
