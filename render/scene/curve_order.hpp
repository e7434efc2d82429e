#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/math/box.hpp"
#include "render/scene/camera_view.hpp"

namespace sdlc::render {

/// The spheres of a view that are seen and not left out, few.
class Crowd : public CameraView {
 public:
  Crowd(const CameraView& view, std::span<const std::uint32_t> left_out);

  bool has(std::uint32_t sphere) const noexcept;
  std::size_t size() const noexcept { return sum_.size; }
  /// Of all: the largest CameraView::extent(), and where centres are at the opening.
  double extent() const noexcept { return sum_.extent; }
  const Box& centers() const noexcept { return sum_.centers; }
  double least_radius() const noexcept { return sum_.least_radius; }
  double most_radius() const noexcept { return sum_.most_radius; }

  using CameraView::extent;

 private:
  struct Sum {
    std::size_t size = 0;
    double extent = 0, least_radius = Box::kInfinity, most_radius = 0;
    Box centers;
  };

  std::span<const std::uint32_t> left_out_;
  Sum sum_;
};

/// The spheres of a crowd in an order in which those of one size, to a factor of 8, follow each
/// other along a curve through space, and those whose places are next to nothing of it apart by
/// their radius, and then by index. O(n) time where few are in one place, 16 bytes a sphere beside
/// the result. Works on all threads of the calling arena; the same for any number of them.
///
/// The curve is Morton's ("A computer oriented geodetic data base", 1966), but for the order of the
/// axes: every bit of a key halves the longest side of the cells, so that they are about as long as
/// wide in a box of any shape.
std::vector<std::uint32_t> curve_order(const Crowd& crowd);

}  // namespace sdlc::render
