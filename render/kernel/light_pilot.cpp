#include "render/kernel/light_pilot.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "render/exactness/rebase.hpp"
#include "render/exactness/touching.hpp"
#include "render/film/pixel_run.hpp"
#include "render/kernel/path_kernel.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/shading/choose_lights.hpp"
#include "render/shading/pinhole.hpp"

namespace sdlc::render {
namespace {

double largest_of(LinearRgb c) noexcept { return std::fmax(c.r, std::fmax(c.g, c.b)); }

/// Scales all light by a power of two, so that the brightest is near 1 and squares cannot overflow.
void normalize_light(Scene& scene) {
  const auto is_light = [](const Material& material) {
    return material.type == MaterialType::Emissive || material.type == MaterialType::Unlit;
  };
  double brightest =
      std::fmax(largest_of(scene.background.bottom), largest_of(scene.background.top));
  for (const Material& material : scene.materials) {
    if (!is_light(material)) continue;
    const bool is_emissive = material.type == MaterialType::Emissive;
    const double factor = is_emissive ? material.parameter : 1;
    brightest = std::fmax(brightest, largest_of(material.color) * factor);
  }
  if (!(brightest > 0) || !std::isfinite(brightest)) return;
  const double scale = std::ldexp(1.0, -std::ilogb(brightest));
  scene.background.bottom = scene.background.bottom * scale;
  scene.background.top = scene.background.top * scale;
  for (Material& material : scene.materials) {
    if (material.type == MaterialType::Emissive) material.parameter *= scale;
    if (material.type == MaterialType::Unlit) material.color = material.color * scale;
  }
}

constexpr std::size_t kPixels = 1024;
constexpr std::uint32_t kSamples = 8;

/// Traces kSamples runs of one sample for each of kPixels pixels. All pass through the centre of a
/// lens: the average over the picture hardly depends on blur.
TraceCounts trace(Scene scene, const RenderSettings& settings,
                  std::span<const std::uint32_t> lights, std::span<const std::uint32_t> casters,
                  PlainPaths& plain, std::vector<PixelRun>& runs) {
  constexpr int kMaxDepth = 32;  // contributions beyond this depth are negligible
  const Pinhole pinhole(scene.camera);
  const double width = settings.width, height = settings.height;
  for (std::size_t i = 0; i < kPixels; ++i) {
    // Roberts' R2 sequence: spreads evenly over the picture for any number of pixels.
    constexpr double kStepX = 0.7548776662466927, kStepY = 0.5698402909980532;
    const auto index = static_cast<double>(i);
    const double s = std::fmod(0.5 + index * kStepX, 1.0), t = std::fmod(0.5 + index * kStepY, 1.0);
    plain.corners.push_back(pinhole.place(s - 0.5 / width, t - 0.5 / height));
    for (std::uint32_t sample = 0; sample < kSamples; ++sample) {
      runs.push_back({.pixel = i, .parts = {{{.first = sample, .count = 1, .sum = {}}}}});
    }
  }
  const Vec3 right = pinhole.across() / width, up = pinhole.upwards() / height;
  rebase_to_camera(scene);
  part_touching(scene, Precision::Double, {});
  const WideScene<double> wide(scene, Search::Bvh, {}, lights, casters, true);
  WideView<double> view;
  view.width = kPixels;
  view.max_depth = static_cast<std::uint32_t>(std::min(settings.depth, kMaxDepth));
  view.spread_right = {right.x, right.y, right.z};
  view.spread_up = {up.x, up.y, up.z};
  view.sampler = SamplerKind::Independent;
  view.plain = &plain;
  TraceCounts counts;
  const KernelFeatures features{.motion = wide.has_motion,
                                .bvh = true,
                                .lights = true,
                                .pilot = true,
                                .caustics = wide.casters.nodes > 0};
  portable_kernel(features)(wide, view, runs, counts, std::atomic<bool>{false});
  return counts;
}

double mean_square(LinearRgb c) noexcept { return (c.r * c.r + c.g * c.g + c.b * c.b) / 3; }

}  // namespace

LightPilot run_light_pilot(Scene scene, const RenderSettings& settings,
                           std::span<const std::uint32_t> lights,
                           std::span<const std::uint32_t> casters) {
  const bool at_metal = is_metal_rough_for(scene, lights);
  normalize_light(scene);
  PlainPaths plain;
  std::vector<PixelRun> runs;
  const TraceCounts counts = trace(std::move(scene), settings, lights, casters, plain, runs);
  double variance = 0, squared_mean = 0;  // sums over pixels
  for (std::size_t first = 0; first < runs.size(); first += kSamples) {
    LinearRgb sum;
    double squares = 0;
    for (const PixelRun& run : std::span(runs).subspan(first, kSamples)) {
      sum += run.parts[0].sum;
      squares += mean_square(run.parts[0].sum);
    }
    const double of_pixel = (squares - mean_square(sum) / kSamples) / (kSamples - 1);
    variance += of_pixel;
    squared_mean += mean_square(sum) / (kSamples * kSamples) - of_pixel / kSamples;
  }
  const double plain_variance = plain.squares / kSamples - squared_mean;
  const auto plain_rays = static_cast<double>(counts.rays - plain.shadow_rays - plain.caustic_rays);
  // Fitted to ten scenes of 1 to 180 lights with the wide kernel, whose times it predicts to within
  // 20 %.
  constexpr double kCostOfStep = 0.45;  // of one level of a light tree, relative to a ray
  constexpr double kCostOfBeams = 6;    // of Beams, relative to a ray
  const auto steps = [](std::size_t leaves) {
    return kCostOfStep * static_cast<double>(std::bit_width(leaves));
  };
  const auto work_of = [&](std::uint64_t rays, std::uint64_t choices, double of_choice) {
    return (static_cast<double>(rays) + static_cast<double>(choices) * of_choice) / plain_rays;
  };
  LightPilot pilot{.direct = {},
                   .with_casters = {},
                   .connections = plain.connections,
                   .caustics = plain.caustics};
  LightPilot::Cost& direct = pilot.direct;
  direct.work = 1 + work_of(plain.shadow_rays, plain.choices, steps(lights.size()));
  const bool is_known = plain_variance > 0 && variance > 0;
  const auto relative = [&](double squares) { return is_known ? squares / plain_variance : 0; };
  const double of_caustics = relative(plain.squares_without_caustics / kSamples);
  if (is_known) direct.variance = relative(variance) + of_caustics;

  // The independent points of the pilot overestimate the gain at metal; above this ratio
  // connections lost time.
  constexpr double kMetalPays = 0.6;
  const LightPilot::Cost without_metal{
      .variance = direct.variance + relative(plain.squares_without_metal / kSamples),
      .work = direct.work -
              work_of(plain.metal_shadow_rays, plain.metal_choices, steps(lights.size()))};
  pilot.samples_at_metal = plain.metal_connections < kMinConnections
                               ? at_metal
                               : direct.product() < kMetalPays * without_metal.product();
  if (!pilot.samples_at_metal) direct = without_metal;
  pilot.with_casters = direct;
  if (!casters.empty()) {
    pilot.with_casters.variance -= of_caustics;
    pilot.with_casters.work += work_of(plain.caustic_rays, plain.choices - plain.metal_choices,
                                       steps(casters.size()) + kCostOfBeams);
  }
  return pilot;
}

}  // namespace sdlc::render
