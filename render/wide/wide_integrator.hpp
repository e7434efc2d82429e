#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "render/film/pixel_run.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/near_pairs.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"
#include "render/wide/isa.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {

/// Statistics about the paths of some pixels.
struct WideCounts {
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;  ///< cut off by the depth limit, counted as black
  std::uint64_t nonfinite_samples = 0;
};

/// Traces a scene with one path per vector lane. The paths are those of PathIntegrator, from the
/// same random numbers; in double they differ only by rounding. All threads may read it.
class WideIntegrator {
 public:
  struct Options {
    Precision precision = Precision::Double;
    Isa isa = Isa::Sse4;  ///< must be available on this machine
    Search search = Search::All;
    /// Mixed: the spheres that are computed in double, at most kMaxExactSpheres.
    std::span<const std::uint32_t> exact_spheres;
    /// PrecisionBounds::near_pairs, if known.
    std::optional<std::span<const SpherePair>> near_pairs{};
    std::span<const std::uint32_t> lights{};  ///< the spheres from choose_lights()
    EmitterTally* emitters = nullptr;         ///< counts reached emitters; may be null
  };

  /// `scene` is in world coordinates and already checked; the camera is on the surface of at most
  /// one of its spheres. Search::All allows at most kMaxWideSpheres spheres.
  WideIntegrator(Scene scene, const RenderSettings& settings, const Options& options);
  ~WideIntegrator();

  /// Traces all runs, one lane each. Returns false, with meaningless sums, if `cancel` is set.
  bool trace(std::span<PixelRun> runs, WideCounts& counts, const std::atomic<bool>& cancel) const;

  std::size_t memory_bytes() const noexcept;  ///< of tables and BVH

 private:
  class Tracer;
  template <typename T>
  class TracerIn;

  std::unique_ptr<const Tracer> tracer_;
};

}  // namespace sdlc::render
