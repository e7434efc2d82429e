#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "render/film/pixel_run.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/near_pairs.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"
#include "render/wide/backend.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {

/// A kernel prepared for a scene. All threads may read it.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// Adds the samples of each run to its sums. Returns false, with meaningless sums, if `cancel`
  /// was set.
  virtual bool trace(std::span<PixelRun> runs, TraceCounts& counts,
                     const std::atomic<bool>& cancel) const = 0;
  virtual std::size_t memory_bytes() const noexcept = 0;  ///< of tables and BVH
};

struct TracerOptions {
  Precision precision = Precision::Double;
  const Backend* backend = nullptr;  ///< available on this machine, with this precision and search
  Search search = Search::Bvh;
  /// Mixed: the spheres that are computed in double, at most kMaxExactSpheres.
  std::span<const std::uint32_t> exact_spheres{};
  /// PrecisionBounds::near_pairs, if known.
  std::optional<std::span<const SpherePair>> near_pairs{};
  std::span<const std::uint32_t> lights{};  ///< the spheres from choose_lights()
  EmitterTally* emitters = nullptr;         ///< counts reached emitters; may be null
};

/// `scene` is in world coordinates and already checked; the camera is on the surface of at most one
/// of its spheres, unless the backend allows more. Search::All allows at most kMaxWideSpheres.
std::unique_ptr<const Tracer> make_tracer(Scene scene, const RenderSettings& settings,
                                          const TracerOptions& options);

}  // namespace sdlc::render
