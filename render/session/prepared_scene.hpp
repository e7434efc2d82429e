#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "render/kernel/kernel.hpp"
#include "render/kernel/tracer.hpp"
#include "render/scene/scene.hpp"
#include "render/shading/emitter_tally.hpp"

namespace sdlc::render {

/// A scene with all that a kernel requires to trace it: tables, BVH and lights. Any number of
/// renders may use it, also at the same time.
class PreparedScene {
 public:
  /// `kernel`: from choose_kernel() for this scene, not refused. Builds on `threads` threads, 0 for
  /// all of the hardware.
  PreparedScene(Kernel kernel, Scene scene, int threads);

  const Kernel& kernel() const noexcept { return kernel_; }  ///< without its near pairs
  const Tracer& tracer() const noexcept { return *tracer_; }
  const EmitterClasses& emitters() const noexcept { return emitters_; }
  /// The sphere at the centre of a pixel, counted row by row from the top left; nullopt for the
  /// background. Moving spheres are where the pixel's first sample finds them.
  std::optional<PickedSphere> pick(const RenderSettings& settings, std::uint64_t pixel) const {
    return tracer_->pick(settings, pixel);
  }
  std::size_t memory_bytes() const noexcept { return tracer_->memory_bytes(); }
  double build_seconds() const noexcept { return build_seconds_; }

 private:
  friend PreparedScene prepare(Scene scene, const RenderSettings& settings,
                               const KernelRequest& request);

  Kernel kernel_;
  EmitterClasses emitters_;
  std::unique_ptr<const Tracer> tracer_;
  double build_seconds_ = 0;
};

/// Chooses the kernel, and prepares the scene for it; both count as building. The scene can be
/// rendered with all settings for which choose_kernel() decides the same. Throws
/// std::invalid_argument if the request is refused.
PreparedScene prepare(Scene scene, const RenderSettings& settings,
                      const KernelRequest& request = {});

}  // namespace sdlc::render
