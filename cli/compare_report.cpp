#include "cli/compare_report.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Four significant digits are enough to distinguish pictures; JSON has all digits.
std::string number(double v) { return fmt::format("{:.4g}", v); }

/// JSON has no infinity.
Json finite_or_null(double v) { return std::isfinite(v) ? Json(v) : Json(); }

std::string line(std::string_view name, const std::string& value, std::string_view remark = {}) {
  std::string text = fmt::format("  {:<20} {}", name, value);
  if (!remark.empty()) text = fmt::format("{:<36} {}", text, remark);
  return text + "\n";
}

std::string z_test_text(const render::ZTest& test) {
  const render::LinearRgb z = test.mean_z;
  return line("z of the means", fmt::format("{:.2f} {:.2f} {:.2f}", z.r, z.g, z.b),
              fmt::format("p = {:.3g}", test.mean_p)) +
         line("z of the noise", fmt::format("{:.2f}", test.noise_z),
              fmt::format("p = {:.3g}", test.noise_p));
}

Json z_test_json(const render::ZTest& test) {
  return {{"mean_z",
           {finite_or_null(test.mean_z.r), finite_or_null(test.mean_z.g),
            finite_or_null(test.mean_z.b)}},
          {"mean_p", test.mean_p},
          {"noise_z", test.noise_z},
          {"noise_p", test.noise_p}};
}

Json gates_json(const std::vector<Gate>& gates) {
  Json list = Json::array();
  for (const Gate& gate : gates) {
    list.push_back({{"name", gate.name},
                    {"limit", gate.limit},
                    {"value", finite_or_null(gate.value)},
                    {"passed", gate.passes()}});
  }
  return list;
}

}  // namespace

std::string_view CompareReport::channel_name() const noexcept {
  if (pair.picture.is_grey) return "grey";
  return render::kChannelNames[static_cast<std::size_t>(difference.largest.channel)];
}

std::string to_text(const CompareReport& report) {
  const render::Difference& d = report.difference;
  const render::LargestDifference& largest = d.largest;
  std::string text =
      fmt::format("{} against {}: {} x {} pixels, {}\n", lang::printable(report.pair.picture_name),
                  lang::printable(report.pair.reference_name), report.flip.width,
                  report.flip.height, report.pair.values());
  text += line("RMSE", number(d.rmse));
  text += line("relative error", fmt::format("{:.4g} %", 100 * d.relative_error),
               "RMSE / mean of the reference");
  text += line("relative MSE", number(d.relative_mse));
  text += line("  trimmed", number(d.trimmed_relative_mse),
               "descriptive: without the worst 1 % of pixels");
  text += line("PSNR", fmt::format("{:.4g} dB", d.psnr), "peak 1");
  text += line("FLIP", number(report.flip.mean),
               fmt::format("mean, at {:.4g} pixels per degree", report.pixels_per_degree));
  text += line("largest difference", number(largest.value),
               largest.value == 0
                   ? ""
                   : fmt::format("at ({}, {}), {}", largest.x, largest.y, report.channel_name()));
  if (report.z_test) text += z_test_text(*report.z_test);
  for (const std::string& note : report.pair.notes) text += fmt::format("note: {}\n", note);
  if (report.output) {
    text += fmt::format("{}: the {}", lang::printable(report.output->path),
                        report.output->what == "flip" ? "FLIP map" : "difference");
    if (report.output->top) {
      text += fmt::format(", brightest at {}", number(*report.output->top));
    }
    text += "\n";
  }
  return text;
}

std::string to_concise_text(const CompareReport& report) {
  const render::Difference& d = report.difference;
  std::string text = fmt::format(
      "rmse={:.6g} relative_error={:.6g} relative_mse={:.6g} relative_mse_trimmed={:.6g} "
      "psnr={:.6g} flip={:.6g} max_difference={:.6g}",
      d.rmse, d.relative_error, d.relative_mse, d.trimmed_relative_mse, d.psnr, report.flip.mean,
      d.largest.value);
  if (report.z_test) text += fmt::format(" max_z={:.6g}", report.z_test->largest());
  return text + "\n";
}

std::string to_json(const CompareReport& report) {
  const render::Difference& d = report.difference;
  Json json{{"a", report.pair.picture_name},
            {"b", report.pair.reference_name},
            {"width", report.flip.width},
            {"height", report.flip.height},
            {"values", report.pair.values()},
            {"rmse", d.rmse},
            {"relative_error", finite_or_null(d.relative_error)},
            {"relative_mse", d.relative_mse},
            {"relative_mse_trimmed", d.trimmed_relative_mse},
            {"psnr", finite_or_null(d.psnr)},
            {"flip", report.flip.mean},
            {"pixels_per_degree", report.pixels_per_degree},
            {"max_difference",
             {{"value", d.largest.value},
              {"x", d.largest.x},
              {"y", d.largest.y},
              {"channel", report.channel_name()}}},
            {"z_test", report.z_test ? z_test_json(*report.z_test) : Json()},
            {"gates", gates_json(report.gates)},
            {"notes", report.pair.notes},
            {"output", nullptr}};
  if (report.output) {
    json["output"] = {{"path", report.output->path},
                      {"what", report.output->what},
                      {"top", report.output->top ? Json(*report.output->top) : Json()}};
  }
  // File names may contain any bytes, JSON only UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sdlc::cli
