#include "render/exactness/precision.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

#include "render/exactness/camera_view.hpp"
#include "render/exactness/instance_extremes.hpp"
#include "render/exactness/movement.hpp"
#include "render/exactness/radiance.hpp"
#include "render/exactness/suspects.hpp"
#include "render/math/vec3.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/instances.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTouching = kCoincidenceTolerance;  // in units of the larger radius: as good as no
                                                     // gap

// In units of rounding times an extent.
constexpr double kHitError = 25;     // of a hit: the 99th percentile
constexpr double kAcrossError = 2;   // perpendicular to the view
constexpr double kReturnError = 2;   // of a ray that returns from the far side of a sphere
constexpr double kMinSpread = 2000;  // max distance of the surfaces, for those that intersect

constexpr double kPartOfRadius = 1.0 / 100;  // tolerated error of a hit
constexpr double kPartOfPixel = 1.0 / 16;
constexpr double kNarrowestPixel = 16;  // in units of rounding

/// The limits that differ between the precisions.
struct Limits {
  double unit;      // of rounding, relative
  double min_gap;   // in units of the larger radius
  double max_view;  // in the image plane
  // The inverse is the lower limit. Within the limits, squares and products of a few numbers do not
  // overflow, and underflow is negligible even for the brightest light.
  double max_radiance;
};
constexpr Limits kFloatLimits{
    .unit = 0x1p-24, .min_gap = 0x1p-16, .max_view = 100, .max_radiance = 1e20};
constexpr Limits kDoubleLimits{
    .unit = 0x1p-53, .min_gap = 0, .max_view = 1e100, .max_radiance = 1e300};

/// The smallest distance from the camera, or from any point of its lens, to the surface over the
/// shutter; nullopt if the surface passes through it.
inline std::optional<double> distance_to(const CameraView& view, std::uint32_t i) {
  if (view.lens().radius() > 0) {
    const double clearance = view.clearance(i);
    return clearance > kTouching * view.radius(i) ? std::optional(clearance) : std::nullopt;
  }
  const Vec3 from = view.opening(i);
  const double r = view.radius(i);
  double nearest = moderate_length(from) - r, farthest = nearest;
  if (view.is_moving()) {
    const Vec3 displacement = view.closing(i) - from;
    nearest = moderate_length(from + displacement * nearest_moment(from, displacement)) - r;
    farthest = std::max(farthest, moderate_length(from + displacement) - r);
  }
  const double min = nearest > 0 ? nearest : -farthest;
  if (min <= kTouching * r) return std::nullopt;
  return min;
}

/// The spheres with the smallest radius and the largest extent, the first one if there are several.
/// nullopt for spheres of instances.
struct Extremes {
  std::optional<std::uint32_t> smallest, farthest;
  double radius = kInfinity, extent = 0;  // of these two spheres
  bool has_any = false;

  void add_radius(std::optional<std::uint32_t> sphere, double of_sphere) {
    if (of_sphere >= radius && has_any) return;
    radius = of_sphere;
    smallest = sphere;
  }
  void add_extent(std::optional<std::uint32_t> sphere, double of_sphere) {
    if (of_sphere <= extent && has_any) return;
    extent = of_sphere;
    farthest = sphere;
  }
  void add(std::optional<std::uint32_t> small, double of_small, std::optional<std::uint32_t> far,
           double of_far) {
    add_radius(small, of_small);
    add_extent(far, of_far);
    has_any = true;
  }
  void add(const InstanceExtremes& more) {
    if (more.extent > 0) add({}, more.radius, {}, more.extent);
  }
};

/// Over all spheres except `exact`.
Extremes extremes_of(const CameraView& view, std::span<const std::uint32_t> exact) {
  const auto add = [&](Extremes& extremes, std::size_t index) {
    const auto i = static_cast<std::uint32_t>(index);
    if (!view.is_seen(i) || contains(exact, i)) return;
    extremes.add(i, view.radius(i), i, view.extent(i));
  };
  const auto join = [](Extremes& extremes, const Extremes& later) {
    if (!later.has_any) return;
    extremes.add(later.smallest, later.radius, later.farthest, later.extent);
  };
  return reduce_indices(view.count(), Extremes{}, add, join);
}

class Judge {
 public:
  Judge(const Scene& scene, const Camera& camera, const RenderSettings& settings,
        const Limits& limits)
      : scene_(scene),
        camera_(camera),
        view_(scene, camera),
        of_instances_(extremes_of_instances(scene, view_.frame(), view_.lens())),
        limits_(limits),
        depth_(settings.depth),
        pixel_(camera.plane_height * std::min(1.0 / std::max(1, settings.height),
                                              camera.aspect / std::max(1, settings.width))) {}

  /// For all spheres computed in this precision, except `exact`.
  PrecisionBounds bounds(std::span<const std::uint32_t> exact) const {
    PrecisionBounds bounds;
    judge_picture(bounds);
    Extremes extremes = extremes_of(view_, exact);
    extremes.add(of_instances_);
    PrecisionBound& hit = bounds[PrecisionClause::Hit];
    hit.limit = kPartOfRadius;
    bounds[PrecisionClause::Across].limit = kPartOfPixel;
    if (extremes.has_any) {
      hit.value = ratio(kHitError * limits_.unit * extremes.extent, extremes.radius);
      hit.sphere = extremes.smallest;
      hit.other = extremes.farthest;
      for (const std::uint32_t i : exact) {
        const double value = ratio(kReturnError * limits_.unit * view_.extent(i), extremes.radius);
        if (value <= hit.value || !sends_back(i)) continue;
        hit.value = value;
        hit.other = i;
      }
      judge_distances(kAcrossError * extremes.extent, exact, bounds);
    } else if (!exact.empty()) {
      hit.value = kInfinity;  // no sphere is left
    }
    hit.share = hit.value / kPartOfRadius;
    // For large scenes only if no other bound is broken, because the search is expensive.
    if (view_.count() <= kFewSpheres || bounds.is_accepted()) judge_gaps(exact, bounds);
    return bounds;
  }

  /// The `max_count` largest spheres, in descending order.
  std::vector<std::uint32_t> largest(std::size_t max_count) const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < view_.count(); ++i) {
      if (!view_.is_seen(i)) continue;
      order.insert(std::upper_bound(order.begin(), order.end(), i,
                                    [&](auto a, auto b) { return is_larger(scene_, a, b); }),
                   i);
      if (order.size() > max_count) order.pop_back();
    }
    return order;
  }

 private:
  static double ratio(double a, double b) { return b > 0 ? a / b : kInfinity; }

  void judge_picture(PrecisionBounds& bounds) const {
    PrecisionBound& pixel = bounds[PrecisionClause::Pixel];
    pixel = {.value = pixel_ / limits_.unit,
             .share = ratio(kNarrowestPixel * limits_.unit, pixel_),
             .limit = kNarrowestPixel,
             .sphere = {},
             .other = {}};
    PrecisionBound& view = bounds[PrecisionClause::View];
    view.value = camera_.plane_height * std::max(1.0, camera_.aspect);
    if (camera_.has_lens()) view.value = std::max(view.value, camera_.aperture / camera_.focus);
    view.limit = limits_.max_view;
    view.share = view.value / view.limit;

    bounds[PrecisionClause::Radiance] = judge_radiance(scene_, depth_, limits_.max_radiance);
  }

  /// `error`: perpendicular to the view at the surface, in units of rounding.
  void judge_distances(double error, std::span<const std::uint32_t> exact,
                       PrecisionBounds& bounds) const {
    const auto add = [&](PrecisionBound& across, std::size_t index) {
      const auto i = static_cast<std::uint32_t>(index);
      if (!view_.is_seen(i) || contains(exact, i)) return;
      const std::optional<double> distance = distance_to(view_, i);
      if (!distance) return;
      const double value = ratio(error * limits_.unit, pixel_ * *distance);
      if (value / kPartOfPixel <= across.share) return;
      across = {.value = value,
                .share = value / kPartOfPixel,
                .limit = kPartOfPixel,
                .sphere = i,
                .other = {}};
    };
    const auto join = [](PrecisionBound& across, const PrecisionBound& later) {
      if (later.share > across.share) across = later;
    };
    PrecisionBound& across = bounds[PrecisionClause::Across];
    across = reduce_indices(view_.count(), across, add, join);
    const double value = ratio(error * limits_.unit, pixel_ * of_instances_.distance);
    if (value / kPartOfPixel <= across.share) return;
    across = {.value = value,
              .share = value / kPartOfPixel,
              .limit = kPartOfPixel,
              .sphere = {},
              .other = {}};
  }

  /// Whether paths return from the far side of a sphere, which may focus them: transmissive
  /// spheres, and reflecting ones with the camera inside.
  bool sends_back(std::uint32_t i) const {
    const Material& material = scene_.materials[scene_.spheres[i].material];
    if (material.type == MaterialType::Transmissive) return true;
    if (material.type == MaterialType::Emissive || material.type == MaterialType::Unlit) {
      return false;
    }
    const std::optional<double> distance = distance_to(view_, i);
    const Vec3 from = view_.opening(i), displacement = view_.closing(i) - from;
    return !distance || moderate_length(from + displacement * nearest_moment(from, displacement)) <
                            view_.radius(i);
  }

  /// If the search fails, float is rejected.
  void judge_gaps(std::span<const std::uint32_t> exact, PrecisionBounds& bounds) const {
    PrecisionBound& narrowest = bounds[PrecisionClause::Gap];
    narrowest.value = kInfinity;
    narrowest.limit = limits_.min_gap;
    const Nearness nearness{.gap_of_extent = kContactReach * kMinGap * limits_.unit,
                            .gap_of_radius = limits_.min_gap,
                            .spread_of_extent = kMinSpread * limits_.unit};
    bounds.near_pairs = find_near_pairs(view_, nearness, exact);
    if (!bounds.near_pairs) {
      if (limits_.min_gap > 0) narrowest.share = kInfinity;
      return;
    }
    for_each_pair(scene_, *bounds.near_pairs, exact, [&](std::uint32_t large, std::uint32_t small) {
      judge_gap(large, small, exact, narrowest);
    });
  }

  /// For spheres that move relative to each other this checks both ends of the shutter and the
  /// moment when their centres are nearest. Spheres that are near each other for less than a
  /// hundredth of the shutter interval are skipped.
  void judge_gap(std::uint32_t large, std::uint32_t small, std::span<const std::uint32_t> exact,
                 PrecisionBound& narrowest) const {
    const bool is_large_exact = contains(exact, large), is_small_exact = contains(exact, small);
    // Points on a sphere computed in double are accurate for that sphere, so only the other
    // sphere's error counts.
    const double extent = is_large_exact == is_small_exact
                              ? std::max(view_.extent(large), view_.extent(small))
                              : view_.extent(is_large_exact ? small : large);
    const double radius = view_.radius(large), error = limits_.unit * extent;
    const double of_radius = is_large_exact ? 0 : limits_.min_gap * radius;
    const Vec3 from = view_.opening(large) - view_.opening(small);
    const Vec3 displacement = view_.closing(large) - view_.closing(small) - from;
    const double movement = moderate_length(displacement);
    const std::array<double, 3> moments{0, 1, nearest_moment(from, displacement)};
    for (std::size_t i = 0; i < (movement > 0 ? moments.size() : 1); ++i) {
      const double apart = moderate_length(from + displacement * moments[i]);
      const Gap gap = narrowest_gap(radius, view_.radius(small), apart, of_radius, error);
      if (gap.min <= kBriefly * movement) continue;
      if (gap.min / gap.width <= narrowest.share) continue;
      narrowest = {.value = gap.width / radius,
                   .share = gap.min / gap.width,
                   .limit = gap.min / radius,
                   .sphere = small,
                   .other = large};
    }
  }

  /// Too narrow if its share, `min` / `width`, is above 1.
  struct Gap {
    double width = kInfinity, min = 0;
  };

  /// Between spheres whose centres are `apart` at one moment: the gap with the largest share.
  ///
  /// Rounding must not move points on one surface beyond the other one, except for a few. There are
  /// two sufficient conditions, and the weaker one counts. `everywhere`: the surfaces are further
  /// apart than the rounding error everywhere, side by side (`outside`) or nested (`inside`); if
  /// they intersect, both widths are negative. `all`: the gap as a function over the smaller
  /// sphere. It may vanish at the contact, but grows to `apart` + the difference of the radii at
  /// the far side. It grows linearly with the height above the contact, which is uniformly
  /// distributed on a sphere, so that kMinSpread leaves one point in a thousand nearer than 2
  /// errors.
  ///
  /// In addition, `of_size`: centres and radii themselves are rounded, relative to the larger
  /// sphere. The distances of the near and the far side of the smaller sphere from the larger
  /// surface must survive this at any camera distance, or two surfaces would become one. Touching
  /// spheres have no such distance.
  static Gap narrowest_gap(double large, double small, double apart, double of_radius,
                           double error) {
    const double outside = apart - large - small, inside = large - small - apart;
    const auto share = [](Gap gap) { return gap.min / gap.width; };
    Gap all{.width = apart + (large - small), .min = kMinSpread * error};
    const Gap everywhere{.width = std::max(outside, inside), .min = kMinGap * error};
    if (everywhere.width > 0 && share(everywhere) < share(all)) all = everywhere;
    for (const double width : {std::fabs(outside), std::fabs(inside)}) {
      const Gap of_size{.width = width, .min = of_radius};
      if (width > kTouching * large && share(of_size) > share(all)) all = of_size;
    }
    return all;
  }

  const Scene& scene_;
  const Camera& camera_;
  CameraView view_;
  InstanceExtremes of_instances_;
  Limits limits_;
  int depth_;
  double pixel_;  // the smaller angle of a pixel, next to the axis
};

std::string number(double v) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", v);
  return text;
}

}  // namespace

double unit_of_rounding(Precision precision) noexcept {
  return (precision == Precision::Double ? kDoubleLimits : kFloatLimits).unit;
}

std::string_view name_of(PrecisionClause clause) noexcept {
  static constexpr std::array<std::string_view, kPrecisionClauses> kNames{
      "hit", "across", "pixel", "gap", "view", "radiance"};
  return kNames[static_cast<std::size_t>(clause)];
}

PrecisionClause PrecisionBounds::deciding() const noexcept {
  const auto largest = std::max_element(
      clauses.begin(), clauses.end(),
      [](const PrecisionBound& a, const PrecisionBound& b) { return a.share < b.share; });
  return static_cast<PrecisionClause>(largest - clauses.begin());
}

PrecisionBounds judge_precision(const Scene& scene, const Camera& camera,
                                const RenderSettings& settings, Precision precision) {
  const Limits& limits = precision == Precision::Double ? kDoubleLimits : kFloatLimits;
  return Judge(scene, camera, settings, limits).bounds({});
}

FloatVerdict judge_float(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         std::size_t max_exact) {
  const Judge judge(scene, camera, settings, kFloatLimits);
  FloatVerdict verdict;
  verdict.bounds = verdict.in_float = judge.bounds({});
  verdict.is_accepted = verdict.in_float.is_accepted();
  if (verdict.is_accepted) return verdict;
  const std::vector<std::uint32_t> by_size = judge.largest(max_exact);
  for (std::size_t exact = 1; exact <= by_size.size(); ++exact) {
    const auto largest = std::span(by_size).first(exact);
    const PrecisionBounds bounds = judge.bounds(largest);
    if (!bounds.is_accepted()) continue;
    return {.is_accepted = true,
            .exact_spheres = {largest.begin(), largest.end()},
            .in_float = verdict.in_float,
            .bounds = bounds};
  }
  return verdict;
}

ScaleRatio measure_scale(const Scene& scene, const Camera& camera) {
  const CameraView view(scene, camera);
  ScaleRatio scale;
  Extremes extremes = extremes_of(view, {});
  extremes.add(extremes_of_instances(scene, view.frame(), view.lens()));
  scale.smallest = extremes.smallest;
  scale.farthest = extremes.farthest;
  if (extremes.extent > 0) {
    scale.ratio = extremes.radius > 0 ? extremes.extent / extremes.radius : kInfinity;
  }
  return scale;
}

std::string describe(PrecisionClause clause, const PrecisionBound& bound) {
  const std::string value = number(bound.value), limit = number(bound.limit);
  switch (clause) {
    case PrecisionClause::Hit:
      return "a hit is off by " + value + " of the smallest radius, where " + limit + " is allowed";
    case PrecisionClause::Across:
      return "so near a surface is off by " + value + " of a pixel, where " + limit + " is allowed";
    case PrecisionClause::Pixel:
      return "a pixel is " + value + " units of rounding wide, where " + limit + " are needed";
    case PrecisionClause::Gap:
      if (!bound.sphere) return "too many spheres overlap to look for gaps between them";
      return "two surfaces are " + value + " of the larger radius apart, where " + limit +
             " is needed";
    case PrecisionClause::View:
      return "the view plane at distance 1 is " + value + " long, where " + limit + " is allowed";
    default:
      if (bound.other)
        return "reflected light reaches " + value + ", where " + limit + " is allowed";
      return "a color, an intensity or an index is " + value + ", where " +
             (bound.value >= 1 ? "at most " : "at least ") + limit + " is allowed";
  }
}

}  // namespace sdlc::render
