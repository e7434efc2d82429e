#include "tests/support/reference/path_tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "render/exactness/camera_surface.hpp"
#include "render/exactness/rebase.hpp"
#include "render/exactness/touching.hpp"
#include "render/film/film.hpp"
#include "render/shading/lights.hpp"
#include "render/shading/optics.hpp"
#include "render/shading/pinhole.hpp"
#include "render/shading/sampler.hpp"
#include "tests/support/reference/intersect.hpp"
#include "tests/support/reference/light_choice.hpp"
#include "tests/support/reference/ray.hpp"
#include "tests/support/reference/scatter.hpp"

namespace sdlc::test::reference {
namespace {

struct Hit {
  double t = kNoHit;
  std::uint32_t sphere = kNoSphere;
};

class PathTracer {
 public:
  PathTracer(Scene scene, const RenderSettings& settings, std::span<const std::uint32_t> lights,
             RenderResult& result, EmitterTally& emitters)
      : pinhole_(scene.camera),
        rebase_(scene),
        settings_(settings),
        result_(result),
        emitters_(emitters) {
    rebase_to_camera(scene);
    part_touching(scene, Precision::Double);
    lights_ = Lights(scene, lights);
    scene_ = std::move(scene);
    for (std::uint32_t i = 0; i < scene_.spheres.size(); ++i) {
      const Vec3 shift = scene_.shifts.empty() ? Vec3{} : scene_.shifts[i];
      if (has_camera_on_it(scene_.spheres[i], shift)) {
        camera_surfaces_.push_back({.sphere = i, .normal = unit(-scene_.spheres[i].center)});
      }
    }
  }

  LinearRgb pixel(std::uint64_t index) {
    const bool has_replicates = settings_.samples >= static_cast<int>(kMinReplicatedSamples);
    const auto samples = static_cast<std::uint64_t>(settings_.samples);
    const ReplicateCounts counts = has_replicates
                                       ? split_in_replicates(samples)
                                       : ReplicateCounts{static_cast<std::uint32_t>(samples)};
    hits_ = 0;
    LinearRgb sum;
    for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
      const std::uint64_t key = stream_key(settings_.seed, index, replicate);
      for (std::uint32_t i = 0; i < counts[replicate]; ++i) {
        const LinearRgb value = sample(index, PathSampler(settings_.sampler, key, i));
        if (is_finite(value)) {
          sum += value;
        } else {
          ++result_.nonfinite_samples;
        }
      }
    }
    if (settings_.keeps_first_hits) {
      PixelFeatures& mean = result_.features[index];
      mean.normal = mean.normal / static_cast<double>(samples);
      mean.albedo = mean.albedo / static_cast<double>(samples);
      mean.depth = hits_ > 0 ? rebase_.length_in_scene(mean.depth / hits_) : kNoDepth;
    }
    return sum / static_cast<double>(samples);
  }

 private:
  LinearRgb sample(std::uint64_t pixel, const PathSampler& sampler) {
    const auto width = static_cast<std::uint64_t>(settings_.width);
    const auto x = static_cast<double>(pixel % width);
    const auto row = static_cast<double>(settings_.height) - 1 - static_cast<double>(pixel / width);
    const auto [dx, dy] = settings_.is_centred() ? UniformPair{0.5, 0.5} : sampler.pair(kPixel);
    const Vec3 direction =
        pinhole_.direction((x + dx) / settings_.width, (row + dy) / settings_.height);
    const double u = scene_.shifts.empty() ? 0 : sampler.pair(kTime).first;
    Ray ray{.origin = {}, .direction = direction, .u = u};
    if (scene_.camera.has_lens()) {
      const auto replicate = static_cast<std::uint64_t>(sampler.start());
      start_at_lens(ray, render::mix_bits(render::mix_bits(settings_.seed + pixel) + replicate) +
                             ++lens_rays_);
    }
    if (settings_.keeps_first_hits) add_first_hit(ray, result_.features[pixel]);
    return li(ray, sampler);
  }

  /// Moves the origin of a ray through the centre of the lens to a point of the lens, found by
  /// rejection from the square around it, and turns the ray to the same point of the plane in
  /// focus. Its random numbers are its own, so pictures with a lens agree with those of the
  /// renderer only in expectation.
  void start_at_lens(Ray& ray, std::uint64_t seed) const {
    std::minstd_rand random(static_cast<std::uint32_t>(seed ^ seed >> 32));
    std::uniform_real_distribution<double> between(-1, 1);
    double x, y;
    do {
      x = between(random), y = between(random);
    } while (x * x + y * y > 1);
    const Vec3 axis = pinhole_.place(0.5, 0.5);
    const Vec3 in_focus = ray.direction * (scene_.camera.focus / dot(ray.direction, axis));
    const double radius = scene_.camera.aperture / 2;
    ray.origin = unit(pinhole_.across()) * (x * radius) + unit(pinhole_.upwards()) * (y * radius);
    ray.direction = unit(in_focus - ray.origin);
  }

  /// Adds normal, depth and albedo to the sums of a pixel.
  void add_first_hit(const Ray& ray, PixelFeatures& sums) {
    Departure departure;
    const Hit hit = intersect(ray, camera_surfaces_, departure);
    if (hit.sphere == kNoSphere) return;
    const Vec3 outward =
        hit.sphere == departure.sphere
            ? rehit_normal(ray.direction, departure.normal)
            : unit((ray.origin - center(hit.sphere, ray.u)) + ray.direction * hit.t);
    const Material& material = material_of(hit.sphere);
    const double light = material.type == MaterialType::Emissive ? material.parameter : 1;
    const LinearRgb color = material.color * light;
    sums.normal += dot(ray.direction, outward) > 0 ? -outward : outward;
    sums.albedo += {std::fmin(color.r, 1), std::fmin(color.g, 1), std::fmin(color.b, 1)};
    sums.depth += hit.t * dot(ray.direction, pinhole_.place(0.5, 0.5));
    ++hits_;
  }

  Vec3 center(std::uint32_t sphere, double u) const {
    const Vec3 at_opening = scene_.spheres[sphere].center;
    return scene_.shifts.empty() ? at_opening : at_opening + scene_.shifts[sphere] * u;
  }

  /// The nearest hit; at equal distances that of the first sphere. The spheres of `left` are hit
  /// only from inside; `departure` becomes the one that is hit.
  Hit intersect(const Ray& ray, std::span<const Departure> left, Departure& departure) const {
    Hit nearest;
    for (std::uint32_t i = 0; i < scene_.spheres.size(); ++i) {
      const double radius = scene_.spheres[i].radius;
      if (!(radius > 0)) continue;
      const auto surface = std::ranges::find(left, i, &Departure::sphere);
      const double t = surface != left.end()
                           ? rehit_distance(ray.direction, surface->normal, radius)
                           : hit_distance(ray.origin - center(i, ray.u), ray.direction, radius);
      if (!(t < nearest.t)) continue;
      nearest = {t, i};
      if (surface != left.end()) departure = *surface;
    }
    return nearest;
  }

  LinearRgb background(Vec3 direction) const {
    const Background& sky = scene_.background;
    if (sky.is_constant()) return sky.bottom;
    const double t = 0.5 * (direction.y + 1);
    return sky.bottom * (1 - t) + sky.top * t;
  }

  const Material& material_of(std::uint32_t sphere) const {
    return scene_.materials[scene_.spheres[sphere].material];
  }

  bool scatters_widely(const Material& material) const {
    const bool is_sampled = result_.kernel.samples_at_metal;
    return is_wide(material) && (is_sampled || material.type != MaterialType::Specular);
  }

  void count_reached(std::uint32_t sphere, LightPath kind) {
    if (emitters_.is_counting()) emitters_.count(sphere, kind);
  }

  /// Next event estimation for a surface point.
  LinearRgb direct_light(const LitPlace& place, const Departure& departure,
                         const PathSampler& sampler, int vertex, LinearRgb beta) {
    const VertexSampler random(sampler, vertex);
    const auto connection = connect(lights_, place, random(kChoice), random(kLight));
    if (!connection) return LinearRgb{};
    ++result_.rays;
    Departure met;
    const Hit hit = intersect({.origin = place.x, .direction = connection->direction, .u = place.u},
                              std::span(&departure, 1), met);
    // If the ray hits or just misses the light's own surface, rounding decides; both count as
    // visible.
    if (hit.t < connection->distance && hit.sphere != connection->sphere) return LinearRgb{};
    count_reached(connection->sphere, LightPath::Direct);
    return beta * connection->radiance;
  }

  LinearRgb li(Ray ray, const PathSampler& sampler) {
    LinearRgb beta{1};   // throughput of the path so far
    LinearRgb gathered;  // radiance from connections to lights
    std::vector<Departure> left = camera_surfaces_;
    LitPlace place;
    bool light_sampled = false;  // at `place`, the previous surface
    PathHistory history;
    for (int depth = 0; depth < settings_.depth; ++depth) {
      ++result_.rays;
      Departure departure;
      const Hit hit = intersect(ray, left, departure);
      if (hit.sphere == kNoSphere) return gathered + beta * background(ray.direction);

      const Material& material = material_of(hit.sphere);
      if (material.type == MaterialType::Unlit) {
        count_reached(hit.sphere, light_path(history));
        return gathered + beta * material.color;
      }
      if (material.type == MaterialType::Emissive) {
        count_reached(hit.sphere, light_path(history));
        const LinearRgb arriving = beta * (material.color * material.parameter);
        if (!light_sampled) return gathered + arriving;
        return gathered + arriving * weight_of_hit(lights_, hit.sphere, place, ray.direction);
      }

      const Vec3 at = center(hit.sphere, ray.u);
      const Vec3 outward = hit.sphere == departure.sphere
                               ? rehit_normal(ray.direction, departure.normal)
                               : unit((ray.origin - at) + ray.direction * hit.t);
      const Vec3 facing = dot(ray.direction, outward) > 0 ? -outward : outward;
      const VertexSampler vertex(sampler, depth);
      const bool is_metal = material.type == MaterialType::Specular;
      place = {.x = at + outward * scene_.spheres[hit.sphere].radius,
               .normal = facing,
               .u = ray.u,
               .mirrored = reflect(ray.direction, facing),
               .fuzz = is_metal ? material.parameter : 0};
      Vec3 direction;
      bool is_absorbed = false;
      switch (material.type) {
        case MaterialType::Diffuse: direction = scatter_diffuse(facing, vertex); break;
        case MaterialType::Specular:
          is_absorbed =
              !scatter_specular(ray.direction, facing, material.parameter, vertex, direction);
          break;
        default:
          direction = scatter_transmissive(ray.direction, outward, material.parameter,
                                           material.fresnel, vertex);
      }
      beta *= material.color;
      ray.origin = place.x;
      ray.direction = direction;
      left = {{.sphere = hit.sphere, .normal = outward}};
      history = {.has_scattered = true,
                 .has_met_wide = history.has_met_wide || scatters_widely(material),
                 .leaves_wide = scatters_widely(material)};
      const bool samples_metal = result_.kernel.samples_at_metal && is_rough(material);
      light_sampled = !lights_.empty() && (samples_metal || material.type == MaterialType::Diffuse);
      if (light_sampled && depth + 1 < settings_.depth) {
        gathered += direct_light(place, left.front(), sampler, depth, beta);
      }
      if (is_absorbed) return gathered;
    }
    ++result_.truncated_paths;
    return gathered;
  }

  Pinhole pinhole_;
  Rebase rebase_;
  const RenderSettings& settings_;
  RenderResult& result_;
  EmitterTally& emitters_;
  Scene scene_;
  std::uint64_t lens_rays_ = 0;
  int hits_ = 0;  // of the camera rays of the pixel
  Lights lights_;
  std::vector<Departure> camera_surfaces_;  // spheres whose surface contains the camera
};

}  // namespace
}  // namespace sdlc::test::reference

namespace sdlc::test {

render::RenderResult render_by_reference(const render::Scene& scene,
                                         const render::RenderSettings& settings) {
  render::RenderResult result;
  result.kernel = choose_kernel(scene, settings, {.backend = &render::portable_backend()});
  result.picture = render::Picture(settings.width, settings.height);
  if (settings.keeps_first_hits) {
    result.features.assign(result.picture.pixels.size(), {.normal = {}, .depth = 0, .albedo = {}});
  }
  result.sampled_lights = static_cast<std::uint32_t>(result.kernel.lights.size());
  const render::EmitterClasses classes(scene, result.kernel.lights, {}, false,
                                       result.kernel.samples_at_metal);
  render::EmitterTally emitters(classes, settings.depth);
  reference::PathTracer tracer(scene, settings, result.kernel.lights, result, emitters);
  for (std::size_t i = 0; i < result.picture.pixels.size(); ++i) {
    result.picture.pixels[i] = tracer.pixel(i);
  }
  result.camera_samples =
      result.picture.pixels.size() * static_cast<std::uint64_t>(settings.samples);
  result.scarce_emitters = emitters.scarce();
  result.is_complete = true;
  return result;
}

}  // namespace sdlc::test
