#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "render/exactness/near_pairs.hpp"
#include "render/exactness/precision.hpp"
#include "render/exactness/rebase.hpp"
#include "render/film/first_hits.hpp"
#include "render/film/pixel_run.hpp"
#include "render/kernel/backend.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/scene/scene.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// The first sphere on a ray.
struct PickedSphere {
  std::uint32_t sphere = 0;  ///< index in the scene, or in the prototype of the instance
  std::optional<std::uint32_t> instance{};
  double distance = 0;  ///< from the camera

  friend bool operator==(const PickedSphere&, const PickedSphere&) = default;
};

/// A kernel with its tables of a scene. All threads may read it.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// Adds the samples of each run to its sums. `emitters` counts the emitters that paths reach; it
  /// may be null. Returns false, with meaningless sums, if `cancel` was set.
  virtual bool trace(const RenderSettings& settings, EmitterTally* emitters,
                     std::span<PixelRun> runs, TraceCounts& counts,
                     const std::atomic<bool>& cancel) const = 0;
  /// The sphere at the centre of a pixel, through the centre of the lens; nullopt for the
  /// background.
  virtual std::optional<PickedSphere> pick(const RenderSettings& settings,
                                           std::uint64_t pixel) const = 0;
  /// For features_of().
  int depth_exponent() const noexcept { return -units_exponent_ - rebase_.exponent(); }
  virtual std::size_t memory_bytes() const noexcept = 0;  ///< of tables and BVH

 protected:
  /// `reach`: an upper limit for distances in the rebased scene.
  Tracer(const Rebase& rebase, double reach) noexcept;

  int units_exponent() const noexcept { return units_exponent_; }
  const Rebase& rebase() const noexcept { return rebase_; }

 private:
  Rebase rebase_;
  int units_exponent_;  // 2^this units of FirstHitSums are a distance of 1 in the rebased scene
};

struct TracerOptions {
  Precision precision = Precision::Double;
  const Backend* backend = nullptr;  ///< available on this machine, with this precision and search
  Search search = Search::Bvh;
  /// Mixed: the spheres that are computed in double, at most kMaxExactSpheres.
  std::span<const std::uint32_t> exact_spheres{};
  /// PrecisionBounds::near_pairs, if known.
  std::optional<std::span<const SpherePair>> near_pairs{};
  std::span<const std::uint32_t> lights{};   ///< the spheres from choose_lights()
  std::span<const std::uint32_t> casters{};  ///< the spheres from choose_casters()
  std::span<const Glint> glints{};           ///< Glints::images of those
  bool samples_at_metal = false;             ///< Kernel::samples_at_metal
};

/// `scene` is in world coordinates and already checked. A pinhole is on the surface of at most one
/// sphere, unless the backend allows more. Search::All allows at most kMaxWideSpheres. Throws
/// std::invalid_argument if the lens touches a surface: all camera rays start in one medium.
std::unique_ptr<const Tracer> make_tracer(Scene scene, const TracerOptions& options);

}  // namespace sdlc::render
