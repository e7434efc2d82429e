#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/exactness/camera_view.hpp"
#include "render/math/box.hpp"

namespace sdlc::render {

/// The visible spheres of a view, except the few that are left out.
class Crowd : public CameraView {
 public:
  Crowd(const CameraView& view, std::span<const std::uint32_t> left_out);

  bool has(std::uint32_t sphere) const noexcept;
  std::size_t size() const noexcept { return sum_.size; }
  /// Over all spheres: the largest CameraView::extent(), and the bounds of the centres at shutter
  /// opening.
  double extent() const noexcept { return sum_.extent; }
  const Box& centers() const noexcept { return sum_.centers; }
  double min_radius() const noexcept { return sum_.min_radius; }
  double max_radius() const noexcept { return sum_.max_radius; }

  using CameraView::extent;

 private:
  struct Sum {
    std::size_t size = 0;
    double extent = 0, min_radius = Box::kInfinity, max_radius = 0;
    Box centers;
  };

  std::span<const std::uint32_t> left_out_;
  Sum sum_;
};

/// Returns the spheres of a crowd sorted along a space-filling curve, separately for each size
/// class (powers of 8). Spheres at practically the same position are sorted by radius, then index.
/// O(n) time if few share a position; 16 bytes per sphere in addition to the result. Uses all
/// threads of the caller; the result does not depend on their number.
///
/// The curve is a Morton curve ("A computer oriented geodetic data base", 1966) with a different
/// order of axes: every bit of a key halves the longest side of the cells, so cells are nearly
/// cubic in a box of any shape.
std::vector<std::uint32_t> curve_order(const Crowd& crowd);

}  // namespace sdlc::render
