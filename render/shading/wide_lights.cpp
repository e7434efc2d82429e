#include "render/shading/wide_lights.hpp"

#include "render/parallel/ranges.hpp"

namespace sdlc::render {
namespace {

/// Rounds up to whole vectors.
constexpr std::size_t padded(std::size_t size) {
  constexpr std::size_t kMaxLanes = 16;
  return (size + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
}

}  // namespace

template <typename T>
WideLights<T>::WideLights(const Lights& lights, std::span<const std::uint32_t> order,
                          std::size_t slots) {
  if (lights.empty()) return;
  const auto& from_nodes = lights.tree().nodes();
  nodes = static_cast<std::uint32_t>(from_nodes.size());
  leaves = static_cast<std::uint32_t>(lights.leaves().size());
  levels = lights.tree().levels();
  const auto resize = [](std::size_t size, auto&... triples) {
    for (TableTriple* triple : {&triples...}) {
      for (Table& table : *triple) table.resize(padded(size), T{});
    }
  };
  const auto store = [](TableTriple& table, std::size_t row, double x, double y, double z) {
    table[0][row] = static_cast<T>(x);
    table[1][row] = static_cast<T>(y);
    table[2][row] = static_cast<T>(z);
  };
  resize(nodes, node_center);
  node_radius.resize(padded(nodes), T{});
  node_power.resize(padded(nodes), T{});
  for (std::size_t i = 0; i < nodes; ++i) {
    const LightTree::Node& node = from_nodes[i];
    store(node_center, i, node.center.x, node.center.y, node.center.z);
    node_radius[i] = static_cast<T>(node.radius);
    node_power[i] = static_cast<T>(node.power);
  }
  resize(leaves, center, shift, radiance);
  radius.resize(padded(leaves), T{});
  slot.resize(padded(leaves), 0);
  for (std::size_t i = 0; i < leaves; ++i) {
    const Light& light = lights.leaves()[i];
    store(center, i, light.center.x, light.center.y, light.center.z);
    store(shift, i, light.shift.x, light.shift.y, light.shift.z);
    store(radiance, i, light.radiance.r, light.radiance.g, light.radiance.b);
    radius[i] = static_cast<T>(light.radius);
  }
  leaf_of_slot.resize(padded(slots), kNoLight);
  for_each_index(order.size(), [&](std::size_t i) {
    const std::uint32_t leaf = lights.leaf_of(order[i]);
    leaf_of_slot[i] = leaf;
    if (leaf != kNoLight) slot[leaf] = static_cast<std::uint32_t>(i);
  });
}

template <typename T>
std::size_t WideLights<T>::memory_bytes() const noexcept {
  std::size_t bytes = (slot.capacity() + leaf_of_slot.capacity()) * sizeof(std::uint32_t);
  for (const TableTriple* triple : {&node_center, &center, &shift, &radiance}) {
    for (const Table& table : *triple) bytes += table.capacity() * sizeof(T);
  }
  for (const Table* table : {&node_radius, &node_power, &radius}) {
    bytes += table->capacity() * sizeof(T);
  }
  return bytes;
}

template struct WideLights<float>;
template struct WideLights<double>;

}  // namespace sdlc::render
