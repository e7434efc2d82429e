#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// An emissive sphere and how many paths reached it.
struct ReachedEmitter {
  std::uint32_t sphere;  ///< index in the scene
  std::uint32_t paths;

  friend bool operator==(const ReachedEmitter&, const ReachedEmitter&) = default;
};

/// Counts the paths that reach each emissive sphere that shines and can be hit, up to as many as
/// say that its light is no accident: those that end on it, and connections that bring its light.
/// Spheres of prototypes are not counted. Any thread may count; totals do not depend on their
/// order.
class EmitterTally {
 public:
  static constexpr std::uint8_t kEnough = 30;

  explicit EmitterTally(const Scene& scene);

  /// Whether some emitter has not been reached by kEnough paths. Once it has not, count() need not
  /// be called any more.
  bool is_counting() const noexcept { return scarce_.load(std::memory_order_relaxed) > 0; }

  /// A path has reached a sphere, which may be no emitter. Precondition: is_counting() was true.
  void count(std::uint32_t sphere) noexcept {
    std::atomic<std::uint8_t>& paths = paths_[sphere];
    std::uint8_t before = paths.load(std::memory_order_relaxed);
    while (before < kEnough) {
      const auto after = static_cast<std::uint8_t>(before + 1);
      if (!paths.compare_exchange_weak(before, after, std::memory_order_relaxed)) continue;
      if (after == kEnough) scarce_.fetch_sub(1, std::memory_order_relaxed);
      return;
    }
  }

  /// Those that fewer than kEnough paths reached, in the order of the scene.
  std::vector<ReachedEmitter> scarce() const;

 private:
  std::vector<std::atomic<std::uint8_t>> paths_;  // kEnough: or no emitter; empty: there are none
  std::atomic<std::size_t> scarce_{0};
};

}  // namespace sdlc::render
