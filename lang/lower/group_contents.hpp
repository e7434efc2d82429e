#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lang/lower/material_table.hpp"
#include "render/math/placement.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// The effect of a group, or of several nested ones, on their contents.
struct Placing {
  std::array<render::Placement, 2> placements;  ///< at the opening and the closing of the shutter
  bool is_moving = false;
  std::optional<render::Material> material;  ///< of spheres inside without one of their own

  /// The placing of the contents of a group with the placing `inner` inside this one.
  Placing around(const Placing& inner) const;
  /// Whether everything inside moves by the same vector.
  bool keeps_shape() const noexcept;
};

/// Spheres in the order in which they were added.
struct PlacedSpheres {
  std::vector<render::Sphere> spheres;
  std::vector<render::Vec3> shifts;  ///< of the first spheres; the others do not move

  void add(const render::Sphere& sphere, render::Vec3 shift);
  void shrink_to(std::size_t count);
};

/// A sphere inside a group.
struct InnerSphere {
  render::Vec3 center, closing;           ///< at the opening and the closing, in the group
  double radius = 0;                      ///< in the group
  std::optional<std::uint32_t> material;  ///< index in the MaterialTable; nullopt: the group's
  bool is_moving = false;                 ///< without the group

  /// Adds the sphere to `to`, placed by `placing`, with the given material. Returns false and adds
  /// nothing if its numbers would be beyond the range of double.
  bool add_to(PlacedSpheres& to, const Placing& placing, std::uint32_t material_there) const;
};

/// The recorded contents of a group. The groups in it have numbers from 1; 0 is the group itself.
class GroupContents {
 public:
  /// Another group's contents, inside a group of these.
  struct Reference {
    std::uint32_t group;
    std::uint32_t contents;
    std::size_t before;  ///< number of spheres before it
  };

  std::uint32_t add_group(std::uint32_t parent, Placing placing);
  /// Removes the groups from this number on, which are empty.
  void remove_groups_from(std::uint32_t group);
  void add_sphere(std::uint32_t group, const InnerSphere& sphere);
  void add_reference(std::uint32_t group, std::uint32_t number, const GroupContents& contents);

  /// The number of spheres, including those of references at each occurrence; saturates at
  /// 2^64 - 1.
  std::uint64_t count() const noexcept { return count_; }
  /// Whether any sphere inherits its material from outside.
  bool inherits() const noexcept { return inherits_; }
  const std::vector<Reference>& references() const noexcept { return references_; }
  /// The number of spheres, excluding those of references.
  std::size_t own_count() const noexcept { return spheres_.size(); }
  /// The number of spheres and references.
  std::size_t parts() const noexcept { return spheres_.size() + references_.size(); }

  /// Calls `on_sphere(sphere, placing)` and `on_reference(reference, placing)` in order, with the
  /// placing in the world. Stops and returns false once a call returns false.
  template <typename OnSphere, typename OnReference>
  bool for_each(const Placing& outside, const OnSphere& on_sphere,
                const OnReference& on_reference) const {
    std::vector<Placing> placings{outside};
    placings.reserve(groups_.size() + 1);
    for (const Group& group : groups_) {
      placings.push_back(placings[group.parent].around(group.placing));
    }
    auto reference = references_.begin();
    for (std::size_t i = 0; i <= spheres_.size(); ++i) {
      for (; reference != references_.end() && reference->before == i; ++reference) {
        if (!on_reference(*reference, placings[reference->group])) return false;
      }
      if (i == spheres_.size()) break;
      if (!on_sphere(spheres_[i], placings[group_of_[i]])) return false;
    }
    return true;
  }

 private:
  struct Group {
    std::uint32_t parent;
    Placing placing;
  };

  bool inherits_through(std::uint32_t group) const noexcept;

  std::vector<Group> groups_;
  std::vector<InnerSphere> spheres_;
  std::vector<std::uint32_t> group_of_;  // of the spheres
  std::vector<Reference> references_;
  std::uint64_t count_ = 0;
  bool inherits_ = false;
};

}  // namespace sdlc::lang
