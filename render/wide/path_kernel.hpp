#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "render/film/pixel_run.hpp"
#include "render/light/emitter_tally.hpp"
#include "render/math/vec3.hpp"
#include "render/wide/isa.hpp"
#include "render/wide/wide_integrator.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {

/// What all pixels of a picture share.
template <typename T>
struct WideView {
  std::uint64_t width = 0, seed = 0;
  /// In the image plane at distance 1, from the camera: the upper left corner of the picture, and
  /// the sides of a pixel.
  Vec3 corner, right, down;
  /// The sides within which a sample is placed; 0 if it goes through the pixel's centre.
  std::array<T, 3> spread_right{}, spread_up{};
  SamplerKind sampler = SamplerKind::Sobol;
  EmitterTally* emitters = nullptr;  ///< counts reached emitters; may be null
};

/// Traces all samples of `runs`, a run in one lane. Returns soon, with meaningless sums, if
/// `cancel` is set.
template <typename T>
using TraceRuns = void(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs,
                       WideCounts& counts, const std::atomic<bool>& cancel) noexcept;

/// Features that a scene needs and that would cost time if always compiled in. Materials are not
/// included: testing whether any lane has metal or glass costs 1 %.
struct WideFeatures {
  bool motion = false;
  bool exact_spheres = false;  ///< WideScene::exact, in float
  bool bvh = false;            ///< Search::Bvh
  bool instances = false;      ///< WideScene::instances, in double
  bool lights = false;         ///< WideScene::lights
};
/// The kernel for an available instruction set.
template <typename T>
TraceRuns<T>* wide_kernel(Isa isa, WideFeatures features) noexcept;
/// The kernel if WideFeatures::lights is set; it has its own source file.
template <typename T>
TraceRuns<T>* wide_kernel_with_lights(Isa isa, WideFeatures features) noexcept;
extern template TraceRuns<float>* wide_kernel_with_lights(Isa isa, WideFeatures features) noexcept;
extern template TraceRuns<double>* wide_kernel_with_lights(Isa isa, WideFeatures features) noexcept;
extern template TraceRuns<float>* wide_kernel(Isa isa, WideFeatures features) noexcept;
extern template TraceRuns<double>* wide_kernel(Isa isa, WideFeatures features) noexcept;

}  // namespace sdlc::render
