#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/json_values.hpp"
#include "lang/compile/compile.hpp"
#include "lang/object/check.hpp"
#include "lang/schema/schema.hpp"
#include "render/film/film_file.hpp"
#include "render/image/image.hpp"
#include "render/kernel/backend.hpp"
#include "render/kernel/kernel.hpp"
#include "render/math/clock.hpp"
#include "render/session/prepared_scene.hpp"
#include "render/session/render.hpp"
#include "render/session/render_film.hpp"
#include "wasm/calls.hpp"
#include "wasm/render_step.hpp"

namespace sdlc::wasm {
namespace {

/// A scene, its film, and what is known of its picture.
class RenderSession {
 public:
  explicit RenderSession(const Json& parameters);

  /// What start_render() returns.
  Json description();
  bool can_render() const noexcept { return prepared_.has_value(); }
  Json step(double seconds);
  Json pick(int x, int y);
  std::span<const std::uint8_t> pixels() const noexcept { return pixels_; }

 private:
  void show(const render::RenderResult& result);

  lang::DiskFileSystem disk_;
  lang::Workspace workspace_{disk_};
  lang::DiagnosticSink sink_;
  std::shared_ptr<const lang::Document> document_;
  std::optional<lang::Compiler> compiler_;
  std::optional<lang::Animation> animation_;
  lang::LoweredScene lowered_;
  std::optional<render::PreparedScene> prepared_;
  render::StoredFilm film_;
  render::Clock::time_point start_;
  std::optional<render::ErrorEstimate> error_;  // after the last pass
  double share_ = 0;                            // of the goal
  std::vector<std::uint8_t> pixels_;
};

RenderSession::RenderSession(const Json& parameters) : start_(render::Clock::now()) {
  const lang::ProgramOptions options = program_options(parameters, workspace_);
  document_ = read_file(parameters, options);
  compiler_.emplace(*document_, options, sink_);
  animation_ = compiler_->animation();
  std::optional<int> frame;
  if (parameters.contains("frame")) frame = parameters.at("frame").get<int>();
  const lang::Overrides overrides = overrides_of(parameters);
  auto lowered = compiler_->lower(overrides, frame);
  if (!lowered) return;
  lowered_ = *std::move(lowered);
  render::KernelRequest request = request_of(parameters);
  request.precision = lowered_.precision;
  request.may_take_double = !overrides.has(lang::render_property::kPrecision);
  render::Kernel kernel = render::choose_kernel(lowered_.scene, lowered_.settings, request);
  if (kernel.refusal) throw WrongParameter(describe(kernel.refusal->obstacle));
  if (lowered_.camera) {
    compiler_->warn_of_precision(lowered_, kernel.precision, kernel.bounds);
  }
  prepared_.emplace(std::move(kernel), lowered_.scene, lowered_.settings.threads);
  film_ = render::new_film(*prepared_, {}, "sdlc", lowered_.settings);
}

Json RenderSession::description() {
  Json answer{{"findings", findings_json(sink_)}, {"cameras", lowered_.cameras}};
  if (animation_) {
    answer["animation"] = {{"first", animation_->first}, {"last", animation_->last}};
  }
  if (!prepared_) return answer;
  answer["width"] = lowered_.settings.width;
  answer["height"] = lowered_.settings.height;
  answer["spheres"] = lowered_.scene.spheres.size();
  answer["kernel"] = render::name_of(prepared_->kernel());
  answer["backend"] = prepared_->kernel().backend->name;
  return answer;
}

Json RenderSession::step(double seconds) {
  render::RenderMonitor monitor;
  monitor.on_pass = [&](const render::Film& /*film*/, const auto& error) {
    share_ = std::max(share_, monitor.goal_share.load());
    error_ = error().error;
  };
  const render::RenderResult result =
      render_step(*prepared_, lowered_.settings, monitor, film_, start_, seconds);
  if (result.is_complete) error_ = result.error;
  show(result);
  const render::RenderSettings& settings = lowered_.settings;
  const auto wanted = static_cast<double>(settings.window().pixels()) * settings.samples;
  Json answer{{"finished", result.is_complete},
              {"width", settings.width},
              {"height", settings.height},
              {"samples", result.camera_samples},
              {"rays", result.rays},
              {"share", settings.has_goal()
                            ? share_
                            : std::min(1.0, static_cast<double>(result.camera_samples) / wanted)},
              {"seconds", render::seconds_since(start_)},
              {"threads", result.threads}};
  if (error_) {
    answer["error"] = error_->relative_error;
    answer["interval"] = {error_->interval.from, error_->interval.to};
  }
  return answer;
}

void RenderSession::show(const render::RenderResult& result) {
  const std::vector<std::uint8_t> codes = render::codes_of(result.picture, lowered_.output.mapping);
  pixels_.resize(codes.size() / 3 * 4);
  for (std::size_t i = 0; i < codes.size() / 3; ++i) {
    std::copy_n(&codes[3 * i], 3, &pixels_[4 * i]);
    pixels_[4 * i + 3] = 255;
  }
}

Json RenderSession::pick(int x, int y) {
  const render::RenderSettings& settings = lowered_.settings;
  if (x < 0 || y < 0 || x >= settings.width || y >= settings.height) return nullptr;
  const auto row = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(settings.width);
  const auto picked = prepared_->pick(settings, row + static_cast<std::uint64_t>(x));
  if (!picked) return nullptr;
  Json answer{{"distance", picked->distance}};
  if (picked->instance) return answer;
  const auto origins = compiler_->trace_again(std::span(&picked->sphere, 1));
  if (origins.empty()) return answer;
  answer["name"] = origins.front().name;
  answer["place"] = cli::location_json(origins.front().where);
  answer["material"] = cli::location_json(origins.front().material);
  return answer;
}

std::unique_ptr<RenderSession> session;

RenderSession& running() {
  if (!session || !session->can_render()) throw WrongParameter("no scene is being rendered");
  return *session;
}

}  // namespace

Json start_render(const Json& parameters) {
  session.reset();  // before the next: both may not fit into memory
  session = std::make_unique<RenderSession>(parameters);
  return session->description();
}

Json step_render(const Json& parameters) {
  return running().step(parameters.value("milliseconds", 100.0) / 1000);
}

Json pick(const Json& parameters) {
  return {{"sphere", running().pick(parameters.at("x").get<int>(), parameters.at("y").get<int>())}};
}

Json end_render(const Json& /*parameters*/) {
  session.reset();
  return Json::object();
}

std::span<const std::uint8_t> rendered_pixels() {
  return session ? session->pixels() : std::span<const std::uint8_t>();
}

}  // namespace sdlc::wasm
