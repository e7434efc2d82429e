#include "cli/inspect_film.hpp"

#include <filesystem>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/accuracy_report.hpp"
#include "cli/film_result.hpp"
#include "cli/frames.hpp"
#include "cli/numbers/format_numbers.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/film_file.hpp"
#include "render/scene/settings.hpp"
#include "render/session/render_film.hpp"

namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json film_json(const std::string& path, const render::StoredFilm& film,
               const render::RenderResult& result) {
  const auto& [origin, record] = std::tie(film.origin, film.record);
  Json json{{"film", path},
            {"bytes", std::filesystem::file_size(path)},
            {"program", origin.program},
            {"scene", record.scene},
            {"frame", record.frame ? Json(*record.frame) : Json()},
            {"width", origin.width},
            {"height", origin.height},
            {"crop", {origin.crop.x, origin.crop.y, origin.crop.width, origin.crop.height}},
            {"samples", record.samples},
            {"error_goal", record.error > 0 ? Json(record.error) : Json()},
            {"adaptive", record.is_adaptive}};
  const render::RenderSettings settings = settings_of(film);
  render::for_each_setting([&](const auto& setting) {
    json[std::string(setting.name)] = render::shown(settings.*setting.member);
  });
  json.update({{"precision", name_of(origin.precision)},
               {"arithmetic", origin.arithmetic},
               {"has_first_hits", origin.has_first_hits},
               {"shards", record.shards},
               {"shard_by", record.shards > 1 ? Json(name_of(record.cut)) : Json()},
               {"finished_shards", film.shards},
               {"missing_shards", missing_shards(film)},
               {"camera_samples", result.camera_samples},
               {"rays", film.statistics.rays},
               {"least_samples", result.min_samples},
               {"most_samples", result.max_samples},
               {"relative_error", result.error ? Json(result.error->relative_error) : Json()}});
  return json;
}

std::string film_text(const std::string& path, const render::StoredFilm& film,
                      const render::RenderResult& result) {
  const auto& [origin, record] = std::tie(film.origin, film.record);
  std::string text;
  const auto row = [&](std::string_view label, const std::string& value) {
    text += fmt::format("{:<12}{}\n", label, value);
  };
  row("film",
      fmt::format("{}, {}, by {}", lang::printable(path),
                  format_bytes(std::filesystem::file_size(path)), lang::printable(origin.program)));
  row("scene", lang::printable(record.scene) +
                   (record.frame ? fmt::format(", frame {}", *record.frame) : ""));
  const render::PixelWindow& crop = origin.crop;
  const render::RenderSettings settings = settings_of(film);
  row("picture", fmt::format("{} x {} pixels{}", origin.width, origin.height,
                             settings.crop ? fmt::format(", of which {} x {} from ({}, {})",
                                                         crop.width, crop.height, crop.x, crop.y)
                                           : ""));
  row("samples",
      result.is_complete
          ? fmt::format("{}{}", describe_samples(result), describe_error(result))
          : fmt::format("{} of {}", format_count(static_cast<double>(result.camera_samples)),
                        format_count(static_cast<double>(record.samples) *
                                     static_cast<double>(crop.pixels()))));
  if (record.error > 0) row("goal", fmt::format("error {} %", 100 * record.error));
  const std::vector<std::uint32_t> missing = missing_shards(film);
  if (record.shards > 1) {
    row("shards", fmt::format("{} of {} of the {}: {}", film.shards.size(), record.shards,
                              name_of(record.cut),
                              film.shards.empty()
                                  ? "not finished"
                                  : describe_frames({film.shards.begin(), film.shards.end()})));
  } else if (!missing.empty()) {
    row("state", "not finished");
  }
  std::string words = fmt::format("{} precision", name_of(origin.precision));
  render::for_each_setting([&](const auto& setting) {
    words += fmt::format(", {}{}{}", setting.label, setting.label.empty() ? "" : " ",
                         render::shown(settings.*setting.member));
  });
  words += fmt::format(", tone {}, exposure {}", name_of(record.tone), record.exposure);
  if (origin.has_first_hits) words += ", with normals, depth and albedo";
  row("settings", words);
  return text;
}

}  // namespace

std::string inspect_film(const std::string& path, bool is_json) {
  const render::StoredFilm film = render::read_film_file(path);
  const render::RenderResult result = film_result(film);
  return is_json
             ? film_json(path, film, result).dump(2, ' ', false, Json::error_handler_t::replace) +
                   "\n"
             : film_text(path, film, result);
}

}  // namespace sdlc::cli
