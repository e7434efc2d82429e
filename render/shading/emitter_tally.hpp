#pragma once

#include <algorithm>
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

/// Paths of one kind, counted up to `enough`.
struct EmitterCount {
  std::uint8_t paths = 0, enough = 0;

  friend bool operator==(const EmitterCount&, const EmitterCount&) = default;
};

/// How a path reaches an emitter by scattering, or by a connection that ends there. In Heckbert's
/// notation, with E the eye, L the light, D scattering at diffuse surfaces and at wide metal that
/// samples lights, and S any other:
enum class LightPath : std::uint8_t {
  Visible,    ///< EL
  Reflected,  ///< E S+ L
  Direct,     ///< E … D L, by scattering or by a connection
  Caustic,    ///< E … D S+ L
};
inline constexpr std::size_t kLightPaths = 4;
constexpr std::size_t index_of(LightPath kind) noexcept { return static_cast<std::size_t>(kind); }

/// What a path hit before it reached an emitter.
struct PathHistory {
  bool has_scattered = false;
  bool has_met_wide = false;  ///< diffuse, or wide metal that samples lights
  bool leaves_wide = false;   ///< the last scattering was wide
};
constexpr LightPath light_path(PathHistory history) noexcept {
  if (!history.has_scattered) return LightPath::Visible;
  if (!history.has_met_wide) return LightPath::Reflected;
  return history.leaves_wide ? LightPath::Direct : LightPath::Caustic;
}

/// A kind of path that is possible in the scene but was found too rarely (EmitterTally) for the
/// replicates to show its noise; or all contributions by way of casters that are rarely so large.
struct RarePath {
  LightPath kind;
  std::uint32_t paths;   ///< found so far
  std::uint32_t sphere;  ///< the first sphere of the emitter class
  double radiance;       ///< of the brightest emitter: root mean square over channels
};

/// The emitters of a scene. A class consists of emissive and unlit spheres whose radiance agrees to
/// a factor of 2, and of which all or none are sampled lights. Spheres of prototypes have none.
struct EmitterClasses {
  static constexpr std::uint8_t kNone = 0xFF;

  /// Whether paths of a kind are found by scattering, at any depth.
  enum class Chance : std::uint8_t {
    Impossible,
    Unexpected,  ///< connections find all that matter, as far as is known
    Possible,
  };
  struct Class {
    std::uint32_t sphere = 0;  ///< the first of the class
    double radiance = 0;       ///< of the brightest
    std::array<Chance, kLightPaths> kinds{};

    void add(LightPath kind, Chance chance) noexcept {
      kinds[index_of(kind)] = std::max(kinds[index_of(kind)], chance);
    }
  };

  double brightest = 0;      ///< radiance of all emitters: root mean square over channels
  bool has_casters = false;  ///< connections are made by way of mirrors and glass
  std::vector<std::uint32_t> emitters;  ///< the emissive spheres
  std::vector<Class> classes;
  std::vector<std::uint8_t> of_spheres;  ///< the class of each sphere, or kNone

  EmitterClasses() = default;
  /// `lights`: the spheres from choose_lights(), for which Direct paths are found by connections.
  /// `casters`: from choose_casters(); connections find all Caustic paths but those by way of
  /// several spheres, and those near or inside of the caster. `has_all_glints`:
  /// Glints::are_complete; the same for Reflected paths. `samples_at_metal`: connections to lights
  /// are also made from rough metal; only then is_wide() metal counts as wide.
  EmitterClasses(const Scene& scene, std::span<const std::uint32_t> lights,
                 std::span<const std::uint32_t> casters = {}, bool has_all_glints = false,
                 bool samples_at_metal = false);
};

/// Counts the paths that reach emitters, up to the numbers that matter. Any thread may count;
/// totals do not depend on the order. Emissive spheres are counted individually, over all kinds of
/// path; kinds of path are counted per class.
class EmitterTally {
 public:
  /// An emitter found by this many paths was not found by accident.
  static constexpr std::uint8_t kEnough = 30;
  /// From two paths of a kind on, replicates differ enough for the confidence interval of the error
  /// to cover the rest: with n paths of equal weight its upper end is 1 + 3.2/√n times their
  /// squares.
  static constexpr std::uint8_t kWitnesses = 2;
  /// Contributions of paths by way of casters are counted by octave, below the radiance of the
  /// brightest emitter. With fewer than kEnough in an octave, their noise is not known.
  static constexpr std::size_t kOctaves = 64;
  /// Where camera rays reach a light, directly or by mirrors and glass, Sobol' points spread evenly
  /// over the pixel. Each replicate may then hit a light smaller than a pixel equally often, and
  /// still be off by one path. After this many paths that error cannot go unnoticed.
  static constexpr std::uint8_t kEvenWitnesses = 255;

  /// For paths of at most `max_depth` rays. Keeps a reference to `classes`.
  EmitterTally(const EmitterClasses& classes, int max_depth);

  /// Whether some count still matters. Afterwards count() need not be called.
  bool is_counting() const noexcept {
    return scarce_.load(std::memory_order_relaxed) > 0 || open_.load(std::memory_order_relaxed) > 0;
  }

  /// Records that a path has reached a sphere, which need not be an emitter. Precondition:
  /// is_counting() was true.
  void count(std::uint32_t sphere, LightPath kind) noexcept {
    if (!paths_.empty()) add(paths_[sphere], kEnough, scarce_);
    const std::uint8_t of = classes_.of_spheres[sphere];
    if (of == EmitterClasses::kNone || !counts(of, index_of(kind))) return;
    add(found_[of][index_of(kind)], witnesses(kind), open_);
  }

  /// Records what a path by way of a caster contributes to its pixel, a radiance. Precondition:
  /// is_counting() was true.
  void count_contribution(double radiance) noexcept;

  /// All counts. Those of two tallies of the same arguments can be added, each up to its `enough`.
  std::vector<EmitterCount> counts() const;
  /// Precondition: the counts are of a tally of the same arguments.
  void restore(std::span<const EmitterCount> counts) noexcept;

  /// Emissive spheres that fewer than kEnough paths reached, in scene order.
  std::vector<ReachedEmitter> scarce() const;
  std::vector<RarePath> rare() const;

 private:
  using Count = std::atomic<std::uint8_t>;

  static constexpr std::uint8_t witnesses(LightPath kind) noexcept {
    const bool is_even = kind == LightPath::Visible || kind == LightPath::Reflected;
    return is_even ? kEvenWitnesses : kWitnesses;
  }
  /// Increments `count` up to `enough`, and decrements `left` when it gets there.
  static void add(Count& count, std::uint8_t enough, std::atomic<std::size_t>& left) noexcept {
    std::uint8_t before = count.load(std::memory_order_relaxed);
    while (before < enough) {
      const auto after = static_cast<std::uint8_t>(before + 1);
      if (!count.compare_exchange_weak(before, after, std::memory_order_relaxed)) continue;
      if (after == enough) left.fetch_sub(1, std::memory_order_relaxed);
      return;
    }
  }
  /// Calls `visit(count, enough, left)` with each count.
  template <typename Tally, typename Visit>
  static void for_each_count(Tally& tally, Visit visit);
  /// Whether paths of this kind to this class are counted.
  bool counts(std::size_t of, std::size_t kind) const noexcept {
    return classes_.classes[of].kinds[kind] != EmitterClasses::Chance::Impossible &&
           is_deep_enough_[kind];
  }

  const EmitterClasses& classes_;
  std::array<bool, kLightPaths> is_deep_enough_;
  std::vector<Count> paths_;  // kEnough for non-emitters; empty if there are no emitters
  std::atomic<std::size_t> scarce_{0};

  std::vector<Count> octaves_;                         // of contributions; empty without casters
  std::vector<std::array<Count, kLightPaths>> found_;  // by class
  std::atomic<std::size_t> open_{0};  // (class, kind) pairs and octaves with too few paths
};

/// A 95 % upper limit for the relative error that rare paths may add to a picture, although their
/// noise was not seen.
///
/// A path found by scattering contributes at most the radiance L of its emitter. After n such
/// paths, with 95 % confidence fewer than λ(n) were to be expected (the confidence limit of the
/// Poisson distribution; λ(0) = 3); from two paths on, an error of one path remains, λ = 1. In the
/// worst case all of them belong to one pixel, which then lacks L λ / samples; spread over more
/// pixels they make less error. The squares, divided by the number of pixels, are summed over
/// kinds, and the root is divided by the picture's mean radiance. Infinity for a black picture with
/// rare paths.
double unseen_error(std::span<const RarePath> rare, double mean_radiance, std::size_t pixels,
                    std::uint64_t samples) noexcept;

}  // namespace sdlc::render
