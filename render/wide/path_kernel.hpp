#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>

#include "render/light/emitter_tally.hpp"
#include "render/math/color.hpp"
#include "render/wide/isa.hpp"
#include "render/wide/wide_integrator.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {

/// Consecutive samples of one stream, within one block of a SampleSum. A single lane traces all of
/// them in order.
template <typename T>
struct SampleBlock {
  /// From the camera to the pixel's lower left corner in the image plane at distance 1.
  std::array<T, 3> corner;
  std::uint32_t first = 0;  ///< index of the first sample
  std::uint32_t count = 0;
  std::uint64_t stream_key = 0;  ///< PathSampler::stream_key
  std::array<double, 3> sum{};   ///< of the block's earlier samples
};

/// What all blocks of a picture share.
template <typename T>
struct WideView {
  std::array<T, 3> right{}, up{};  ///< a pixel's sides in the image plane
  SamplerKind sampler = SamplerKind::Sobol;
  EmitterTally* emitters = nullptr;  ///< counts reached emitters; may be null
};

/// Traces all samples of `blocks`. The sum of each block, including its earlier samples, goes into
/// `sums`, in double, one sample after the other. Returns soon, with meaningless sums, if `cancel`
/// is set.
template <typename T>
using TraceBlocks = void(const WideScene<T>& scene, const WideView<T>& view,
                         std::span<const SampleBlock<T>> blocks, std::span<LinearRgb> sums,
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
TraceBlocks<T>* wide_kernel(Isa isa, WideFeatures features) noexcept;
/// The kernel if WideFeatures::lights is set; it has its own source file.
template <typename T>
TraceBlocks<T>* wide_kernel_with_lights(Isa isa, WideFeatures features) noexcept;
extern template TraceBlocks<float>* wide_kernel_with_lights(Isa isa,
                                                            WideFeatures features) noexcept;
extern template TraceBlocks<double>* wide_kernel_with_lights(Isa isa,
                                                             WideFeatures features) noexcept;
extern template TraceBlocks<float>* wide_kernel(Isa isa, WideFeatures features) noexcept;
extern template TraceBlocks<double>* wide_kernel(Isa isa, WideFeatures features) noexcept;

}  // namespace sdlc::render
