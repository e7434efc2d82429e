#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "render/exactness/camera_surface.hpp"
#include "render/hierarchy/instance_table.hpp"
#include "render/kernel/wide_scene.hpp"
#include "render/parallel/parallel_for.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::render {

template <typename T>
auto WideScene<T>::add_hierarchies(const Scene& scene, const Prototype& bounds)
    -> std::vector<Part> {
  std::vector<Part> parts;
  parts.reserve(scene.prototypes.size() + 1);
  // The BVHs of large prototypes are built by several threads, those of small ones in parallel.
  std::vector<WideBvh<T>> trees(scene.prototypes.size() + 1);
  parallel_for(trees.size(), [&](std::size_t i) {
    const Prototype& of = i < scene.prototypes.size() ? scene.prototypes[i] : bounds;
    Scene part;
    part.spheres = of.spheres;
    part.shifts = of.shifts;
    std::vector<std::uint32_t> primitives(of.spheres.size());
    std::iota(primitives.begin(), primitives.end(), 0U);
    trees[i] = WideBvh<T>(part, primitives);
  });
  std::size_t nodes = bvh.nodes.size();
  for (const WideBvh<T>& tree : trees) nodes += tree.nodes.size();
  bvh.nodes.reserve(nodes);
  instances.world_root = bvh.nodes.empty() ? InstanceTable::kNone : 0;
  for (WideBvh<T>& tree : trees) {
    // Leaves begin at multiples of whole vectors.
    const std::size_t first_slot = (slots + kBvhWidth - 1) / kBvhWidth * kBvhWidth;
    const auto first_leaf = static_cast<std::uint32_t>(first_slot / kBvhWidth);
    const auto first_node = static_cast<std::uint32_t>(bvh.nodes.size());
    for (typename WideBvh<T>::Node& node : tree.nodes) {
      for (std::uint32_t& child : node.children) {
        child += (child & WideBvh<T>::kLeaf) != 0 ? first_leaf : first_node;
      }
      bvh.nodes.push_back(node);
    }
    slots = first_slot + tree.slots.size();
    parts.push_back({.order = std::move(tree.slots), .first_slot = first_slot, .root = first_node});
    tree = {};
  }
  first_exact = slots;
  return parts;
}

template <typename T>
void WideScene<T>::add_instances(const Scene& scene, const Prototype& bounds,
                                 const std::vector<Part>& parts) {
  const auto add_part = [&](const Prototype& of, const Part& part) {
    add_spheres(of.spheres, of.shifts, part.order, part.first_slot, Place::Prototype);
    index_in_scene.resize(part.first_slot, WideBvh<T>::kNoSphere);
    index_in_scene.insert(index_in_scene.end(), part.order.begin(), part.order.end());
  };
  for (std::size_t i = 0; i < scene.prototypes.size(); ++i) {
    add_part(scene.prototypes[i], parts[i]);
  }
  add_part(bounds, parts.back());
  instances.root = parts.back().root;
  instances.first_bounds = static_cast<std::uint32_t>(parts.back().first_slot);
  for (const std::uint32_t instance : parts.back().order) {
    instances.row_of_bounds.push_back(instance == WideBvh<T>::kNoSphere ? 0 : instance + 1);
  }

  instances.rows.reserve((scene.instances.size() + 1) * InstanceTable::kRowSize);
  instances.add_row({}, 0);
  for (const Instance& instance : scene.instances) {
    instances.add_row(instance.placement, parts[instance.prototype].root);
  }
  if (!bounds.shifts.empty()) {
    for (auto& table : instances.shift) table.assign(scene.instances.size() + 1, 0.0);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const Vec3 shift_of_all = scene.instances[i].shift;
      instances.shift[0][i + 1] = shift_of_all.x;
      instances.shift[1][i + 1] = shift_of_all.y;
      instances.shift[2][i + 1] = shift_of_all.z;
    }
  }

  for (const auto& [i, sphere] : find_instanced_under_camera(scene)) {
    const Instance& instance = scene.instances[i];
    const Part& part = parts[instance.prototype];
    const auto place = std::ranges::find(part.order, sphere) - part.order.begin();
    instances.camera_row = i + 1;
    put_camera_on(static_cast<std::uint32_t>(part.first_slot) + static_cast<std::uint32_t>(place),
                  placed(instance, scene.prototypes[instance.prototype].spheres[sphere]));
  }
}

template auto WideScene<float>::add_hierarchies(const Scene& scene, const Prototype& bounds)
    -> std::vector<Part>;
template auto WideScene<double>::add_hierarchies(const Scene& scene, const Prototype& bounds)
    -> std::vector<Part>;
template void WideScene<float>::add_instances(const Scene& scene, const Prototype& bounds,
                                              const std::vector<Part>& parts);
template void WideScene<double>::add_instances(const Scene& scene, const Prototype& bounds,
                                               const std::vector<Part>& parts);

}  // namespace sdlc::render
