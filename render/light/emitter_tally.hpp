#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/scene.hpp"

namespace sdlc::render {

/// An emissive sphere and how many paths reached it.
struct ReachedEmitter {
  std::uint32_t sphere;  ///< index in the scene
  std::uint32_t paths;

  friend bool operator==(const ReachedEmitter&, const ReachedEmitter&) = default;
};

/// How a path reaches a sphere that shines. In Heckbert's notation, with E the eye, L the light, D
/// a diffuse and S any other scattering:
enum class LightPath : std::uint8_t {
  Visible,    ///< EL
  Reflected,  ///< E S+ L
  Direct,     ///< E … D L, by scattering or by a connection
  Caustic,    ///< E … D S+ L: no connection finds it
};
inline constexpr std::size_t kLightPaths = 4;

/// What a path met before it reached a sphere that shines.
struct PathHistory {
  bool has_scattered = false;
  bool has_met_diffuse = false;
  bool leaves_diffuse = false;  ///< its last scattering was diffuse
};
constexpr LightPath light_path(PathHistory history) noexcept {
  if (!history.has_scattered) return LightPath::Visible;
  if (!history.has_met_diffuse) return LightPath::Reflected;
  return history.leaves_diffuse ? LightPath::Direct : LightPath::Caustic;
}

/// A kind of path that the scene makes possible and that was found too rarely (EmitterTally) to
/// know what replicates lack of it.
struct RarePath {
  LightPath kind;
  std::uint32_t paths;   ///< that were found
  std::uint32_t sphere;  ///< one that shines and that they lead to: the first of its class
  double radiance;       ///< of the brightest: root mean square over channels
};

/// Counts the paths that reach spheres that shine, up to as many as matter. Spheres of prototypes
/// are not counted. Any thread may count; totals do not depend on their order.
///
/// Emissive spheres are counted one by one, whatever the kind of path. Kinds of path are counted by
/// class: emissive and unlit spheres whose radiance is the same to a factor of 2, and of which all
/// or none are sampled lights.
class EmitterTally {
 public:
  /// So many paths say that an emitter's light is no accident.
  static constexpr std::uint8_t kEnough = 30;
  /// From two paths of a kind on replicates differ, by so much that the interval of the error holds
  /// the rest: with n paths of the same weight its upper end is 1 + 3.2/√n times their squares.
  static constexpr std::uint8_t kWitnesses = 2;
  /// Where camera rays meet a light, by themselves or by mirrors and glass, Sobol' points spread
  /// evenly over the pixel: each replicate may meet one smaller than a pixel as often as the
  /// others, and still be off by a path. After so many paths that has no chance to go unseen.
  static constexpr std::uint8_t kEvenWitnesses = 255;

  /// `lights`: spheres of choose_lights(), for which Direct paths are found by connections.
  EmitterTally(const Scene& scene, std::span<const std::uint32_t> lights, int max_depth);

  /// Whether some count still matters. Once it does not, count() need not be called any more.
  bool is_counting() const noexcept {
    return scarce_.load(std::memory_order_relaxed) > 0 || open_.load(std::memory_order_relaxed) > 0;
  }

  /// A path has reached a sphere, which may be none that shines. Precondition: is_counting() was
  /// true.
  void count(std::uint32_t sphere, LightPath kind) noexcept {
    if (!paths_.empty()) add(paths_[sphere], kEnough, scarce_);
    const std::uint8_t of = classes_of_spheres_[sphere];
    if (of == kNoClass || !classes_[of].kinds[index_of(kind)]) return;
    add(found_[of][index_of(kind)], witnesses(kind), open_);
  }

  /// Emissive spheres that fewer than kEnough paths reached, in the order of the scene.
  std::vector<ReachedEmitter> scarce() const;
  std::vector<RarePath> rare() const;

 private:
  static constexpr std::uint8_t kNoClass = 0xFF;
  using Count = std::atomic<std::uint8_t>;

  struct Class {
    std::uint32_t sphere = 0;  // the first of the class
    double radiance = 0;
    std::array<bool, kLightPaths> kinds{};  // those to count
  };

  static constexpr std::uint8_t witnesses(LightPath kind) noexcept {
    const bool is_even = kind == LightPath::Visible || kind == LightPath::Reflected;
    return is_even ? kEvenWitnesses : kWitnesses;
  }
  static constexpr std::size_t index_of(LightPath kind) noexcept {
    return static_cast<std::size_t>(kind);
  }
  /// Counts up to `enough`, and one less of `left` when it gets there.
  static void add(Count& count, std::uint8_t enough, std::atomic<std::size_t>& left) noexcept {
    std::uint8_t before = count.load(std::memory_order_relaxed);
    while (before < enough) {
      const auto after = static_cast<std::uint8_t>(before + 1);
      if (!count.compare_exchange_weak(before, after, std::memory_order_relaxed)) continue;
      if (after == enough) left.fetch_sub(1, std::memory_order_relaxed);
      return;
    }
  }
  void count_emitters(const Scene& scene);
  void classify(const Scene& scene, std::span<const std::uint32_t> lights, int max_depth);

  std::vector<Count> paths_;  // kEnough: or no emitter; empty: there are none
  std::atomic<std::size_t> scarce_{0};

  std::vector<Class> classes_;
  std::vector<std::uint8_t> classes_of_spheres_;  // empty: nothing shines
  std::vector<std::array<Count, kLightPaths>> found_;
  std::atomic<std::size_t> open_{0};  // kinds of classes of which too few were found
};

/// An upper limit of 95 % for what rare paths may add to the relative error of a picture, in units
/// of it, although none of their noise was seen.
///
/// A path that scattering finds brings at most the radiance L of what it reaches. Where n were
/// found, with 95 % confidence fewer than λ(n) were to be expected (the limit of the Poisson
/// distribution; λ(0) = 3); from two on a path more or less remains, λ = 1. At worst all of them
/// belong to one pixel, which then lacks L λ / samples; spread over more they make less error. The
/// square of that is divided by the number of pixels, those of kinds add up, and the root is
/// divided by the picture's mean radiance. Infinity of a black picture with rare paths.
double unseen_error(std::span<const RarePath> rare, double mean_radiance, std::size_t pixels,
                    std::uint64_t samples) noexcept;

}  // namespace sdlc::render
