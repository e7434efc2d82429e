#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/exactness/precision.hpp"
#include "render/kernel/backend.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// The requested kernel; unset members are chosen to suit the scene. `Float` allows Mixed if the
/// scene requires it.
struct KernelRequest {
  std::optional<Search> search{};
  std::optional<Precision> precision{};
  const Backend* backend = nullptr;
  /// If float is not possible, use double instead of refusing.
  bool may_take_double = false;
};

/// Why a kernel cannot trace a scene, or not as requested.
enum class KernelObstacle : std::uint8_t {
  OtherMachine,      ///< this machine lacks the backend's instructions
  NoVectors,         ///< this machine has no vector backend
  NoSpheres,         ///< left to the portable backend
  TooManySpheres,    ///< for Search::All
  SeveralSurfaces,   ///< contain the camera
  PortableInDouble,  ///< the portable backend has no other precision
  InstancesByBvh,
  InstancesInDouble,
};
/// As a clause.
std::string describe(KernelObstacle obstacle);

/// A request that cannot be met.
struct KernelRefusal {
  /// The part of the request, or the scene's instances, which the caller may expand.
  enum class Subject : std::uint8_t { Search, Precision, Backend, Instances };
  Subject subject{};
  KernelObstacle obstacle{};
  const Backend* backend = nullptr;  ///< the requested one

  friend bool operator==(const KernelRefusal&, const KernelRefusal&) = default;
};

/// What decided about the search, in nanoseconds per ray: SearchCost.
struct ModelledTimes {
  double all = 0, bvh = 0;
};

/// The chosen kernel and the reasons for the choice.
struct Kernel {
  Search search = Search::Bvh;
  Precision precision = Precision::Double;
  const Backend* backend = &portable_backend();
  std::vector<std::uint32_t> exact_spheres;  ///< Mixed only: the spheres that are computed in
                                             ///< double
  std::vector<std::uint32_t> lights;         ///< the spheres from choose_lights()
  std::vector<std::uint32_t> casters;        ///< the spheres from choose_casters()
  bool samples_at_metal = false;             ///< rough metal samples `lights`, too
  bool may_have_casters = false;             ///< LightSampling::Caustics would choose some
  /// What LightSampling::Auto chose, as a clause: "off", "on, 12 lights, also at metal",
  /// "caustics, 1 light"; empty without a choice.
  std::string light_choice;
  /// How close the scene comes to the limits of the precision; unknown for a refused request.
  PrecisionBounds bounds{};
  std::string precision_reason;  ///< as a clause; empty if `obstacle` or `refusal` is the reason
  std::optional<KernelObstacle> obstacle;  ///< why no vectors were chosen, which is allowed
  std::optional<ModelledTimes> ray_times;  ///< none if only one search is possible or requested
  std::optional<KernelRefusal> refusal;

  bool is_portable() const noexcept { return backend == &portable_backend(); }
};

/// scalar: the portable backend; wide: Search::All; bvh: Search::Bvh.
std::string_view name_of(const Kernel& kernel) noexcept;

/// Chooses the kernel for render(). The precision is Float or Mixed if the rounding bounds accept
/// it, never for speed alone, so a scene is traced in the same precision on every machine. The
/// search follows from SearchCost. All kernels trace the same paths; both searches give the same
/// bytes. O(n log n) time.
Kernel choose_kernel(const Scene& scene, const RenderSettings& settings,
                     const KernelRequest& request = {});

/// Estimates the memory of the kernel's BVH and tables to within a factor of 2, without building
/// anything.
std::size_t estimated_bytes(const Kernel& kernel, const Scene& scene) noexcept;

}  // namespace sdlc::render
