#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/near_pairs.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The numbers that paths are computed in. Mixed: float, but the largest spheres are met in double.
enum class Precision : std::uint8_t { Float, Mixed, Double };

std::string_view name_of(Precision precision) noexcept;

/// Surfaces that do not meet are to be so many units of rounding times their extent apart, so that
/// each point stays on its side.
inline constexpr double kLeastGap = 4;

/// What is nested in a sphere that is parted from another has to follow, and what is nested in
/// that: pairs are looked for up to so many times the gap that there is to be.
inline constexpr double kContactReach = 32;

/// Half the distance from 1 to the next number: 2^-24 or, in double, 2^-53.
double unit_of_rounding(Precision precision) noexcept;

/// What rounding must stay below, in one respect each.
enum class PrecisionClause : std::uint8_t {
  Hit,       ///< error of a hit, in radii of the smallest sphere: at most 1/100
  Across,    ///< error across the view, in pixels, at the surface where most: at most 1/16
  Pixel,     ///< smaller angle of a pixel, in units of rounding: at least 16
  Gap,       ///< the narrowest between two surfaces, in radii of the larger sphere
  View,      ///< the longer side of the view plane at distance 1
  Radiance,  ///< what arrives at most, the least colour, or an index: the farthest from 1
};
inline constexpr std::size_t kPrecisionClauses = 6;

/// "hit", "across", "pixel", "gap", "view", "radiance".
std::string_view name_of(PrecisionClause clause) noexcept;

/// How near a scene comes to what a precision resolves, in one respect.
struct PrecisionBound {
  double value = 0;  ///< what PrecisionClause says
  double share = 0;  ///< of what is allowed: accepted up to 1
  double limit = 0;  ///< the value of which the share is 1
  /// The spheres that decide, by their index; Hit: the smallest one, then the farthest. Nothing: it
  /// is none, or one of an instance.
  std::optional<std::uint32_t> sphere, other;
};

/// The same in all respects.
struct PrecisionBounds {
  std::array<PrecisionBound, kPrecisionClauses> clauses{};
  /// Nothing where gaps were not looked for; else all pairs of spheres that part_touching() asks
  /// for.
  std::optional<std::vector<SpherePair>> near_pairs;

  PrecisionBound& operator[](PrecisionClause clause) {
    return clauses[static_cast<std::size_t>(clause)];
  }
  const PrecisionBound& operator[](PrecisionClause clause) const {
    return clauses[static_cast<std::size_t>(clause)];
  }
  /// The one with the largest share.
  PrecisionClause deciding() const noexcept;
  bool is_accepted() const noexcept { return (*this)[deciding()].share <= 1; }
};

/// The bounds for a scene in float or double, all of it met in that. With u the unit of rounding,
/// 2^-24 or 2^-53, and E the distance from the camera to the far side of the farthest sphere, over
/// the whole shutter, the error of a hit is 25 u E and the error across the view 2 u E: the 99th
/// percentile of measurements on single rays. Points on a sphere are off by 2 u of its own E. So
/// two surfaces are to be 4 u E apart everywhere, which leaves each point on its side of the other,
/// or 2000 u E where they are farthest apart: where they touch, one in a thousand points is
/// then nearer than rounding can tell. In float gaps that are not 0 are at least 2^-16 of the
/// larger radius besides. Radiance is that of the brightest light after all the rays of a path,
/// where colours are above 1. Of `settings` the size and the depth count. Gaps are looked for by
/// find_near_pairs(); among more than kFewSpheres only where no other bound is broken. O(n log n)
/// time.
PrecisionBounds judge_precision(const Scene& scene, const Camera& camera,
                                const RenderSettings& settings, Precision precision);

/// As many spheres at most are met in double beside others in float.
inline constexpr std::size_t kMostExactSpheres = 4;

/// Whether a scene can be traced in float without anything to be seen of it.
struct FloatVerdict {
  bool is_accepted = false;
  /// Accepted on condition that these spheres, the largest ones, are met in double; empty: all in
  /// float.
  std::vector<std::uint32_t> exact_spheres;
  PrecisionBounds in_float;  ///< all met in float
  PrecisionBounds bounds;    ///< on that condition; without one the same
};

/// Judges by those bounds. The `most_exact` largest spheres may break them if they are met in
/// double: points on them are then off by u of their own distance to the camera. From inside one,
/// where paths come back from its far side, that is to be right to 1/100 of the least other radius.
FloatVerdict judge_float(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                         std::size_t most_exact = kMostExactSpheres);

/// How far the scene reaches from the camera, in radii of its smallest sphere: what the precision
/// of numbers has to span. 0 without spheres.
struct ScaleRatio {
  double ratio = 0;
  std::optional<std::uint32_t> smallest, farthest;  ///< nothing: a sphere of an instance
};
ScaleRatio measure_scale(const Scene& scene, const Camera& camera);

/// The largest ratio that double resolves.
inline constexpr double kMostScaleInDouble = 0x1p53 / 2500;

/// What is wrong or nearest to it, in words such as "a hit is off by 0.3 of the smallest radius,
/// where 0.01 is allowed".
std::string describe(PrecisionClause clause, const PrecisionBound& bound);

}  // namespace sdlc::render
