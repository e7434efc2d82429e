#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/lower/group_contents.hpp"
#include "lang/lower/material_table.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// Whether groups that hold the same are held once, as instances of a prototype, or each with
/// spheres of its own, which are faster to trace.
enum class Instancing : std::uint8_t {
  Auto,    ///< instances where a scene has more spheres than kMostPlainSpheres and they save memory
  Always,  ///< wherever they can be
  Never,
};

/// So many spheres a scene may have before any are made instances: with 10^6 of them a ray takes
/// half as long as through instances, and they fit every machine.
inline constexpr std::size_t kMostPlainSpheres = std::size_t{1} << 20;

/// So many spheres take as much memory as an instance: 264 bytes, against 96 of a sphere.
inline constexpr std::uint64_t kSpheresPerInstance = 3;

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
  /// The group entered just now is the first with the contents of this number.
  void begin(std::uint32_t contents);
  void add_sphere(const InnerSphere& sphere);
  /// Something was added that cannot be added again from a record.
  void spoil();

  /// Adds to the world a group with contents of this number: `group` as it stands in the group
  /// around it, `in_world` as it stands there. False, with nothing done, where they were not
  /// recorded, or what is wrong with them there is to be found by adding them in the usual way.
  bool repeat(std::uint32_t contents, const Placing& group, const Placing& in_world,
              const World& world);

  /// Instances, and spheres of prototypes.
  std::uint64_t object_count() const noexcept { return prototype_spheres_ + instances_.size(); }
  /// By Run::before.
  const std::vector<Run>& runs() const noexcept { return runs_; }
  /// Hands them over; what was recorded is forgotten.
  std::vector<render::Prototype> take_prototypes();
  std::vector<render::Instance> take_instances() { return std::move(instances_); }

 private:
  /// What is being recorded.
  struct Recording {
    std::uint32_t number;
    GroupContents contents;
    std::vector<std::uint32_t> groups;  ///< that are open, the innermost last; the first is 0
    bool is_spoilt = false;
  };
  struct Record {
    GroupContents contents;
    std::uint64_t added = 0;  ///< in spheres: memory that its repetitions took without a prototype
    /// Index of the prototype with this material for what inherits one.
    std::map<std::optional<std::uint32_t>, std::uint32_t> prototypes;
  };

  /// Of the scene's spheres and instances.
  std::uint64_t objects_in(const World& world) const noexcept {
    return world.spheres.spheres.size() + object_count();
  }
  Recording* recording() { return recordings_.empty() ? nullptr : &recordings_.back(); }
  void finish_recording();
  bool place(Record& record, const Placing& placing, const World& world);
  bool stays_plain(const GroupContents& contents, const Placing& placing, const World& world) const;
  bool wants_prototype(Record& record, const World& world) const;
  /// Nothing where its numbers are beyond double.
  std::optional<std::uint32_t> prototype_of(Record& record,
                                            const std::optional<render::Material>& material,
                                            MaterialTable& materials);
  bool add_instance(const GroupContents& contents, std::uint32_t prototype, const Placing& placing,
                    const World& world);
  /// All of it as spheres.
  bool add_spheres(const GroupContents& contents, const Placing& placing, PlacedSpheres& to,
                   MaterialTable& materials) const;

  Instancing instancing_;
  std::vector<Recording> recordings_;  // the innermost last
  std::unordered_map<std::uint32_t, Record> records_;
  std::size_t recorded_bytes_ = 0;
  std::vector<render::Prototype> prototypes_;
  /// Of each prototype, what says whether it is within numbers in some place.
  struct Reach {
    render::Ball ball;
    double smallest_radius;
  };
  std::vector<Reach> reaches_;
  std::uint64_t prototype_spheres_ = 0;
  std::vector<render::Instance> instances_;
  std::vector<Run> runs_;
};

}  // namespace sdlc::lang
