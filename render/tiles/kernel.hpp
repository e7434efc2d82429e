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

/// How paths are traced.
enum class KernelKind : std::uint8_t {
  Scalar,  ///< one path at a time, through a hierarchy of spheres, in double
  Wide,    ///< a path in every lane of a vector, each ray against every sphere
  Bvh,     ///< a path in every lane of a vector, each ray through a hierarchy of spheres
};

/// What is asked for; nothing: whatever suits the scene. `Float` takes Mixed too, where the scene
/// asks for it.
struct KernelRequest {
  std::optional<KernelKind> kind{};
  std::optional<Precision> precision{};
  std::optional<Isa> isa{};
  /// Where float cannot be had, double does, and nothing is refused.
  bool may_take_double = false;
};

/// How a scene is traced, and in words why.
struct Kernel {
  KernelKind kind = KernelKind::Scalar;
  Precision precision = Precision::Double;
  std::optional<Isa> isa;                    ///< of the wide kernel
  std::vector<std::uint32_t> exact_spheres;  ///< Mixed: those that are met in double
  std::vector<std::uint32_t> lights;         ///< the spheres of choose_lights()
  /// How near the scene comes to what the precision resolves; of a refused request unknown.
  PrecisionBounds bounds{};
  std::string reason;
  /// Why the request cannot be met, in words that begin with its flag; empty: it is met.
  std::string refusal;
};

std::string_view name_of(KernelKind kind) noexcept;

/// The kernel that render() uses. Float, or Mixed, where bounds on rounding accept it, never by
/// what is fast, so that a scene is traced in the same numbers everywhere; the kind by a model of
/// the time a ray takes, fitted to measurements beforehand. All kinds trace the same paths, Wide
/// and Bvh to the same bits. O(n log n) time.
Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request = {});

/// What the hierarchy and the tables that the kernel reads take in memory, to a factor of 2,
/// without building anything.
std::size_t estimated_bytes(const Kernel& kernel, const Scene& scene) noexcept;

}  // namespace sdlc::render
