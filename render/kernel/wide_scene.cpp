#include "render/kernel/wide_scene.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>
#include <vector>

#include "render/exactness/camera_surface.hpp"
#include "render/exactness/near_pairs.hpp"
#include "render/parallel/ranges.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {
namespace {

template <typename T>
std::array<T, 3> rounded(LinearRgb c) {
  return {static_cast<T>(c.r), static_cast<T>(c.g), static_cast<T>(c.b)};
}

/// Rounds up to whole vectors.
constexpr std::size_t padded(std::size_t size) {
  constexpr std::size_t kMaxLanes = 16;
  return (size + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

std::vector<std::uint32_t> without(std::size_t spheres, std::span<const std::uint32_t> excluded) {
  std::vector<std::uint32_t> rest;
  if (excluded.empty()) {
    rest.resize(spheres);
    for_each_index(spheres, [&](std::size_t i) { rest[i] = static_cast<std::uint32_t>(i); });
    return rest;
  }
  rest.reserve(spheres);
  for (std::uint32_t i = 0; i < spheres; ++i) {
    if (!contains(excluded, i)) rest.push_back(i);
  }
  return rest;
}

}  // namespace

template <typename T>
WideScene<T>::WideScene(const Scene& scene, Search search_for_hits,
                        std::span<const std::uint32_t> spheres_in_double,
                        std::span<const std::uint32_t> sampled_lights,
                        std::span<const std::uint32_t> sampled_casters, bool at_metal)
    : samples_at_metal(at_metal),
      search(search_for_hits),
      exact_spheres(spheres_in_double.size()),
      has_motion(render::has_motion(scene)) {
  std::vector<std::uint32_t> order = without(scene.spheres.size(), spheres_in_double);
  if (search == Search::Bvh) {
    bvh = WideBvh<T>(scene, order);
    order = std::move(bvh.slots);
  }
  first_exact = order.size();
  slots = first_exact + exact_spheres;
  order.reserve(slots);
  order.insert(order.end(), spheres_in_double.begin(), spheres_in_double.end());
  const Prototype bounds = instance_bounds(scene);
  std::vector<Part> parts;
  if (!scene.instances.empty()) parts = add_hierarchies(scene, bounds);
  lights = WideLights<T>(Lights(scene, sampled_lights), order, slots);
  casters = WideLights<T>(Lights::casters(scene, sampled_casters), order, slots);
  make_room_for_spheres();
  add_spheres(scene.spheres, scene.shifts, order, 0, Place::World);
  if (search == Search::Bvh) {
    add_materials(scene);
  } else {
    add_materials_by_slot(scene, order);
  }
  index_in_scene = std::move(order);
  if (!scene.instances.empty()) add_instances(scene, bounds, parts);
  const LinearRgb bottom = scene.background.bottom, top = scene.background.top;
  // bottom at y = −1, top at y = 1; a constant background stays exact.
  sky_center = rounded<T>(scene.background.is_constant() ? bottom : (bottom + top) * 0.5);
  sky_slope = rounded<T>((top - bottom) * 0.5);
}

template <typename T>
void WideScene<T>::make_room_for_spheres() {
  const std::size_t size = padded(slots);
  for (Table& table : center) table.resize(size);
  if (has_motion) {
    for (Table& table : shift) table.resize(size);
  }
  radius.resize(size);
  if (search == Search::All) radius_squared.resize(size);
  if (search == Search::Bvh) material.resize(size);
}

/// Empty slots and padding hold a sphere of radius 0.
template <typename T>
void WideScene<T>::add_spheres(const std::vector<Sphere>& spheres, const std::vector<Vec3>& shifts,
                               std::span<const std::uint32_t> order, std::size_t first_slot,
                               Place place) {
  constexpr std::size_t kSlotsPerTask = 4096;
  std::mutex mutex;
  const auto add = [&](std::size_t i) {
    const bool is_empty = i >= order.size() || order[i] == WideBvh<T>::kNoSphere;
    const Sphere sphere = is_empty ? Sphere{} : spheres[order[i]];
    const Vec3 moves = is_empty || shifts.empty() ? Vec3{} : shifts[order[i]];
    add_sphere(first_slot + i, sphere, moves);
    if (place == Place::World && has_camera_on_it(sphere, moves)) {
      const std::lock_guard lock(mutex);
      put_camera_on(static_cast<std::uint32_t>(first_slot + i), sphere);
    }
    if (search == Search::Bvh) material[first_slot + i] = sphere.material;
  };
  parallel_for(padded(order.size()), add, kSlotsPerTask);
  std::ranges::sort(camera_spheres, {}, &CameraSphere::slot);
}

template <typename T>
void WideScene<T>::add_sphere(std::size_t slot, const Sphere& sphere, Vec3 moves) {
  const auto store = [slot](TableTriple& table, Vec3 v) {
    table[0][slot] = static_cast<T>(v.x);
    table[1][slot] = static_cast<T>(v.y);
    table[2][slot] = static_cast<T>(v.z);
  };
  // A sphere of radius 0 is never hit: every comparison with NaN is false.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  store(center, sphere.radius > 0 ? sphere.center : Vec3{kNone, kNone, kNone});
  if (has_motion) store(shift, moves);
  radius[slot] = static_cast<T>(sphere.radius);
  // The square of the rounded radius, which the kernel uses.
  if (search == Search::All) radius_squared[slot] = radius[slot] * radius[slot];
  if (slot >= first_exact && slot < slots) {
    exact[slot - first_exact] = {.center = {sphere.center.x, sphere.center.y, sphere.center.z},
                                 .shift = {moves.x, moves.y, moves.z},
                                 .radius_squared = sphere.radius * sphere.radius};
  }
}

template <typename T>
void WideScene<T>::put_camera_on(std::uint32_t slot, const Sphere& sphere) {
  camera_sphere = camera_spheres.empty() ? slot : kSeveralCameraSpheres;
  camera_sphere_radius = static_cast<T>(sphere.radius);
  const Vec3 normal = unit(-sphere.center);
  camera_normal = {static_cast<T>(normal.x), static_cast<T>(normal.y), static_cast<T>(normal.z)};
  camera_spheres.push_back({slot, camera_sphere_radius, camera_normal});
}

template <typename T>
bool WideScene<T>::has_camera_on(std::uint32_t slot) const noexcept {
  return std::ranges::find(camera_spheres, slot, &CameraSphere::slot) != camera_spheres.end();
}

template <typename T>
void WideScene<T>::add_materials(const Scene& scene) {
  materials = scene.materials.size();
  make_room_for_materials();
  optics.resize(padded(materials));
  std::fill(optics.begin() + static_cast<std::ptrdiff_t>(materials), optics.end(), 0);
  // Collects the distinct optics of each range, then of all, in order of first occurrence.
  const std::size_t ranges = (materials + kRange - 1) / kRange;
  std::vector<OpticsTable> of_ranges(ranges);
  const auto for_ranges = [&](const auto& body) {
    parallel_for(ranges, [&](std::size_t range) {
      const std::size_t end = std::min(materials, (range + 1) * kRange);
      for (std::size_t i = range * kRange; i < end; ++i) body(range, i);
    });
  };
  for_ranges([&](std::size_t range, std::size_t i) {
    add_color(i, scene.materials[i]);
    optics[i] = of_ranges[range].row_of(optics_of(scene.materials[i]));
  });
  OpticsTable table;
  std::vector<std::vector<std::uint32_t>> rows(ranges);
  for (std::size_t range = 0; range < ranges; ++range) {
    for (const Optics& of : of_ranges[range].rows()) rows[range].push_back(table.row_of(of));
  }
  for_ranges([&](std::size_t range, std::size_t i) { optics[i] = rows[range][optics[i]]; });
  optics_rows = table.rows().size();
  make_room_for_optics();
  for (std::size_t i = 0; i < optics_rows; ++i) add_optics(i, table.rows()[i]);
}

template <typename T>
void WideScene<T>::add_materials_by_slot(const Scene& scene, std::span<const std::uint32_t> order) {
  materials = optics_rows = slots;
  make_room_for_materials();
  make_room_for_optics();
  for (std::size_t slot = 0; slot < slots; ++slot) {
    const Material& of = scene.materials[scene.spheres[order[slot]].material];
    add_color(slot, of);
    add_optics(slot, optics_of(of));
  }
}

template <typename T>
void WideScene<T>::make_room_for_materials() {
  for (Table& table : color) {
    table.resize(padded(materials));
    std::fill(table.begin() + static_cast<std::ptrdiff_t>(materials), table.end(), T{});
  }
}

template <typename T>
void WideScene<T>::make_room_for_optics() {
  for (Table* table : {&bsdf.first, &bsdf.second, &bsdf.straight}) {
    table->resize(padded(optics_rows), T{});
  }
  bsdf.surface.resize(padded(optics_rows), 0);
}

template <typename T>
void WideScene<T>::add_color(std::size_t row, const Material& from) {
  const bool is_emissive = from.type == MaterialType::Emissive;
  const Triple rgb = rounded<T>(is_emissive ? from.color * from.parameter : from.color);
  for (std::size_t c = 0; c < 3; ++c) color[c][row] = rgb[c];
}

// The inverse of a tiny refractive index overflows; everything is reflected in any case.
constexpr double kLargestIndex = 1e300;

template <typename T>
void WideScene<T>::add_optics(std::size_t row, const Optics& of) {
  const std::uint32_t unused = samples_at_metal ? 0 : kIsRough | kIsWide;
  bsdf.surface[row] = of.surface & ~unused;
  const double p = of.parameter;
  if ((of.surface & kMirrors) != 0) {
    bsdf.first[row] = static_cast<T>(p > 1 ? 1 / p : 1);
    bsdf.second[row] = static_cast<T>(std::min(p, 1.0));
  } else if ((of.surface & kRefracts) != 0) {
    bsdf.has_exact_fresnel |= (of.surface & kIsExact) != 0;
    const double root = (1 - p) / (1 + p);
    bsdf.first[row] = static_cast<T>(p);
    bsdf.second[row] = static_cast<T>(std::min(1 / p, kLargestIndex));
    bsdf.straight[row] = static_cast<T>(root * root);
  }
}

template <typename T>
std::size_t WideScene<T>::memory_bytes() const noexcept {
  std::size_t bytes = bvh.nodes.capacity() * sizeof(typename WideBvh<T>::Node) +
                      instances.memory_bytes() + lights.memory_bytes() + casters.memory_bytes() +
                      index_in_scene.capacity() * sizeof(std::uint32_t);
  for (const IndexTable* table : {&material, &optics, &bsdf.surface}) {
    bytes += table->capacity() * sizeof(std::uint32_t);
  }
  for (const TableTriple* triple : {&center, &shift, &color}) {
    for (const Table& table : *triple) bytes += table.capacity() * sizeof(T);
  }
  for (const Table* table : {&radius, &radius_squared, &bsdf.first, &bsdf.second, &bsdf.straight}) {
    bytes += table->capacity() * sizeof(T);
  }
  return bytes;
}

template <typename T>
std::size_t WideScene<T>::estimated_bytes(const Scene& scene, Search search) noexcept {
  const std::size_t of_sphere = (render::has_motion(scene) ? 7 : 4) * sizeof(T);
  const std::size_t of_material = 3 * sizeof(T) + sizeof(std::uint32_t);  // optics are few
  if (search == Search::All) return scene.spheres.size() * (of_sphere + of_material + sizeof(T));
  // About a tenth of the slots is empty, and a quarter of the children of nodes.
  const auto hierarchy = [&](std::size_t spheres) {
    const std::size_t slots = (spheres / 9 * 10 + kBvhWidth) / kBvhWidth * kBvhWidth;
    const std::size_t nodes = slots / kBvhWidth / 12 + 1;
    return slots * (of_sphere + 2 * sizeof(std::uint32_t)) +
           nodes * sizeof(typename WideBvh<T>::Node);
  };
  std::size_t bytes = scene.materials.size() * of_material + hierarchy(scene.spheres.size());
  for (const Prototype& prototype : scene.prototypes) bytes += hierarchy(prototype.spheres.size());
  if (scene.instances.empty()) return bytes;
  return bytes + hierarchy(scene.instances.size()) +
         scene.instances.size() * InstanceTable::kRowSize * sizeof(T);
}

template struct WideScene<float>;
template struct WideScene<double>;

}  // namespace sdlc::render
