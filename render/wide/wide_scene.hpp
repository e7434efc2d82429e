#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"
#include "render/wide/instance_table.hpp"
#include "render/wide/optics.hpp"
#include "render/wide/vector_allocator.hpp"
#include "render/wide/wide_bvh.hpp"
#include "render/wide/wide_lights.hpp"

namespace sdlc::render {

/// The most spheres that every ray is held against: their tables then fit a first-level cache.
inline constexpr std::size_t kMostWideSpheres = 256;

/// How the first sphere on a ray is found.
enum class Search : std::uint8_t {
  All,  ///< every sphere is held against the rays of all lanes
  Bvh,  ///< each ray goes through a hierarchy of spheres
};

/// A scene as the wide kernel reads it, in numbers of type T: one table for each quantity, so that
/// one sphere's number can be spread over all lanes, and each lane can look up that of the sphere
/// it hit. Lengths are those of the rebased scene, with the camera at the origin. A "slot" is a
/// sphere's place in the tables.
template <typename T>
struct WideScene {
  using Table = std::vector<T, VectorAllocator<T>>;
  using IndexTable = std::vector<std::uint32_t, VectorAllocator<std::uint32_t>>;
  using Triple = std::array<T, 3>;
  using TableTriple = std::array<Table, 3>;

  /// `scene` is rebased, and the camera stands on at most one of its spheres. Search::All: it has
  /// at most kMostWideSpheres, and no instances, which there are only in double. `exact_spheres`:
  /// those to be met in double, at most kMostExactSpheres, none unless T is float.
  /// `sampled_lights`: those of choose_lights().
  WideScene(const Scene& scene, int depth, Search search,
            std::span<const std::uint32_t> exact_spheres = {},
            std::span<const std::uint32_t> sampled_lights = {});

  // Tables by slot, whole vectors long. The slots of spheres to be met in double come last; the
  // others are in the scene's order, or in that of the hierarchy, with slots of no sphere.
  TableTriple
      center;         ///< at the opening of the shutter; not a number where there is nothing to hit
  TableTriple shift;  ///< up to its closing; empty where nothing moves
  Table radius;
  Table radius_squared;                       ///< Search::All
  IndexTable material;                        ///< Search::Bvh: the rows of the tables of colours
  std::vector<std::uint32_t> index_in_scene;  ///< or, of an instance's sphere, in its prototype

  // Tables by material, or by slot with Search::All.
  TableTriple color;  ///< attenuation; the radiance where the path ends
  IndexTable optics;  ///< Search::Bvh: the rows of the tables that follow

  // Tables by optics, of which many materials share one, or by slot with Search::All. What a
  // quantity means for others is never used.
  /// kMirrors: the weights of the mirrored direction and of the ball around it, the larger one 1,
  /// so that neither overflows. kRefracts: the index of refraction and its inverse.
  Table first;
  Table second;
  Table straight;      ///< kRefracts: share reflected at normal incidence
  IndexTable surface;  ///< SurfaceBits

  Search search = Search::All;
  WideBvh<T> bvh;  ///< its slots are taken over by index_in_scene
  /// Prototypes have nodes behind those of the world, and slots behind its slots; the hierarchy of
  /// instances and their balls come last. Empty without instances.
  InstanceTable instances;
  WideLights<T> lights;
  std::size_t slots = 0;        ///< of all spheres, holes among them
  std::size_t first_exact = 0;  ///< slots from here on hold spheres that are met in double
  std::size_t materials = 0;    ///< rows of the tables by material
  std::size_t optics_rows = 0;  ///< and of those by optics
  /// A rounding error of so large a sphere would be no small part of others.
  std::size_t exact_spheres = 0;
  struct Exact {
    std::array<double, 3> center{}, shift{};
    double radius_squared = 0;
  };
  std::array<Exact, kMostExactSpheres> exact{};

  std::uint32_t max_depth = 1;
  bool has_motion = false;
  bool has_exact_fresnel = false;
  Triple sky_middle{}, sky_slope{};  ///< radiance of the sky: middle + slope · y

  /// The slot of the sphere on whose surface the camera stands, or kNoCameraSphere, and its outward
  /// normal there.
  static constexpr std::uint32_t kNoCameraSphere = 0xFFFFFFFF;
  std::uint32_t camera_sphere = kNoCameraSphere;
  T camera_sphere_radius = 0;
  Triple camera_normal{};

  std::size_t memory_bytes() const noexcept;
  /// What memory_bytes() will be, without building anything, to a factor of 2.
  static std::size_t estimated_bytes(const Scene& scene, Search search) noexcept;

 private:
  void make_room_for_spheres();
  enum class Place : std::uint8_t { World, Prototype };
  /// Those of a scene or prototype, in the slots from `first_slot` on.
  void add_spheres(const std::vector<Sphere>& spheres, const std::vector<Vec3>& shifts,
                   std::span<const std::uint32_t> order, std::size_t first_slot, Place place);
  void add_sphere(std::size_t slot, const Sphere& sphere, Vec3 moves);
  void stand_on(std::uint32_t slot, const Sphere& sphere);
  /// The hierarchy of a prototype's spheres, or of balls around instances: which of them is in each
  /// slot from the first one on.
  struct Part {
    std::vector<std::uint32_t> order;
    std::size_t first_slot = 0;
    std::uint32_t root = 0;
  };
  /// Puts nodes of each prototype, and those of `balls` last, behind those that there are, and
  /// counts their slots.
  std::vector<Part> add_hierarchies(const Scene& scene, const Prototype& balls);
  void add_instances(const Scene& scene, const Prototype& balls, const std::vector<Part>& parts);
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
