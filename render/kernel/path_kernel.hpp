#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include "render/film/pixel_run.hpp"
#include "render/film/trace_counts.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/math/vec3.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// Estimates, from paths with connections to lights, what the same paths without connections would
/// give; summed over paths.
struct PlainPaths {
  std::vector<Vec3> corners;  ///< like WideView::corner: the lower left corner of each run's pixel

  /// An unbiased estimate of the squared contribution of a plain path, as a mean over channels.
  /// Paths that end at the first hit are excluded, here and in the sums of the runs, because
  /// Sobol' points integrate them well. A connection represents the scattered rays that would have
  /// hit its light: with L the radiance, both count as L² times their weight in the balance
  /// heuristic, so light that scattering almost never finds is fully included.
  double squares = 0;
  std::uint64_t shadow_rays = 0;
  std::uint64_t connections = 0;  ///< shadow rays that reached their light
  std::uint64_t choices = 0;      ///< surfaces at which a light was chosen

  /// What paths without the connections of Caustics would add to the sum of the squared
  /// contributions: connections and scattered rays count as v² (1 − w) / w, with v their weighted
  /// contribution and w the weight of scattered rays in the balance heuristic.
  double squares_without_caustics = 0;
  std::uint64_t caustics = 0;      ///< connections of Caustics that reached their light
  std::uint64_t caustic_rays = 0;  ///< on the way there

  /// The same for the connections from rough metal.
  double squares_without_metal = 0;
  std::uint64_t metal_choices = 0, metal_shadow_rays = 0, metal_connections = 0;
};

/// The first hit of the last camera ray, in the tables of a WideScene.
struct PickedSlot {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::uint32_t slot = kNone;
  std::uint32_t row = 0;  ///< of the InstanceTable
  double distance = 0;    ///< in the rebased scene
};

/// The image of a light by way of a caster, seen from the camera.
struct Glint {
  struct Place {
    double x = 0, y = 0;
  };
  /// The outline of a part of the picture that contains the image, from 0 to 1, from the lower left
  /// corner.
  std::array<Place, 64> outline{};
  std::uint32_t caster = 0, light = 0;  ///< leaves of WideScene::casters and lights; in Glints the
                                        ///< spheres
  std::uint32_t chords = 0;             ///< as in SphereSweep
};

/// What all pixels of a picture share.
template <typename T>
struct WideView {
  std::uint64_t width = 0, height = 0, seed = 0;
  std::uint32_t max_depth = 1;
  /// In the image plane at distance 1, from the camera: the upper left corner of the picture, and
  /// the sides of a pixel.
  Vec3 corner, right, down;
  /// The sides within which a sample is placed; 0 if it goes through the pixel's centre.
  std::array<T, 3> spread_right{}, spread_up{};
  SamplerKind sampler = SamplerKind::Sobol;
  EmitterTally* emitters = nullptr;  ///< counts reached emitters; may be null
  /// For runs with PixelRun::first_hits: the view direction, of length 1, and the depth that is
  /// summed for a distance of 1.
  bool keeps_first_hits = false;
  std::array<T, 3> forward{};
  double depth_units = 0;
  PickedSlot* picked = nullptr;     ///< may be null
  PlainPaths* plain = nullptr;      ///< KernelFeatures::pilot
  std::span<const Glint> glints{};  ///< KernelFeatures::caustics
  /// KernelFeatures::lens: the radii of the lens to the right and upwards, and the same divided by
  /// the distance of the plane in focus. 0 sends all rays through the centre of the lens.
  std::array<T, 3> lens_right{}, lens_up{}, lens_right_in_view{}, lens_up_in_view{};
};

/// Traces all samples of `runs`, a run in one lane. Returns soon, with meaningless sums, if
/// `cancel` is set.
template <typename T>
using TraceRuns = void(const WideScene<T>& scene, const WideView<T>& view, std::span<PixelRun> runs,
                       TraceCounts& counts, const std::atomic<bool>& cancel) noexcept;

/// Features that would cost time if always compiled in. Materials are not included: testing whether
/// any lane has metal or glass costs 1 %.
struct KernelFeatures {
  bool motion = false;
  bool exact_spheres = false;  ///< WideScene::exact, in float
  bool bvh = false;            ///< Search::Bvh
  bool instances = false;      ///< WideScene::instances, in double
  bool lights = false;         ///< WideScene::lights
  bool pilot = false;          ///< WideView::plain; portable, with `bvh` and `lights`
  bool lens = false;           ///< WideView::lens_right and the others; not with `pilot`
  bool caustics = false;       ///< WideScene::casters; with `lights`, includes `lens`
};
/// The kernel with these features.
template <typename T>
using ChooseKernel = TraceRuns<T>*(KernelFeatures features) noexcept;

/// The kernels for every machine.
ChooseKernel<double> portable_kernel;

}  // namespace sdlc::render
