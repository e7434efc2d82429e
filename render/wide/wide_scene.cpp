#include "render/wide/wide_scene.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/scene/camera_surface.hpp"

namespace sdlc::render {
namespace {

template <typename T>
std::array<T, 3> rounded(LinearRgb c) {
  return {static_cast<T>(c.r), static_cast<T>(c.g), static_cast<T>(c.b)};
}

std::uint32_t surface_bits(const Material& material) {
  switch (material.type) {
    case MaterialType::Diffuse: return 0;
    case MaterialType::Specular: return material.parameter > 0 ? kMirrors | kIsFuzzy : kMirrors;
    case MaterialType::Transmissive:
      return material.fresnel == Fresnel::Exact ? kRefracts | kIsExact : kRefracts;
    default: return kEndsPath;
  }
}

/// Room for whole vectors.
constexpr std::size_t padded(std::size_t size) {
  constexpr std::size_t kMostLanes = 16;
  return (size + kMostLanes - 1) / kMostLanes * kMostLanes;
}

std::vector<std::uint32_t> without(std::size_t spheres, std::span<const std::uint32_t> excluded) {
  std::vector<std::uint32_t> rest;
  rest.reserve(spheres);
  for (std::uint32_t i = 0; i < spheres; ++i) {
    if (std::ranges::find(excluded, i) == excluded.end()) rest.push_back(i);
  }
  return rest;
}

}  // namespace

template <typename T>
WideScene<T>::WideScene(const Scene& scene, int depth, Search search_for_hits,
                        std::span<const std::uint32_t> spheres_in_double)
    : search(search_for_hits),
      exact_spheres(spheres_in_double.size()),
      max_depth(static_cast<std::uint32_t>(depth)),
      has_motion(!scene.shifts.empty()) {
  std::vector<std::uint32_t> order = without(scene.spheres.size(), spheres_in_double);
  if (search == Search::Bvh) {
    bvh = WideBvh<T>(scene, order);
    order = std::move(bvh.slots);
  }
  first_exact = order.size();
  order.insert(order.end(), spheres_in_double.begin(), spheres_in_double.end());
  slots = order.size();
  add_spheres(scene, order);

  const bool is_by_material = search == Search::Bvh;
  materials = is_by_material ? scene.materials.size() : slots;
  for (Table* table : {&color[0], &color[1], &color[2], &first, &second, &straight}) {
    table->resize(padded(materials), T{});
  }
  surface.resize(padded(materials), Index{});
  if (is_by_material) {
    for (std::size_t i = 0; i < materials; ++i) add_material(i, scene.materials[i]);
    index_in_scene = std::move(order);
  } else {
    for (std::size_t slot = 0; slot < slots; ++slot) {
      add_material(slot, scene.materials[scene.spheres[order[slot]].material]);
    }
  }
  const LinearRgb bottom = scene.background.bottom, top = scene.background.top;
  // bottom at y = −1, top at y = 1; a constant sky stays exact.
  sky_middle = rounded<T>(scene.background.is_constant() ? bottom : (bottom + top) * 0.5);
  sky_slope = rounded<T>((top - bottom) * 0.5);
}

/// Slots of no sphere, and those that round the tables up, hold a point that nothing hits.
template <typename T>
void WideScene<T>::add_spheres(const Scene& scene, std::span<const std::uint32_t> order) {
  const std::size_t size = padded(slots);
  for (Table& table : center) table.resize(size);
  if (has_motion) {
    for (Table& table : shift) table.resize(size);
  }
  radius.resize(size);
  radius_squared.resize(size);
  if (search == Search::Bvh) material.resize(size);
  constexpr std::size_t kSlotsATask = 4096;
  const auto add = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t slot = range.begin(); slot < range.end(); ++slot) {
      const bool is_empty = slot >= slots || order[slot] == WideBvh<T>::kNoSphere;
      const Sphere sphere = is_empty ? Sphere{} : scene.spheres[order[slot]];
      add_sphere(slot, sphere, has_motion && !is_empty ? scene.shifts[order[slot]] : Vec3{});
      if (search == Search::Bvh) material[slot] = sphere.material;
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kSlotsATask), add);
}

template <typename T>
void WideScene<T>::add_sphere(std::size_t slot, const Sphere& sphere, Vec3 moves) {
  const auto store = [slot](TableTriple& table, Vec3 v) {
    table[0][slot] = static_cast<T>(v.x);
    table[1][slot] = static_cast<T>(v.y);
    table[2][slot] = static_cast<T>(v.z);
  };
  store(center, sphere.center);
  if (has_motion) store(shift, moves);
  radius[slot] = static_cast<T>(sphere.radius);
  // The square of the radius that the kernel takes; a sphere of radius 0 is never hit.
  radius_squared[slot] = sphere.radius > 0 ? radius[slot] * radius[slot] : T{-1};
  if (slot >= first_exact && slot < slots) {
    exact[slot - first_exact] = {.center = {sphere.center.x, sphere.center.y, sphere.center.z},
                                 .shift = {moves.x, moves.y, moves.z},
                                 .radius_squared = sphere.radius * sphere.radius};
  }
  if (has_camera_on_it(sphere, moves)) {
    camera_sphere = static_cast<std::uint32_t>(slot);
    const Vec3 normal = unit(-sphere.center);
    camera_normal = {static_cast<T>(normal.x), static_cast<T>(normal.y), static_cast<T>(normal.z)};
  }
}

template <typename T>
std::size_t WideScene<T>::memory_bytes() const noexcept {
  std::size_t bytes = bvh.nodes.capacity() * sizeof(typename WideBvh<T>::Node) +
                      index_in_scene.capacity() * sizeof(std::uint32_t) +
                      (material.capacity() + surface.capacity()) * sizeof(Index);
  for (const TableTriple* triple : {&center, &shift, &color}) {
    for (const Table& table : *triple) bytes += table.capacity() * sizeof(T);
  }
  for (const Table* table : {&radius, &radius_squared, &first, &second, &straight}) {
    bytes += table->capacity() * sizeof(T);
  }
  return bytes;
}

template <typename T>
std::size_t WideScene<T>::estimated_bytes(const Scene& scene, Search search) noexcept {
  const std::size_t of_motion = scene.shifts.empty() ? 0 : 3 * sizeof(T);
  const std::size_t of_sphere = 5 * sizeof(T) + of_motion;  // centre, radius and its square
  const std::size_t of_material = 6 * sizeof(T) + sizeof(Index);
  if (search == Search::All) return scene.spheres.size() * (of_sphere + of_material);
  // A tenth of the slots stays empty, and a quarter of the children of nodes.
  const std::size_t slots = scene.spheres.size() / 9 * 10 + kBvhWidth;
  const std::size_t nodes = slots / kBvhWidth / 12 + 1;
  return slots * (of_sphere + sizeof(Index) + sizeof(std::uint32_t)) +
         scene.materials.size() * of_material + nodes * sizeof(typename WideBvh<T>::Node);
}

// The inverse of a tiny index is none that numbers can hold; all is reflected either way.
constexpr double kLargestIndex = 1e300;

template <typename T>
void WideScene<T>::add_material(std::size_t row, const Material& from) {
  const bool is_emissive = from.type == MaterialType::Emissive;
  const Triple rgb = rounded<T>(is_emissive ? from.color * from.parameter : from.color);
  for (std::size_t c = 0; c < 3; ++c) color[c][row] = rgb[c];
  surface[row] = surface_bits(from);
  const double p = from.parameter;
  if (from.type == MaterialType::Specular) {
    first[row] = static_cast<T>(p > 1 ? 1 / p : 1);
    second[row] = static_cast<T>(std::min(p, 1.0));
  } else if (from.type == MaterialType::Transmissive) {
    has_exact_fresnel |= from.fresnel == Fresnel::Exact;
    const double root = (1 - p) / (1 + p);
    first[row] = static_cast<T>(p);
    second[row] = static_cast<T>(std::min(1 / p, kLargestIndex));
    straight[row] = static_cast<T>(root * root);
  }
}

template struct WideScene<float>;
template struct WideScene<double>;

}  // namespace sdlc::render
