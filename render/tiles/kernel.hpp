#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"
#include "render/wide/isa.hpp"
#include "render/wide/wide_integrator.hpp"

namespace sdlc::render {

/// The kernels that trace paths.
enum class KernelKind : std::uint8_t {
  Scalar,  ///< one path at a time, through a BVH, in double
  Wide,    ///< one path per vector lane, each ray tested with every sphere
  Bvh,     ///< one path per vector lane, each ray through a BVH
};

/// The requested kernel; unset members are chosen to suit the scene. `Float` allows Mixed if the
/// scene requires it.
struct KernelRequest {
  std::optional<KernelKind> kind{};
  std::optional<Precision> precision{};
  std::optional<Isa> isa{};
  /// If float is not possible, use double instead of refusing.
  bool may_take_double = false;
};

/// The chosen kernel, and the reason in words.
struct Kernel {
  KernelKind kind = KernelKind::Scalar;
  Precision precision = Precision::Double;
  std::optional<Isa> isa;                    ///< of the wide kernels
  std::vector<std::uint32_t> exact_spheres;  ///< Mixed only: the spheres that are computed in
                                             ///< double
  std::vector<std::uint32_t> lights;         ///< the spheres from choose_lights()
  /// How close the scene comes to the limits of the precision; unknown for a refused request.
  PrecisionBounds bounds{};
  std::string reason;
  /// Why the request cannot be met, beginning with the name of the flag; empty if it is met.
  std::string refusal;
};

std::string_view name_of(KernelKind kind) noexcept;

/// Chooses the kernel for render(). The precision is Float or Mixed if the rounding bounds accept
/// it, never for speed alone, so a scene is traced in the same precision on every machine. The kind
/// follows from a model of the time per ray, fitted to measurements. All kinds trace the same
/// paths, Wide and Bvh bit-identically. O(n log n) time.
Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request = {});

/// Estimates the memory of the kernel's BVH and tables to within a factor of 2, without building
/// anything.
std::size_t estimated_bytes(const Kernel& kernel, const Scene& scene) noexcept;

}  // namespace sdlc::render
