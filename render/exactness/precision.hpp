#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/exactness/near_pairs.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The min distance of surfaces that do not intersect, in units of rounding times their extent; it
/// keeps each point on its side.
inline constexpr double kMinGap = 4;

/// A sphere nested in one that is separated from another has to follow, recursively; so pairs are
/// searched up to this multiple of the min gap.
inline constexpr double kContactReach = 32;

/// Half the distance from 1 to the next number: 2^-24, or 2^-53 in double.
double unit_of_rounding(Precision precision) noexcept;

/// The criteria that rounding errors have to satisfy.
enum class PrecisionClause : std::uint8_t {
  Hit,       ///< error of a hit, in radii of the smallest sphere: at most 1/100
  Across,    ///< error perpendicular to the view, in pixels, at the worst surface: at most 1/16
  Pixel,     ///< smaller angle of a pixel, in units of rounding: at least 16
  Gap,       ///< the narrowest gap between two surfaces, in radii of the larger sphere
  View,      ///< the longer side of the image plane at distance 1, or the lens divided by its focus
  Radiance,  ///< the max radiance, min colour or refractive index that is farthest from 1
};
inline constexpr std::size_t kPrecisionClauses = 6;

/// "hit", "across", "pixel", "gap", "view", "radiance".
std::string_view name_of(PrecisionClause clause) noexcept;

/// How close a scene comes to the limit of a precision, for one criterion.
struct PrecisionBound {
  double value = 0;  ///< the quantity of PrecisionClause
  double share = 0;  ///< value relative to the limit: accepted up to 1
  double limit = 0;  ///< the value with share 1
  /// The spheres that decide, by index. For Hit: the smallest one, then the farthest one. For
  /// Radiance, if it is exceeded: the light or material, then what multiplies the light. nullopt:
  /// no sphere, or one of an instance.
  std::optional<std::uint32_t> sphere, other;
};

/// All criteria.
struct PrecisionBounds {
  std::array<PrecisionBound, kPrecisionClauses> clauses{};
  /// All pairs of spheres that part_touching() needs; nullopt if gaps were not computed.
  std::optional<std::vector<SpherePair>> near_pairs;

  PrecisionBound& operator[](PrecisionClause clause) {
    return clauses[static_cast<std::size_t>(clause)];
  }
  const PrecisionBound& operator[](PrecisionClause clause) const {
    return clauses[static_cast<std::size_t>(clause)];
  }
  /// The criterion with the largest share.
  PrecisionClause deciding() const noexcept;
  bool is_accepted() const noexcept { return (*this)[deciding()].share <= 1; }
};

/// The bounds for a scene that is traced entirely in float or double. u is the unit of rounding,
/// 2^-24 or 2^-53, and E the distance from the camera to the far side of the farthest sphere, over
/// the whole shutter. With a lens, E and all distances are those of the worst point on it.
///
/// The error of a hit is 25 u E and the error perpendicular to the view 2 u E: the 99th percentiles
/// of measurements on single rays. Points on a sphere have an error of 2 u times its own E. So two
/// surfaces have to be 4 u E apart everywhere, which keeps each point on its side of the other
/// surface, or 2000 u E at their farthest points: if they touch, one in a thousand points is then
/// nearer than the rounding error. In float, non-zero gaps also have to be at least 2^-16 of the
/// larger radius. Radiance is that of the brightest light after all rays of a path, where colours
/// are above 1.
///
/// `settings` provides the size and the depth. Gaps are found by find_near_pairs(); with more than
/// kFewSpheres only if no other bound is broken. O(n log n) time.
PrecisionBounds judge_precision(const Scene& scene, const Camera& camera,
                                const RenderSettings& settings, Precision precision);

/// The max number of spheres that are computed in double while the others are in float.
inline constexpr std::size_t kMaxExactSpheres = 4;

/// Whether a scene can be traced in float without visible errors.
struct FloatVerdict {
  bool is_accepted = false;
  /// Accepted on condition that these spheres, the largest ones, are computed in double; empty if
  /// all are in float.
  std::vector<std::uint32_t> exact_spheres;
  PrecisionBounds in_float;  ///< with all spheres in float
  PrecisionBounds bounds;    ///< under that condition; without one the same
};

/// Decides by those bounds. The `max_exact` largest spheres may break them if they are computed in
/// double: points on them then have an error of u times their own distance to the camera. With the
/// camera inside such a sphere, paths that return from its far side must be accurate to 1/100 of
/// the smallest other radius.
FloatVerdict judge_float(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         std::size_t max_exact = kMaxExactSpheres);

/// The distance from the camera to the farthest sphere, in radii of the smallest sphere: the range
/// that the numbers have to resolve. 0 without spheres.
struct ScaleRatio {
  double ratio = 0;
  std::optional<std::uint32_t> smallest, farthest;  ///< nullopt for a sphere of an instance
};
ScaleRatio measure_scale(const Scene& scene, const Camera& camera);

/// The max ratio that double resolves.
inline constexpr double kMaxScaleInDouble = 0x1p53 / 2500;

/// Describes the bound in words such as "a hit is off by 0.3 of the smallest radius, where 0.01 is
/// allowed".
std::string describe(PrecisionClause clause, const PrecisionBound& bound);

}  // namespace sdlc::render
