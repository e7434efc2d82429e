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

/// The number of spheres up to which none are made instances: rays take 1.4 to 1.7 times as long
/// with instances, and a million spheres fit every machine.
inline constexpr std::size_t kMaxPlainSpheres = std::size_t{1} << 20;

/// Memory of an instance (264 bytes) and of a prototype beside its spheres (a node, a leaf and
/// lists, some 2 KB) in spheres of 96 bytes.
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
  /// Spheres of instances: in the order in which all were added, they come before the plain sphere
  /// of index `before`.
  struct Run {
    std::size_t before;
    std::uint64_t count;
  };

  explicit GroupRepeats(Instancing instancing) : instancing_(instancing) {}

  // Called for what is added in the usual way, to record it. A group's placing is relative to the
  // group around it.
  void enter(const Placing& group);
  void leave();
  /// The group entered just now, which has this placing in the world, is the first with these
  /// contents.
  void begin(std::uint32_t contents, const Placing& in_world);
  void add_sphere(const InnerSphere& sphere);
  /// Something was added that cannot be repeated from a record.
  void spoil();
  /// These contents will not be repeated.
  void forget(std::uint32_t contents);

  enum class Outcome : std::uint8_t {
    Added,
    Duplicate,  ///< nothing done: an equal group is in the same place
    Unknown,    ///< nothing done: it was not recorded, or something is wrong with it there; adding
                ///< it in the usual way will report that
  };
  /// Adds a group with these contents to the world. `group` is its placing in the group around it.
  Outcome repeat(std::uint32_t contents, const Placing& group, const Placing& in_world,
                 const World& world);

  /// Spheres of prototypes, plus instances counted as spheres by the memory they take.
  std::uint64_t object_count() const noexcept {
    return prototype_spheres_ + kSpheresPerInstance * instances_.size();
  }
  /// Memory of all of it, records aside.
  std::size_t bytes() const noexcept {
    return prototype_spheres_ * sizeof(render::Sphere) +
           instances_.size() * sizeof(render::Instance) + places_.size() * kBytesOfPlace +
           runs_.size() * sizeof(Run);
  }
  /// By Run::before.
  const std::vector<Run>& runs() const noexcept { return runs_; }
  /// Hands them over and forgets all records.
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
    bool is_used = false;  ///< repeated, or a part of other contents
    std::map<std::optional<std::uint32_t>, Use> uses;
  };
  /// A hash of 128 bits of a group in its place.
  using Identity = std::array<std::uint64_t, 2>;
  static constexpr std::size_t kBytesOfPlace = 48;  // in a table
  struct IdentityHash {
    std::size_t operator()(const Identity& identity) const noexcept { return identity[0]; }
  };

  /// The number of the scene's spheres and instances.
  std::uint64_t objects_in(const World& world) const noexcept {
    return world.spheres.spheres.size() + object_count();
  }
  Recording* recording() { return recordings_.empty() ? nullptr : &recordings_.back(); }
  void finish_recording();
  /// Counts recorded bytes; gives the recording up if there are too many.
  void charge(std::size_t bytes);
  /// Forgets records that nothing has repeated.
  void drop_unused();
  Identity identity_of(std::uint32_t contents, const Record& record, const Placing& in_world) const;
  bool place(Record& record, const Placing& placing, const World& world);
  bool stays_plain(const GroupContents& contents, const Placing& placing, const World& world) const;
  bool wants_prototype(const GroupContents& contents, Use& use, const World& world) const;
  /// nullopt if its numbers are beyond double.
  std::optional<std::uint32_t> make_prototype(const GroupContents& contents,
                                              const std::optional<render::Material>& material,
                                              MaterialTable& materials);
  bool add_instance(const GroupContents& contents, std::uint32_t prototype, const Placing& placing,
                    const World& world);
  /// Counts spheres of instances, which the world does not hold.
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
  /// What decides whether the numbers of a placed prototype are within double.
  struct Reach {
    render::BoundingSphere ball;  ///< bounding sphere
    double smallest_radius;
  };
  std::vector<Reach> reaches_;
  std::uint64_t prototype_spheres_ = 0, prototype_slots_ = 0;
  std::vector<render::Instance> instances_;
  std::vector<Run> runs_;
};

}  // namespace sdlc::lang
