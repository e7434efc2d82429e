#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "render/film/pixel_run.hpp"
#include "render/integrator/path_integrator.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::render {

/// Statistics about the samples of some runs. Sums of integers do not depend on their order.
struct TraceCounts {
  PathCounts paths;
  std::uint64_t nonfinite_samples = 0;  ///< counted as black
};

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

/// `kernel`: from choose_kernel() for this scene, not refused. `emitters` counts the emitters that
/// paths reach; the tracer keeps a reference.
std::unique_ptr<const Tracer> make_tracer(const Kernel& kernel, Scene scene,
                                          const RenderSettings& settings, EmitterTally& emitters);

}  // namespace sdlc::render
