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
#include "lang/lower/overrides.hpp"
#include "lang/lower/settings.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A sphere that coincided with an earlier one and was left out. Both are numbers of spheres in the
/// order in which they were added, those of instances not counted.
struct DroppedSphere {
  std::uint32_t sphere;
  std::uint32_t earlier;
  bool is_exact;
  bool has_other_material;
};

/// The hard limit on spheres and instances: they have numbers of 32 bits, and tables of them must
/// not be full.
inline constexpr std::uint64_t kMaxObjects = std::uint64_t{1} << 31;

/// What a scene is made for.
enum class Purpose : std::uint8_t {
  Picture,  ///< of one camera, which must be there
  Check,  ///< of the text: all cameras are checked, and a file without one may be a part of others
};

/// Makes the renderer's scene of checked objects.
class SceneBuilder final : public ObjectSink {
 public:
  /// `file` is the root, and the place of a fault that has no other.
  SceneBuilder(const SourceFile& file, const Limits& limits, DiagnosticSink& sink,
               Purpose purpose = Purpose::Picture, Instancing instancing = Instancing::Auto);

  /// Reserved memory that no sphere is written to costs nothing.
  void expect(std::size_t objects) override {
    world_.spheres.reserve(std::min<std::size_t>(objects, limits_.objects));
  }
  void add(const Object& object) override;
  void enter(const Object& group) override;
  void leave() override;
  bool is_full() const override { return is_full_; }
  /// A check visits every sphere where it is.
  bool wants_contents() const override { return purpose_ == Purpose::Picture; }
  void begin_contents(std::uint32_t contents) override {
    repeats_.begin(contents, groups_.back().placing);
  }
  void forget_contents(std::uint32_t contents) override { repeats_.forget(contents); }
  bool repeat(const Object& group, std::uint32_t contents) override;

  /// The scene: all of it unless an error has been reported, here or before; else what could be
  /// made, with the size 0 where it is not known. Takes what was added.
  LoweredScene finish(const Overrides& overrides);

  /// Spheres added so far, those of instances not counted.
  std::size_t sphere_count() const noexcept { return forgotten_ + world_.spheres.size(); }
  std::size_t held_spheres() const noexcept { return world_.spheres.size(); }
  /// Forgets the spheres but not their number: for those who only count.
  void forget_spheres();

  /// Where spheres of instances come among the others in the order in which all were added.
  const std::vector<GroupRepeats::Run>& instance_runs() const noexcept { return repeats_.runs(); }

  /// What finish() left out, in order.
  const std::vector<DroppedSphere>& dropped() const noexcept { return dropped_; }

 private:
  /// A group around what is added.
  struct Group {
    Placing placing;                ///< in the world
    GroupPath path;                 ///< in the world; filled by checks only
    bool has_bad_material = false;  ///< a wrong one is written, here or further out
  };

  /// Whether the root says nothing about a picture, as files do that are only included in others.
  /// The settings are added before anything else.
  bool is_part() const noexcept {
    return purpose_ == Purpose::Check && cameras_.empty() && !background_ && !has_render_ &&
           !is_animated_;
  }

  // Objects
  /// The group as it is in the group around it.
  Group read_group(const Object& object) const;
  Group in_world(const Group& group) const;
  std::optional<render::Material> material_of(const Object& sphere);
  void add_sphere(const Object& object);
  void add_to_groups(const Object& object, const InnerSphere& sphere, std::uint32_t material);
  void add_motion(const Object& object);

  // Limits
  bool may_hold_another(Location where);
  bool may_take_more_memory(Location where);
  /// Memory of all that was added.
  std::size_t bytes() const noexcept;
  /// How many spheres there may be now.
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
  PlacedSpheres world_;  ///< those of instances excluded
  GroupRepeats repeats_;
  std::vector<MovingSphere> moving_;
  std::vector<Group> groups_;  ///< the innermost last
  std::vector<DroppedSphere> dropped_;
  std::vector<BentPath> bent_paths_;  ///< by the order in which spheres were added
  bool had_spheres_ = false;          ///< also those that were wrong
  bool is_full_ = false;              ///< a limit was exceeded, which was reported
  std::size_t forgotten_ = 0;         ///< spheres
  CountedBytes bytes_;
  MaterialTable materials_;
};

}  // namespace sdlc::lang
