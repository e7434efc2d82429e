#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "render/film/sample_run.hpp"
#include "render/integrator/path_integrator.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::render {

/// What happened to the samples of some runs; sums of whole numbers do not depend on their order.
struct TraceCounts {
  PathCounts paths;
  std::uint64_t nonfinite_samples = 0;  ///< counted as black
};

/// A kernel with a scene made ready for it. Read by all threads.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// Adds its samples to the sum of each run. False, and sums that mean nothing, once `cancel` is
  /// set.
  virtual bool trace(std::span<SampleRun> runs, TraceCounts& counts,
                     const std::atomic<bool>& cancel) const = 0;
  virtual std::size_t memory_bytes() const noexcept = 0;  ///< of tables and hierarchy
};

/// `kernel`: of choose_kernel() for this scene, not refused. `emitters` counts what reaches them
/// and is borrowed.
std::unique_ptr<const Tracer> make_tracer(const Kernel& kernel, Scene scene,
                                          const RenderSettings& settings, EmitterTally& emitters);

}  // namespace sdlc::render
