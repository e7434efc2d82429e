#include <optional>

#include <nlohmann/json.hpp>

#include "cli/frames.hpp"
#include "cli/inspect_report.hpp"
#include "cli/json_values.hpp"
#include "cli/kernel_options.hpp"
#include "cli/precision_json.hpp"
#include "render/image/tone.hpp"
#include "render/scene/depth_of_field.hpp"
#include "render/scene/instances.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

Json number_or_null(std::optional<double> number) { return number ? Json(*number) : Json(); }

Json animation_json(const InspectReport& report) {
  if (!report.animation) return nullptr;
  const auto& [first, last, step, fps, where] = *report.animation;
  return {{"first", first},
          {"last", last},
          {"step", step},
          {"count", frame_count({.first = first, .last = last, .step = step})},
          {"fps", fps}};
}

Json spheres_json(const InspectReport& report) {
  const render::Scene& scene = report.lowered.scene;
  Json json{{"count", render::count_spheres(scene)},
            {"instances", scene.instances.size()},
            {"prototypes", scene.prototypes.size()},
            {"moving", report.spheres ? report.spheres->moving : 0},
            {"dropped", report.lowered.dropped_spheres},
            {"bounds", nullptr},
            {"smallest", nullptr},
            {"largest", nullptr},
            {"radius_ratio", nullptr},
            {"extent", nullptr},
            {"scale_ratio", nullptr}};
  if (!report.spheres) return json;
  const SphereFigures& figures = *report.spheres;
  const auto sphere = [](const SphereFigures::Radius& radius) -> Json {
    return {{"radius", radius.radius}, {"sphere", radius.sphere ? Json(*radius.sphere) : Json()}};
  };
  json["bounds"] = {{"min", triple(figures.low)}, {"max", triple(figures.high)}};
  json["smallest"] = sphere(figures.smallest);
  json["largest"] = sphere(figures.largest);
  json["radius_ratio"] = figures.radius_ratio();
  if (!report.lowered.camera) return json;
  json["extent"] = figures.extent;
  json["scale_ratio"] = figures.scale_ratio();
  return json;
}

Json materials_json(const MaterialCounts& counts) {
  std::size_t distinct = 0;
  Json types = Json::object();
  for (const MaterialFigures& row : counts) {
    distinct += row.materials;
    types[std::string(material_name(row.type))] = {{"spheres", row.spheres},
                                                   {"distinct", row.materials}};
  }
  return {{"distinct", distinct}, {"types", std::move(types)}};
}

/// The depths at which the blur is within a pixel; infinity is null.
Json lens_json(const render::Camera& camera, int height) {
  Json json{{"aperture", camera.aperture}, {"focus_distance", camera.focus}};
  if (height <= 0) return json;
  const render::DepthOfField sharp = render::depth_of_field(camera, height, 1);
  json["sharp_from"] = sharp.from;
  json["sharp_to"] = sharp.to ? Json(*sharp.to) : Json();
  json["hyperfocal_distance"] = render::hyperfocal_distance(camera, height, 1);
  return json;
}

Json camera_json(const lang::LoweredScene& lowered) {
  if (!lowered.camera) return nullptr;
  const render::Camera& camera = lowered.scene.camera;
  Json json{{"name", text_or_null(lowered.camera->name)},
            {"from", triple(camera.from)},
            {"at", triple(camera.at)},
            {"up", triple(camera.up)},
            {"fov_degrees", lowered.camera->fov.degrees},
            {"view_height", lowered.camera->view_height},
            {"aspect", camera.aspect},
            {"lens", nullptr},
            {"shutter", nullptr}};
  if (camera.has_lens()) json["lens"] = lens_json(camera, lowered.settings.height);
  if (const auto& shutter = lowered.camera->shutter) {
    json["shutter"] = {{"open_seconds", shutter->from}, {"close_seconds", shutter->to}};
  }
  return json;
}

Json picture_json(const InspectReport& report) {
  const render::RenderSettings& settings = report.lowered.settings;
  const bool is_size_known = settings.width > 0;
  Json json{{"width", is_size_known ? Json(settings.width) : Json()},
            {"height", is_size_known ? Json(settings.height) : Json()},
            {"samples", settings.samples}};
  render::for_each_setting([&](const auto& setting) {
    json[std::string(setting.name)] = render::shown(settings.*setting.member);
  });
  json.update({{"error", number_or_null(settings.error)},
               {"seconds", number_or_null(settings.seconds)},
               {"adaptive", settings.is_adaptive},
               {"denoised", settings.is_denoised},
               {"sampled_lights", report.kernel.lights.size()},
               {"threads", settings.threads},
               {"tone", name_of(report.lowered.output.mapping.tone)},
               {"exposure", report.lowered.output.mapping.exposure},
               {"output", report.output ? Json(*report.output) : Json()}});
  return json;
}

Json memory_json(const InspectReport& report) {
  const MemoryFigures& memory = report.memory;
  const std::uint64_t count = render::count_spheres(report.lowered.scene);
  return {{"spheres_bytes", memory.spheres},
          {"motion_bytes", memory.motion},
          {"instances_bytes", memory.instances},
          {"materials_bytes", memory.materials},
          {"bvh_bytes_estimated", memory.bvh},
          {"picture_bytes", memory.picture},
          {"total_bytes", memory.total()},
          {"bytes_per_sphere", count > 0 ? Json(memory.per_sphere(count)) : Json()}};
}

Json precisions_json(const InspectReport& report) {
  using render::PrecisionClause;
  Json json = Json::object();
  for (const PrecisionFigures& figures : report.precisions) {
    Json bounds{{"is_accepted", figures.bounds.is_accepted()},
                {"deciding", name_of(figures.bounds.deciding())}};
    Json places = Json::array();
    for (const DecidingSphere& one : figures.deciding) places.push_back(location_json(one.where));
    bounds["locations"] = std::move(places);
    if (figures.precision == render::Precision::Mixed) {
      bounds["exact_spheres"] = figures.exact_spheres;
    }
    for (std::size_t i = 0; i < render::kPrecisionClauses; ++i) {
      const auto clause = static_cast<PrecisionClause>(i);
      const bool is_known = clause != PrecisionClause::Gap || figures.bounds.near_pairs.has_value();
      bounds[std::string(name_of(clause))] = is_known ? bound_json(figures.bounds[clause]) : Json();
    }
    json[std::string(name_of(figures.precision))] = std::move(bounds);
  }
  return json;
}

std::string dump(const Json& json) {
  // ASCII only: the output is safe on a terminal, and bytes that are not UTF-8 do not end it.
  constexpr bool kIsAscii = true;
  return json.dump(2, ' ', kIsAscii, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string to_json(const InspectReport& report) {
  const lang::LoweredScene& lowered = report.lowered;
  const render::Background& background = lowered.scene.background;
  Json cameras = Json::array();
  for (const std::string& name : lowered.cameras) cameras.push_back(text_or_null(name));
  Json frame, time;
  if (report.animation) {
    frame = report.frame;
    time = report.frame / report.animation->fps;
  }
  return dump({{"scene", report.scene},
               {"is_complete", report.errors == 0},
               {"dependencies", report.dependencies},
               {"animation", animation_json(report)},
               {"frame", frame},
               {"time_seconds", time},
               {"spheres", spheres_json(report)},
               {"materials", materials_json(report.materials)},
               {"cameras", std::move(cameras)},
               {"camera", camera_json(lowered)},
               {"background",
                {{"kind", background.is_constant() ? "color" : "gradient"},
                 {"bottom", triple(background.bottom)},
                 {"top", triple(background.top)}}},
               {"picture", picture_json(report)},
               {"features", report.features},
               {"precision", name_of(report.kernel.precision)},
               {"precision_bounds", precisions_json(report)},
               {"kernel", name_of(report.kernel)},
               {"kernel_reason", reason_for(report.kernel)},
               {"instruction_set", instruction_set(report.kernel)},
               {"memory", memory_json(report)},
               {"parse_seconds", report.times.parse_seconds},
               {"lower_seconds", report.times.lower_seconds}});
}

std::string to_json(std::span<const TracedSphere> spheres) {
  Json json = Json::array();
  for (const TracedSphere& traced : spheres) {
    Json chain = Json::array();
    for (const lang::ChainLink& link : traced.origin.chain) {
      chain.push_back({{"message", link.message}, {"location", location_json(link.where)}});
    }
    json.push_back({{"sphere", traced.index},
                    {"name", text_or_null(traced.origin.name)},
                    {"center", triple(traced.sphere.center)},
                    {"shift", triple(traced.shift)},
                    {"radius", traced.sphere.radius},
                    {"material", material_name(traced.material)},
                    {"location", location_json(traced.origin.where)},
                    {"chain", std::move(chain)}});
  }
  return dump(json);
}

std::string to_json(std::span<const std::string> files) {
  return dump(Json(std::vector<std::string>(files.begin(), files.end())));
}

}  // namespace sdlc::cli
