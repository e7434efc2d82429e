#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/checks.hpp"
#include "lang/lower/group_contents.hpp"
#include "lang/lower/group_repeats.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/material_table.hpp"
#include "lang/lower/motion.hpp"
#include "lang/lower/named_spheres.hpp"
#include "lang/lower/overrides.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A sphere that was dropped because it coincided with an earlier one. `sphere` and
/// `earlier` are numbers in the order of addition, in which spheres of instances are not counted.
struct DroppedSphere {
  std::uint32_t sphere;
  std::uint32_t earlier;
  bool is_exact;
  bool has_other_material;
};

/// The hard limit on spheres and instances. Their numbers have 32 bits; half of the range leaves
/// free slots in hash tables of them.
inline constexpr std::uint64_t kMaxObjects = std::uint64_t{1} << 31;

/// The use of the lowered scene.
enum class Purpose : std::uint8_t {
  Picture,  ///< a picture by one camera, which is required
  Check,  ///< diagnostics: all cameras are checked, and a file without one may be a part of others
};

/// Lowers checked objects to the renderer's scene.
class SceneBuilder final : public ObjectSink {
 public:
  /// `file` is the root. Diagnostics that have no place of their own point at it.
  SceneBuilder(const SourceFile& file, const Limits& limits, DiagnosticSink& sink,
               Purpose purpose = Purpose::Picture, Instancing instancing = Instancing::Auto);

  /// Reserves memory for an upper bound: the part that is never used costs nothing.
  void expect(std::size_t objects) override {
    world_.spheres.reserve(std::min<std::size_t>(objects, limits_.objects));
  }
  void add(const Object& object) override;
  void enter(const Object& group) override;
  void leave() override;
  bool is_full() const override { return is_full_; }
  /// Not for checks: they must visit every sphere, so they cannot repeat contents.
  bool wants_contents() const override { return purpose_ == Purpose::Picture; }
  void begin_contents(std::uint32_t contents) override {
    repeats_.begin(contents, groups_.back().placing);
    if (named_.is_used()) named_.begin_contents(contents);
  }
  void forget_contents(std::uint32_t contents) override { repeats_.forget(contents); }
  bool repeat(const Object& group, std::uint32_t contents) override;

  /// Moves all added objects out, as a scene. After an error, in finish() or before, the scene is
  /// incomplete; a picture size of 0 is unknown.
  LoweredScene finish(const Overrides& overrides);

  /// The number of spheres added so far, without those of instances.
  std::size_t sphere_count() const noexcept { return forgotten_ + world_.spheres.size(); }
  std::size_t held_spheres() const noexcept { return world_.spheres.size(); }
  /// Forgets the spheres but keeps their number, for callers that only count.
  void forget_spheres();

  /// The runs of spheres of instances: their positions among the plain spheres, ascending.
  const std::vector<GroupRepeats::Run>& instance_runs() const noexcept { return repeats_.runs(); }

  /// The spheres that finish() dropped, ascending.
  const std::vector<DroppedSphere>& dropped() const noexcept { return dropped_; }

 private:
  /// A group that contains the objects added next.
  struct Group {
    Placing placing;  ///< in the world
    GroupPath path;   ///< in the world; filled by checks only
    /// Whether a material is written here or in an outer group, or may be missing because of a
    /// syntax error. It is bad if `placing` has no material.
    bool has_bad_material = false;
  };

  /// Whether a check's root seems to be a part of other scenes: it has no settings of a picture.
  /// The answer is final once a sphere is added, because settings are added first.
  bool is_part() const noexcept {
    return purpose_ == Purpose::Check && cameras_.empty() && !background_ && !has_render_ &&
           !is_animated_;
  }

  // Objects
  /// The group of an object. Unlike those in groups_, it is relative to the group around it.
  Group read_group(const Object& object) const;
  Group in_world(const Group& group) const;
  std::optional<render::Material> material_of(const Object& sphere);
  void add_sphere(const Object& object);
  void add_to_groups(const Object& object, const InnerSphere& sphere, std::uint32_t material);
  void add_motion(const Object& object);

  // Limits
  bool may_hold_another(Location where);
  bool may_take_more_memory(Location where);
  /// Memory of all added objects, in bytes.
  std::size_t bytes() const noexcept;
  /// The max number of spheres and instances, by the limit on objects and by the free memory.
  std::uint64_t max_objects() const noexcept;

  // The scene
  void check_for_picture(const Overrides& overrides) const;
  void lower_chosen_camera(const Object& camera, LoweredScene& lowered);
  void move_spheres(const Object& camera, render::Scene& scene);
  void drop_coincident(LoweredScene& lowered);

  const SourceFile* file_;
  Limits limits_;
  DiagnosticSink* sink_;
  Purpose purpose_;
  std::vector<Object> cameras_;
  std::optional<Object> background_;
  Object render_;  ///< empty if there is none
  bool has_render_ = false;
  bool is_animated_ = false;
  PlacedSpheres world_;  ///< without the spheres of instances
  GroupRepeats repeats_;
  std::vector<MovingSphere> moving_;
  std::vector<Group> groups_;  ///< the innermost last
  std::vector<DroppedSphere> dropped_;
  std::vector<BentPath> bent_paths_;  ///< in the order in which spheres were added
  bool had_spheres_ = false;          ///< including invalid ones
  bool is_full_ = false;              ///< a limit was exceeded, which was reported
  std::size_t forgotten_ = 0;         ///< number of forgotten spheres
  std::size_t skipped_ = 0;           ///< number of spheres with errors, and those of a part that
                                      ///< get their material where it is included
  CountedBytes bytes_;
  MaterialTable materials_;
  NamedSpheres named_;
};

}  // namespace sdlc::lang
