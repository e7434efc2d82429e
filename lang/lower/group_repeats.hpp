#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "lang/lower/group_contents.hpp"
#include "lang/lower/material_table.hpp"
#include "render/scene/bounding_sphere.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Whether groups with equal contents share a prototype, or each has spheres of its own, which are
/// faster to trace.
enum class Instancing : std::uint8_t {
  Auto,    ///< in scenes of more than kMaxPlainSpheres spheres, where instances save memory
  Always,  ///< wherever possible
  Never,
};

/// Smaller scenes have no instances: rays take 1.4 to 1.7 times as long with them, and a million
/// spheres fit every machine.
inline constexpr std::size_t kMaxPlainSpheres = std::size_t{1} << 20;

/// Memory of an instance (264 bytes), and of a prototype without its spheres (a node, a leaf and
/// lists, about 2 KB), in spheres of 96 bytes.
inline constexpr std::uint64_t kSpheresPerInstance = 3, kSpheresPerPrototype = 20;

/// Records the contents of groups when they are added for the first time, and repeats them later.
class GroupRepeats {
 public:
  /// The scene under construction.
  struct World {
    PlacedSpheres& spheres;
    MaterialTable& materials;
    std::uint64_t max_objects;  ///< spheres and instances
  };
  /// Consecutive spheres of instances, which were added before the plain sphere with the index
  /// `before`.
  struct Run {
    std::size_t before;
    std::uint64_t count;
  };

  explicit GroupRepeats(Instancing instancing) : instancing_(instancing) {}

  // These record what is added without repetition. A group's placing is relative to the group
  // around it.
  void enter(const Placing& group);
  void leave();
  /// The group that was just entered, with this placing in the world, is the first with these
  /// contents.
  void begin(std::uint32_t contents, const Placing& in_world);
  void add_sphere(const InnerSphere& sphere);
  /// Something was added that cannot be recorded.
  void spoil();
  /// These contents will not be repeated.
  void forget(std::uint32_t contents);

  enum class Outcome : std::uint8_t {
    Added,
    Duplicate,  ///< not added: an equal group is in the same place
    Unknown,    ///< not added: it was not recorded, or is invalid there; adding it without
                ///< repetition reports the reason
  };
  /// Adds a group with these contents to the world. `group` is its placing in the group around it.
  Outcome repeat(std::uint32_t contents, const Placing& group, const Placing& in_world,
                 const World& world);

  /// The number of spheres of prototypes, plus kSpheresPerInstance for each instance.
  std::uint64_t object_count() const noexcept {
    return prototype_spheres_ + kSpheresPerInstance * instances_.size();
  }
  /// Memory in bytes, without the records.
  std::size_t bytes() const noexcept {
    return prototype_spheres_ * sizeof(render::Sphere) +
           instances_.size() * sizeof(render::Instance) + places_.size() * kBytesPerPlace +
           runs_.size() * sizeof(Run);
  }
  /// By Run::before.
  const std::vector<Run>& runs() const noexcept { return runs_; }
  /// Moves the prototypes out and forgets all records.
  std::vector<render::Prototype> take_prototypes();
  std::vector<render::Instance> take_instances() { return std::move(instances_); }

 private:
  /// A recording in progress.
  struct Recording {
    /// A group that was entered and not left, and the number of parts before it.
    struct Open {
      std::uint32_t group = 0;
      std::size_t parts = 0;
    };

    std::uint32_t number;
    Placing in_world;
    GroupContents contents;
    std::vector<Open> groups;  ///< the innermost last; the first is the group itself
    std::size_t bytes = 0;
    bool is_spoilt = false;
  };
  /// The repetitions with one inherited material.
  struct Use {
    std::uint64_t added = 0;  ///< memory of repetitions without a prototype, in spheres
    std::optional<std::uint32_t> prototype;
  };
  struct Record {
    GroupContents contents;
    std::size_t bytes = 0;
    bool is_used = false;  ///< repeated, or referred to by other contents
    std::map<std::optional<std::uint32_t>, Use> uses;
  };
  /// A 128-bit hash of a group and its placing.
  using Identity = std::array<std::uint64_t, 2>;
  static constexpr std::size_t kBytesPerPlace = 48;  // in the hash table
  struct IdentityHash {
    std::size_t operator()(const Identity& identity) const noexcept { return identity[0]; }
  };

  /// The number of the scene's spheres and instances.
  std::uint64_t objects_in(const World& world) const noexcept {
    return world.spheres.spheres.size() + object_count();
  }
  Recording* recording() { return recordings_.empty() ? nullptr : &recordings_.back(); }
  /// The innermost recording; null if there is none, or if it is spoilt.
  Recording* valid_recording() {
    Recording* const current = recording();
    return current != nullptr && !current->is_spoilt ? current : nullptr;
  }
  void finish_recording();
  /// Counts recorded bytes; cancels the recording if there are too many.
  void charge(std::size_t bytes);
  /// Forgets records that are not in use.
  void drop_unused();
  Identity identity_of(std::uint32_t contents, const Record& record, const Placing& in_world) const;
  bool place(Record& record, const Placing& placing, const World& world);
  bool stays_plain(const GroupContents& contents, const Placing& placing, const World& world) const;
  bool wants_prototype(const GroupContents& contents, Use& use, const World& world) const;
  /// nullopt if a number would be beyond the range of double.
  std::optional<std::uint32_t> make_prototype(const GroupContents& contents,
                                              const std::optional<render::Material>& material,
                                              MaterialTable& materials);
  bool add_instance(const GroupContents& contents, std::uint32_t prototype, const Placing& placing,
                    const World& world);
  /// Counts spheres of instances, which are not in the world.
  void skip(std::uint64_t spheres, const World& world);
  /// Adds all contents as spheres.
  bool add_spheres(const GroupContents& contents, const Placing& placing, PlacedSpheres& to,
                   MaterialTable& materials) const;

  Instancing instancing_;
  std::vector<Recording> recordings_;  // the innermost last
  std::unordered_map<std::uint32_t, Record> records_;
  std::size_t recorded_bytes_ = 0;  // of records and recordings
  bool is_full_ = false;            // records in use take too much memory
  std::unordered_set<Identity, IdentityHash> places_;
  std::uint64_t repeated_spheres_ = 0;  // plain ones in the world
  std::vector<render::Prototype> prototypes_;
  /// Determines whether the numbers of a placed prototype are in the range of double.
  struct Reach {
    render::BoundingSphere bounding_sphere;
    double smallest_radius;
  };
  std::vector<Reach> reaches_;
  std::uint64_t prototype_spheres_ = 0, prototype_slots_ = 0;
  std::vector<render::Instance> instances_;
  std::vector<Run> runs_;
};

}  // namespace sdlc::lang
