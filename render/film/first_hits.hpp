#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {

/// The first surface on a camera ray.
struct FirstHit {
  Vec3 normal;       ///< unit length, facing the camera
  double depth = 0;  ///< along the view direction, in [0, 2^95)
  LinearRgb albedo;  ///< at least 0; counts as at most 1, the maximum of Open Image Denoise
};

/// Sums of the first hits of a pixel's camera rays, at most 2^31. They are whole numbers (multiples
/// of 2^-31 for normals and albedos, of 1 for depths), so that all orders of addition give the same
/// bits.
class FirstHitSums {
 public:
  void add(const FirstHit& hit) noexcept {
    ++hits_;
    for (std::size_t i = 0; i < 3; ++i) {
      const double normal = i == 0 ? hit.normal.x : i == 1 ? hit.normal.y : hit.normal.z;
      const double albedo = i == 0 ? hit.albedo.r : i == 1 ? hit.albedo.g : hit.albedo.b;
      normal_[i] += std::llrint(normal * kUnit);
      albedo_[i] += std::llrint(std::fmin(albedo, 1) * kUnit);
    }
    const double depth = std::fmax(hit.depth, 0);
    const double high = std::floor(depth * 0x1p-64);
    add_depth(static_cast<std::uint64_t>(high), static_cast<std::uint64_t>(depth - high * 0x1p64));
  }

  FirstHitSums& operator+=(const FirstHitSums& other) noexcept {
    hits_ += other.hits_;
    for (std::size_t i = 0; i < 3; ++i) {
      normal_[i] += other.normal_[i];
      albedo_[i] += other.albedo_[i];
    }
    add_depth(other.depth_high_, other.depth_low_);
    return *this;
  }

  std::uint64_t hits() const noexcept { return hits_; }
  /// Of `samples` rays, of which those without a hit count as 0.
  Vec3 mean_normal(std::uint64_t samples) const noexcept {
    const double scale = 1 / (kUnit * static_cast<double>(samples));
    return Vec3{static_cast<double>(normal_[0]), static_cast<double>(normal_[1]),
                static_cast<double>(normal_[2])} *
           scale;
  }
  LinearRgb mean_albedo(std::uint64_t samples) const noexcept {
    const double scale = 1 / (kUnit * static_cast<double>(samples));
    return LinearRgb{static_cast<double>(albedo_[0]), static_cast<double>(albedo_[1]),
                     static_cast<double>(albedo_[2])} *
           scale;
  }
  /// Of the hits. Precondition: there is one.
  double mean_depth() const noexcept {
    return (static_cast<double>(depth_high_) * 0x1p64 + static_cast<double>(depth_low_)) /
           static_cast<double>(hits_);
  }

 private:
  static constexpr double kUnit = 0x1p31;

  void add_depth(std::uint64_t high, std::uint64_t low) noexcept {
    depth_low_ += low;
    depth_high_ += high + (depth_low_ < low ? 1 : 0);
  }

  std::array<std::int64_t, 3> normal_{}, albedo_{};
  std::uint64_t depth_low_ = 0, depth_high_ = 0;  // halves of a number of 128 bits
  std::uint64_t hits_ = 0;
};

/// Depth where no ray of a pixel hits a surface; the same value as in Cycles.
inline constexpr double kNoDepth = 1e10;

/// Means of the first hits of a pixel's camera rays.
struct PixelFeatures {
  Vec3 normal;              ///< facing the camera; shorter than 1 where normals differ or rays miss
  double depth = kNoDepth;  ///< along the view direction, of the rays that hit
  LinearRgb albedo;         ///< components in [0, 1]

  friend bool operator==(const PixelFeatures&, const PixelFeatures&) = default;
};

/// The features of a pixel that has `samples` samples; PixelFeatures{} without any. A depth of 1 in
/// the sums is 2^`depth_exponent` in the scene (Tracer::depth_exponent()).
inline PixelFeatures features_of(const FirstHitSums& sums, std::uint64_t samples,
                                 int depth_exponent) noexcept {
  if (samples == 0) return {};
  const double depth = sums.hits() > 0 ? std::ldexp(sums.mean_depth(), depth_exponent) : kNoDepth;
  return {.normal = sums.mean_normal(samples), .depth = depth, .albedo = sums.mean_albedo(samples)};
}

}  // namespace sdlc::render
