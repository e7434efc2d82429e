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
#include "render/scene/ball.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Whether groups that hold the same are held once, as instances of a prototype, or each with
/// spheres of its own, which are faster to trace.
enum class Instancing : std::uint8_t {
  Auto,    ///< instances where a scene has more spheres than kMostPlainSpheres and they save memory
  Always,  ///< wherever they can be
  Never,
};

/// So many spheres a scene may have before any are made instances: rays take 1.4 to 1.7 times as
/// long with them, and a million fits every machine.
inline constexpr std::size_t kMostPlainSpheres = std::size_t{1} << 20;

/// So many spheres take as much memory as an instance, 264 bytes against 96, and as the node, the
/// leaf and the lists of a prototype beside its spheres, some 2 KB.
inline constexpr std::uint64_t kSpheresPerInstance = 3, kSpheresPerPrototype = 20;

/// Records what groups hold while it is added for the first time, and adds it again from that.
class GroupRepeats {
 public:
  /// The scene that is being made.
  struct World {
    PlacedSpheres& spheres;
    MaterialTable& materials;
    std::uint64_t most_objects;  ///< spheres and instances
  };
  /// Spheres of instances, which stand before the plain sphere of this index in the order in which
  /// all were added.
  struct Run {
    std::size_t before;
    std::uint64_t count;
  };

  explicit GroupRepeats(Instancing instancing) : instancing_(instancing) {}

  // What is added in the usual way, as far as it is to be recorded: groups as they stand in the
  // group around them.
  void enter(const Placing& group);
  void leave();
  /// The group entered just now, which stands so in the world, is the first with the contents of
  /// this number.
  void begin(std::uint32_t contents, const Placing& in_world);
  void add_sphere(const InnerSphere& sphere);
  /// Something was added that cannot be added again from a record.
  void spoil();
  /// Contents of this number will not be repeated.
  void forget(std::uint32_t contents);

  enum class Outcome : std::uint8_t {
    Added,
    Duplicate,  ///< nothing done: an equal one stands in the very place
    Unknown,  ///< nothing done: it was not recorded, or something is wrong with it there, which is
              ///< to be found by adding it in the usual way
  };
  /// Adds to the world a group with contents of this number: `group` as it stands in the group
  /// around it, `in_world` as it stands there.
  Outcome repeat(std::uint32_t contents, const Placing& group, const Placing& in_world,
                 const World& world);

  /// Spheres of prototypes, and instances in spheres' stead.
  std::uint64_t object_count() const noexcept {
    return prototype_spheres_ + kSpheresPerInstance * instances_.size();
  }
  /// What all of it takes, records aside.
  std::size_t bytes() const noexcept {
    return prototype_spheres_ * sizeof(render::Sphere) +
           instances_.size() * sizeof(render::Instance) + places_.size() * kBytesOfPlace +
           runs_.size() * sizeof(Run);
  }
  /// By Run::before.
  const std::vector<Run>& runs() const noexcept { return runs_; }
  /// Hands them over; what was recorded is forgotten.
  std::vector<render::Prototype> take_prototypes();
  std::vector<render::Instance> take_instances() { return std::move(instances_); }

 private:
  /// What is being recorded.
  struct Recording {
    /// A group that is open, and how much came before it.
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
  /// What was repeated with one material for what inherits one.
  struct Use {
    std::uint64_t added = 0;  ///< in spheres: memory that repetitions took without a prototype
    std::optional<std::uint32_t> prototype;
  };
  struct Record {
    GroupContents contents;
    std::size_t bytes = 0;
    bool is_used = false;  ///< repeated, or a part of others
    std::map<std::optional<std::uint32_t>, Use> uses;
  };
  /// A group in its place, told from others by 128 bits.
  using Identity = std::array<std::uint64_t, 2>;
  static constexpr std::size_t kBytesOfPlace = 48;  // in a table
  struct IdentityHash {
    std::size_t operator()(const Identity& identity) const noexcept { return identity[0]; }
  };

  /// Of the scene's spheres and instances.
  std::uint64_t objects_in(const World& world) const noexcept {
    return world.spheres.spheres.size() + object_count();
  }
  Recording* recording() { return recordings_.empty() ? nullptr : &recordings_.back(); }
  void finish_recording();
  /// Counts what is recorded; the recording is given up where there is too much.
  void charge(std::size_t bytes);
  /// Forgets records that nothing has repeated.
  void drop_unused();
  Identity identity_of(std::uint32_t contents, const Record& record, const Placing& in_world) const;
  bool place(Record& record, const Placing& placing, const World& world);
  bool stays_plain(const GroupContents& contents, const Placing& placing, const World& world) const;
  bool wants_prototype(const GroupContents& contents, Use& use, const World& world) const;
  /// Nothing where its numbers are beyond double.
  std::optional<std::uint32_t> make_prototype(const GroupContents& contents,
                                              const std::optional<render::Material>& material,
                                              MaterialTable& materials);
  bool add_instance(const GroupContents& contents, std::uint32_t prototype, const Placing& placing,
                    const World& world);
  /// Counts spheres that are none of the world's own.
  void skip(std::uint64_t spheres, const World& world);
  /// All of it as spheres.
  bool add_spheres(const GroupContents& contents, const Placing& placing, PlacedSpheres& to,
                   MaterialTable& materials) const;

  Instancing instancing_;
  std::vector<Recording> recordings_;  // the innermost last
  std::unordered_map<std::uint32_t, Record> records_;
  std::size_t recorded_bytes_ = 0;  // of records and recordings
  bool is_full_ = false;            // of records that are in use
  std::unordered_set<Identity, IdentityHash> places_;
  std::uint64_t repeated_spheres_ = 0;  // that stand in the world as plain ones
  std::vector<render::Prototype> prototypes_;
  /// Of each prototype, what says whether it is within numbers in some place.
  struct Reach {
    render::Ball ball;
    double smallest_radius;
  };
  std::vector<Reach> reaches_;
  std::uint64_t prototype_spheres_ = 0, prototype_slots_ = 0;
  std::vector<render::Instance> instances_;
  std::vector<Run> runs_;
};

}  // namespace sdlc::lang
