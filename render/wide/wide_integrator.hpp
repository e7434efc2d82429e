#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "render/film/sample_run.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/scene/near_pairs.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"
#include "render/wide/isa.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {

/// What happened to the paths of some pixels.
struct WideCounts {
  std::uint64_t rays = 0;
  std::uint64_t truncated_paths = 0;  ///< cut off by the depth limit, counted as black
  std::uint64_t nonfinite_samples = 0;
};

/// A scene traced with a path in each lane of a vector. The paths are PathIntegrator's, from the
/// same random numbers; in double they differ by rounding alone. Read by all threads.
class WideIntegrator {
 public:
  struct Options {
    Precision precision = Precision::Double;
    Isa isa = Isa::Sse4;  ///< one that the machine has
    Search search = Search::All;
    /// Mixed: the spheres that are met in double, at most kMostExactSpheres.
    std::span<const std::uint32_t> exact_spheres;
    /// PrecisionBounds::near_pairs, if they are known.
    std::optional<std::span<const SpherePair>> near_pairs{};
    std::span<const std::uint32_t> lights{};  ///< the spheres of choose_lights()
    EmitterTally* emitters = nullptr;         ///< where to count what paths reach, if at all
  };

  /// `scene` is in world coordinates, already checked; the camera stands on at most one of its
  /// spheres. Search::All: there are at most kMostWideSpheres.
  WideIntegrator(Scene scene, const RenderSettings& settings, const Options& options);
  ~WideIntegrator();

  /// Traces all runs, each in one lane. False, and sums that mean nothing, once `cancel` is set.
  bool trace(std::span<SampleRun> runs, WideCounts& counts, const std::atomic<bool>& cancel) const;

  std::size_t memory_bytes() const noexcept;  ///< of tables and hierarchy

 private:
  class Tracer;
  template <typename T>
  class TracerIn;

  std::unique_ptr<const Tracer> tracer_;
};

}  // namespace sdlc::render
