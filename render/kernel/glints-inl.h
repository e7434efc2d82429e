// The small images of lights in the pixels that are being traced. Compiled once per instruction
// set, so it has no include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_KERNEL_GLINTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_KERNEL_GLINTS_INL_H
#undef SDLC_RENDER_KERNEL_GLINTS_INL_H
#else
#define SDLC_RENDER_KERNEL_GLINTS_INL_H
#endif
// clang-format on

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <hwy/highway.h>

#include "render/kernel/glint_outline.hpp"
#include "render/kernel/path_kernel.hpp"
#include "render/lanes/two_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

/// The glints in the pixel of each lane. Places are those in the pixel, from its lower left corner.
template <typename T>
class LaneGlints {
 public:
  LaneGlints(std::span<const Glint> glints, std::uint64_t width, std::uint64_t height)
      : glints_(glints), width_(width), height_(height) {
    pixels_.fill(std::numeric_limits<std::uint64_t>::max());
  }

  bool empty() const { return glints_.empty(); }
  /// Whether there are any in the pixel, which is from now on that of the lane.
  bool start(std::size_t lane, std::uint64_t pixel) {
    if (pixel != pixels_[lane]) find(lane, pixel);
    return !in_pixels_[lane].empty();
  }

  struct Sample {
    const Glint* glint;
    T x, y;
  };
  /// Chooses a glint in the lane's pixel, and a place in it, by three random numbers from 0 to 1.
  Sample sample(std::size_t lane, T choice, T across, T up) const {
    const std::size_t count = in_pixels_[lane].size();
    const auto rank = std::min(static_cast<std::size_t>(choice * static_cast<T>(count)), count - 1);
    const InPixel& of = in_pixels_[lane][rank];
    return {of.glint, of.left + across * (of.right - of.left),
            of.bottom + up * (of.top - of.bottom)};
  }
  /// The density of sample() for this chain and place.
  T density(std::size_t lane, std::uint32_t caster, std::uint32_t light, std::uint32_t chords, T x,
            T y) const {
    T density = 0;
    for (const InPixel& of : in_pixels_[lane]) {
      const Glint& glint = *of.glint;
      if (glint.caster != caster || glint.light != light || glint.chords != chords) continue;
      if (x < of.left || x > of.right || y < of.bottom || y > of.top) continue;
      density += 1 / ((of.right - of.left) * (of.top - of.bottom));
    }
    return density / static_cast<T>(in_pixels_[lane].size());
  }

 private:
  static constexpr std::size_t kLanes = hwy::HWY_NAMESPACE::MaxLanes(Lanes<T>());

  struct InPixel {
    const Glint* glint;
    T left, right, bottom, top;
  };

  void find(std::size_t lane, std::uint64_t pixel);

  std::span<const Glint> glints_;
  std::uint64_t width_, height_;
  std::array<std::uint64_t, kLanes> pixels_;
  std::array<std::vector<InPixel>, kLanes> in_pixels_;
};

template <typename T>
void LaneGlints<T>::find(std::size_t lane, std::uint64_t pixel) {
  // Larger parts are found by samples of the whole pixel.
  constexpr double kLargest = 0.25;
  pixels_[lane] = pixel;
  in_pixels_[lane].clear();
  const auto width = static_cast<double>(width_), height = static_cast<double>(height_);
  const auto x = static_cast<double>(pixel % width_);
  const auto y = height - 1 - static_cast<double>(pixel / width_);
  for (const Glint& glint : glints_) {
    std::vector<Glint::Place> outline;
    for (const Glint::Place& at : glint.outline) {
      outline.push_back({at.x * width - x, at.y * height - y});
    }
    const std::optional<Rectangle> part = part_in_pixel(std::move(outline));
    if (!part) continue;
    const InPixel in_pixel{&glint, static_cast<T>(part->left), static_cast<T>(part->right),
                           static_cast<T>(part->bottom), static_cast<T>(part->top)};
    const T area = (in_pixel.right - in_pixel.left) * (in_pixel.top - in_pixel.bottom);
    if (area > 0 && area < kLargest) in_pixels_[lane].push_back(in_pixel);
  }
}

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
