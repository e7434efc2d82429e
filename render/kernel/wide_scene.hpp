#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/exactness/precision.hpp"
#include "render/hierarchy/instance_table.hpp"
#include "render/hierarchy/wide_bvh.hpp"
#include "render/math/vector_allocator.hpp"
#include "render/scene/scene.hpp"
#include "render/shading/optics.hpp"
#include "render/shading/wide_lights.hpp"

namespace sdlc::render {

/// The max number of spheres for testing every ray with every sphere: their tables fit a
/// first-level cache.
inline constexpr std::size_t kMaxWideSpheres = 256;

/// How the first sphere on a ray is found.
enum class Search : std::uint8_t {
  All,  ///< every sphere is tested with the rays of all lanes
  Bvh,  ///< each ray traverses a BVH
};

/// A scene for the wide kernel, in numbers of type T: structure of arrays, so that one sphere's
/// number can be broadcast to all lanes, and each lane can look up the sphere it hit. Lengths are
/// those of the rebased scene, with the camera at the origin. A "slot" is a sphere's index in the
/// tables.
template <typename T>
struct WideScene {
  using Table = std::vector<T, VectorAllocator<T>>;
  using IndexTable = std::vector<std::uint32_t, VectorAllocator<std::uint32_t>>;
  using Triple = std::array<T, 3>;
  using TableTriple = std::array<Table, 3>;

  /// `scene` is rebased.
  /// Search::All allows at most kMaxWideSpheres spheres and no instances; instances require double.
  /// `exact_spheres`: the spheres to compute in double, at most kMaxExactSpheres; only if T is
  /// float. `sampled_lights`: the spheres from choose_lights(); `casters`: from choose_casters().
  /// `at_metal`: Kernel::samples_at_metal.
  explicit WideScene(const Scene& scene, Search search,
                     std::span<const std::uint32_t> exact_spheres = {},
                     std::span<const std::uint32_t> sampled_lights = {},
                     std::span<const std::uint32_t> sampled_casters = {}, bool at_metal = false);

  // Tables by slot, padded to whole vectors. Slots of spheres in double come last; the others are
  // in scene order, or in the order of the BVH with empty slots.
  TableTriple center;  ///< at shutter opening; NaN if there is nothing to hit
  TableTriple shift;   ///< displacement until the shutter closes; empty if nothing moves
  Table radius;
  Table radius_squared;                       ///< Search::All
  IndexTable material;                        ///< Search::Bvh: the rows of the colour tables
  std::vector<std::uint32_t> index_in_scene;  ///< or in its prototype, for a sphere of an instance

  // Tables by material, or by slot with Search::All.
  TableTriple color;  ///< attenuation; for materials that end the path, radiance
  IndexTable optics;  ///< Search::Bvh: the rows of the following tables

  OpticsColumns<T> bsdf;  ///< by optics, which many materials share, or by slot with Search::All

  bool samples_at_metal = false;  ///< otherwise no surface has the bits kIsRough and kIsWide
  Search search = Search::All;
  WideBvh<T> bvh;  ///< its slots are moved to index_in_scene
  /// In `bvh`, nodes and slots of prototypes follow those of the world; the BVH of instances and
  /// their bounding spheres come last. Empty without instances.
  InstanceTable instances;
  WideLights<T> lights;
  WideLights<T> casters;        ///< mirrors and glass through which lights are sampled
  std::size_t slots = 0;        ///< of all spheres, including empty slots
  std::size_t first_exact = 0;  ///< slots from here on hold spheres in double
  std::size_t materials = 0;    ///< rows of the tables by material
  std::size_t optics_rows = 0;  ///< rows of the tables by optics
  /// Spheres so large that their rounding error in float would matter for the others.
  std::size_t exact_spheres = 0;
  struct Exact {
    std::array<double, 3> center{}, shift{};
    double radius_squared = 0;
  };
  std::array<Exact, kMaxExactSpheres> exact{};

  bool has_motion = false;
  Triple sky_center{}, sky_slope{};  ///< radiance of the background: sky_center + sky_slope · y

  /// The slot of the sphere that contains the camera in its surface, or kNoCameraSphere, with its
  /// outward normal there.
  static constexpr std::uint32_t kNoCameraSphere = 0xFFFFFFFF;
  /// kSeveralCameraSpheres if there are several; only some backends support that.
  static constexpr std::uint32_t kSeveralCameraSpheres = 0xFFFFFFFE;
  std::uint32_t camera_sphere = kNoCameraSphere;
  T camera_sphere_radius = 0;
  Triple camera_normal{};
  struct CameraSphere {
    std::uint32_t slot;
    T radius;
    Triple normal;  ///< outward, at the camera
  };
  std::vector<CameraSphere> camera_spheres;  ///< all of them, by slot
  bool has_camera_on(std::uint32_t slot) const noexcept;

  std::size_t memory_bytes() const noexcept;
  /// Predicts memory_bytes() to within a factor of 2, without building anything.
  static std::size_t estimated_bytes(const Scene& scene, Search search) noexcept;

 private:
  void make_room_for_spheres();
  enum class Place : std::uint8_t { World, Prototype };
  /// Adds the spheres of a scene or prototype, in the slots from `first_slot` on.
  void add_spheres(const std::vector<Sphere>& spheres, const std::vector<Vec3>& shifts,
                   std::span<const std::uint32_t> order, std::size_t first_slot, Place place);
  void add_sphere(std::size_t slot, const Sphere& sphere, Vec3 moves);
  void put_camera_on(std::uint32_t slot, const Sphere& sphere);
  /// The BVH of a prototype's spheres, or of the instances' bounding spheres. `order` is the sphere
  /// in each slot from the first one on.
  struct Part {
    std::vector<std::uint32_t> order;
    std::size_t first_slot = 0;
    std::uint32_t root = 0;
  };
  /// Appends the nodes of each prototype, then those for `bounds`, and counts their slots.
  std::vector<Part> add_hierarchies(const Scene& scene, const Prototype& bounds);
  void add_instances(const Scene& scene, const Prototype& bounds, const std::vector<Part>& parts);
  void add_materials(const Scene& scene);
  void add_materials_by_slot(const Scene& scene, std::span<const std::uint32_t> order);
  void make_room_for_materials();
  void make_room_for_optics();
  void add_color(std::size_t row, const Material& material);
  void add_optics(std::size_t row, const Optics& of);
};

extern template struct WideScene<float>;
extern template struct WideScene<double>;

}  // namespace sdlc::render
