#include "cli/serve_messages.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "cli/accuracy_report.hpp"
#include "cli/scene_figures.hpp"
#include "cli/shell_quote.hpp"
#include "lang/object/value.hpp"
#include "render/film/first_hits.hpp"
#include "render/image/tone.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

Json error_json(const std::optional<render::ErrorEstimate>& error) {
  if (!error) return nullptr;
  return {
      {"value", error->relative_error}, {"from", error->interval.from}, {"to", error->interval.to}};
}

Json params_json(const std::vector<ServedParam>& params, const ServeChoices& choices) {
  Json all = Json::array();
  for (const ServedParam& param : params) {
    const auto chosen = choices.params.find(param.name);
    all.push_back({{"name", param.name},
                   {"type", param.type},
                   {"default", text_or_null(param.default_value)},
                   {"value", chosen == choices.params.end() ? Json() : Json(chosen->second)},
                   {"hex", text_or_null(param.hex)},
                   {"documentation", param.documentation}});
  }
  return all;
}

Json findings_json(const std::vector<ServedFinding>& findings) {
  Json all = Json::array();
  for (const ServedFinding& finding : findings) {
    all.push_back({{"severity", finding.is_error ? "error" : "warning"},
                   {"code", finding.code},
                   {"message", finding.message},
                   {"help", finding.help},
                   {"text", finding.text},
                   {"place", place_json(finding.where)}});
  }
  return all;
}

Json camera_json(const ServedScene& scene) {
  if (!scene.lowered.camera) return nullptr;
  const render::Camera& camera = scene.lowered.scene.camera;
  return {{"name", text_or_null(scene.lowered.camera->name)},
          {"from", triple(camera.from)},
          {"at", triple(camera.at)},
          {"up", triple(camera.up)},
          {"text", camera_text(scene)}};
}

}  // namespace

Json place_json(const lang::Location& where) {
  Json place = location_json(where);
  if (where.file == nullptr) return place;
  std::error_code ignored;
  place["path"] = fs::absolute(where.file->name(), ignored).lexically_normal().string();
  return place;
}

Json scene_json(std::uint64_t number, const ServedScene& scene, const ServedScene* shown,
                const ServeChoices& choices, const std::string& command, bool has_editor) {
  Json animation;
  if (scene.animation) {
    animation = {{"first", scene.animation->first},
                 {"last", scene.animation->last},
                 {"step", scene.animation->step},
                 {"fps", scene.animation->fps}};
  }
  return {{"type", "scene"},
          {"scene", number},
          {"name", scene.source ? Json(scene.source->name()) : Json()},
          {"is_correct", scene.prepared != nullptr},
          {"failure", text_or_null(scene.failure)},
          {"errors", scene.errors},
          {"findings", findings_json(scene.findings)},
          {"params", params_json(scene.params, choices)},
          {"animation", std::move(animation)},
          {"frame", choices.frame ? Json(*choices.frame) : Json()},
          {"camera", choices.camera ? Json(*choices.camera) : Json()},
          {"cameras", scene.cameras},
          {"has_pose", choices.pose.has_value()},
          {"command", command},
          {"has_editor", has_editor},
          {"shown", shown != nullptr ? Json{{"camera", camera_json(*shown)}} : Json()}};
}

Json progress_json(const ServeRender::Progress& progress) {
  return {{"type", "progress"},
          {"is_running", progress.is_running},
          {"is_paused", progress.is_paused},
          {"share", progress.share},
          {"seconds_left",
           std::isfinite(progress.seconds_left) ? Json(progress.seconds_left) : Json()}};
}

std::string picture_message(const ServedPicture& picture, const PictureView& view) {
  const render::RenderResult& result = picture.result;
  Json warnings = Json::array();
  if (result.min_samples >= render::kMinReplicatedSamples) {
    render::RenderSettings settings = picture.settings;
    if (!picture.is_finished) {  // what it does not have may come
      settings.error.reset();
      settings.is_denoised = false;
    }
    warnings = accuracy_warnings(settings, result);
  }
  const Json header{
      {"scene", picture.scene},
      {"width", result.picture.width},
      {"height", result.picture.height},
      {"full_width", picture.width()},
      {"full_height", picture.height()},
      {"channel", kServedChannels[static_cast<std::size_t>(view.channel)]},
      {"has_channel", has_channel(picture, view.channel)},
      {"exposure", view.exposure},
      {"samples", describe_samples(result)},
      {"error", error_json(result.error)},
      {"plain_error", error_json(result.plain_error)},
      {"is_error_unknown", !result.error && result.min_samples >= render::kMinReplicatedSamples},
      {"warnings", std::move(warnings)},
      {"is_finished", picture.is_finished},
      {"seconds", picture.seconds}};
  const std::string text = to_line(header);
  const std::vector<std::uint8_t> codes = codes_of(picture, view.channel, view.exposure);
  std::string message;
  message.reserve(4 + text.size() + codes.size());
  for (int shift = 0; shift < 32; shift += 8) {
    message += static_cast<char>(text.size() >> shift & 0xFFu);
  }
  message += text;
  message.append(codes.begin(), codes.end());
  return message;
}

Json pixel_json(const ServedPicture& picture, int x, int y) {
  Json json{{"type", "pixel"}, {"x", x}, {"y", y}};
  const render::RenderResult& result = picture.result;
  if (x < 0 || y < 0 || x >= picture.width() || y >= picture.height() || picture.is_first_look()) {
    return json;
  }
  const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width()) +
                 static_cast<std::size_t>(x);
  const render::LinearRgb radiance = result.picture.pixels[i];
  json["radiance"] = triple(radiance);
  json["codes"] = to_codes8(picture.mapping, radiance);
  if (!result.variance.pixels.empty()) {
    const render::LinearRgb& v = result.variance.pixels[i];
    json["standard_error"] = Json::array({std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)});
  }
  if (!result.features.empty()) {
    const render::PixelFeatures& features = result.features[i];
    json["normal"] = triple(features.normal);
    json["depth"] = features.depth == render::kNoDepth ? Json() : Json(features.depth);
    json["albedo"] = triple(features.albedo);
  }
  json["samples"] =
      result.samples_of_pixels.empty() ? result.min_samples : result.samples_of_pixels[i];
  return json;
}

Json sphere_json(const render::Scene& scene, const render::PickedSphere& picked,
                 const lang::Origin* origin) {
  render::Sphere sphere;
  if (picked.instance) {
    const render::Instance& instance = scene.instances[*picked.instance];
    sphere = placed(instance, scene.prototypes[instance.prototype].spheres[picked.sphere]);
  } else {
    sphere = scene.spheres[picked.sphere];
  }
  Json json{{"index", picked.instance ? Json() : Json(picked.sphere)},
            {"center", triple(sphere.center)},
            {"radius", sphere.radius},
            {"distance", picked.distance},
            {"material", material_name(scene.materials[sphere.material].type)}};
  if (origin == nullptr) return json;
  Json chain = Json::array();
  for (const lang::ChainLink& link : origin->chain) {
    chain.push_back({{"text", link.message}, {"place", place_json(link.where)}});
  }
  json["name"] = text_or_null(origin->name);
  json["place"] = place_json(origin->where);
  json["material_place"] = place_json(origin->material);
  json["chain"] = std::move(chain);
  return json;
}

std::string render_command(std::span<const std::string> arguments, const ServeChoices& choices) {
  std::string command = "sdlc render";
  const auto add = [&](std::string_view argument) { command += " " + shell_quoted(argument); };
  // Those of `serve` alone, and those that the choices replace.
  const auto is_replaced = [&](std::string_view flag, std::string_view value) {
    return flag == "--port" || (flag == "--camera" && choices.camera) ||
           (flag == "--set" &&
            choices.params.contains(std::string(value.substr(0, value.find('=')))));
  };
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (argument == "--editor") continue;
    const std::size_t equal = argument.find('=');
    const bool is_joined = argument.starts_with("--") && equal != std::string::npos;
    const std::string flag = is_joined ? argument.substr(0, equal) : argument;
    const bool has_value = is_joined || i + 1 < arguments.size();
    const std::string value = is_joined   ? argument.substr(equal + 1)
                              : has_value ? arguments[i + 1]
                                          : "";
    if (is_replaced(flag, value)) {
      if (!is_joined) ++i;
      continue;
    }
    add(argument);
  }
  for (const auto& [name, value] : choices.params) {
    add("--set");
    add(fmt::format("{}={}", name, value));
  }
  if (choices.camera) {
    add("--camera");
    add(*choices.camera);
  }
  if (choices.frame) add(fmt::format("--frames={}", *choices.frame));
  return command;
}

}  // namespace sdlc::cli
