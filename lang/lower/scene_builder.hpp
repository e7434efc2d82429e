#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/group_contents.hpp"
#include "lang/lower/group_repeats.hpp"
#include "lang/lower/material_table.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "render/image/tone.hpp"
#include "render/math/interval.hpp"
#include "render/math/vec3.hpp"
#include "render/scene/precision.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// What the command line puts in place of what the file says. Numbers are in the range of their
/// property.
struct Overrides {
  std::optional<int> width = {}, height = {}, samples = {}, depth = {}, threads = {};
  std::optional<std::uint64_t> seed = {};
  std::optional<std::string> tone = {}, camera = {}, precision = {};
  std::optional<std::string> sampler = {}, light_sampling = {};
  /// As in render::RenderSettings: either takes the place of the scene's `error` and `samples`.
  std::optional<double> error = {}, seconds = {};
  bool is_adaptive = false;
  bool names_output = false;  ///< the scene's own output is not used
  Instancing instancing = Instancing::Auto;
};

/// How the picture is saved, as far as the scene says so.
struct OutputSettings {
  std::string output;  ///< as written; empty where the scene names none
  render::Tone tone = render::Tone::Srgb;
};

/// What is written of a camera and cannot be read off render::Camera.
struct WrittenCamera {
  std::string name;  ///< empty where it has none
  Angle fov;
  double view_height = 2;
  std::optional<render::Interval> shutter;  ///< absolute times in seconds; nothing: none
};

/// A camera as a check finds it: all are looked at, not only the chosen one.
struct CheckedCamera {
  std::string name;  ///< empty where it has none
  render::Camera camera;
  std::optional<render::Interval> shutter;
  Location from;    ///< where it stands, in the text
  Location aspect;  ///< no file: not written
};

/// Where the text says something; no file: it does not.
struct WrittenPlaces {
  Location background, width, height, samples, depth, precision, error, output;
};

/// A sphere that groups turn while the shutter is open, whose centre nevertheless goes straight.
struct BentPath {
  std::uint32_t sphere;  ///< index in the scene
  double sagitta;        ///< how far the middle of the way is from where it would be
};

/// A scene ready for the renderer. A plain picture is a scene without spheres.
struct LoweredScene {
  render::Scene scene;
  render::RenderSettings settings;
  OutputSettings output;
  std::vector<std::string> cameras;     ///< the names of all, as they are declared
  std::optional<WrittenCamera> camera;  ///< the chosen one; nothing: a plain picture
  std::size_t dropped_spheres = 0;      ///< that coincided with earlier ones
  /// That is asked for; nothing: whatever suits the scene.
  std::optional<render::Precision> precision;
  WrittenPlaces places;

  // Of a check.
  std::vector<CheckedCamera> checked_cameras;  ///< that have no mistake; empty: a part of others
  std::vector<BentPath> bent_paths;            ///< by index
};

/// A sphere that was found to coincide with an earlier one and left out. Both are numbers of
/// spheres in the order in which they were added, those of instances not counted.
struct DroppedSphere {
  std::uint32_t sphere;
  std::uint32_t earlier;
  bool is_exact;
  bool has_other_material;
};

/// Spheres and instances that a scene may have whatever the limits are: they have numbers of 32
/// bits, and their tables some that are empty.
inline constexpr std::uint64_t kMostObjects = std::uint64_t{1} << 31;

/// What a scene is made for.
enum class Purpose : std::uint8_t {
  Picture,  ///< of one camera, which must be there
  Check,    ///< of the text: all cameras are looked at, and a file without any may be a part of
            ///< others
};

/// Makes the renderer's scene of checked objects.
class SceneBuilder final : public ObjectSink {
 public:
  /// `file` is the root, and the place of a fault that has no other.
  SceneBuilder(const SourceFile& file, const Limits& limits, DiagnosticSink& sink,
               Purpose purpose = Purpose::Picture, Instancing instancing = Instancing::Auto)
      : file_(&file), limits_(limits), sink_(&sink), purpose_(purpose), repeats_(instancing) {
    limits_.objects = std::min(limits_.objects, kMostObjects);
  }

  /// Memory that no sphere is written to costs nothing.
  void expect(std::size_t objects) override {
    world_.spheres.reserve(std::min<std::size_t>(objects, limits_.objects));
  }
  void add(const Object& object) override;
  void enter(const Object& group) override;
  void leave() override;
  bool is_full() const override { return is_full_; }
  /// A check looks at every sphere where it stands.
  bool wants_contents() const override { return purpose_ == Purpose::Picture; }
  void begin_contents(std::uint32_t contents) override {
    repeats_.begin(contents, groups_.back().placing);
  }
  void forget_contents(std::uint32_t contents) override { repeats_.forget(contents); }
  bool repeat(const Object& group, std::uint32_t contents) override;

  /// The scene: all of it unless an error has been reported, here or before; else what could be
  /// made, where a picture without width and height is one whose size is not known. Takes what was
  /// added.
  LoweredScene finish(const Overrides& overrides);

  /// Of spheres that are added so far, those of instances not counted.
  std::size_t sphere_count() const noexcept { return forgotten_ + world_.spheres.size(); }
  std::size_t held_spheres() const noexcept { return world_.spheres.size(); }
  /// Forgets all spheres but how many they are: for those who only count.
  void forget_spheres();

  /// Where spheres of instances stand among the others in the order in which all were added.
  const std::vector<GroupRepeats::Run>& instance_runs() const noexcept { return repeats_.runs(); }

  /// What finish() left out, in order.
  const std::vector<DroppedSphere>& dropped() const noexcept { return dropped_; }

 private:
  /// A sphere with a `motion`, whose path waits for the shutter.
  struct MovingSphere {
    std::uint32_t sphere;
    Location where;  ///< of the motion in the text
    MotionValue motion;
    render::Vec3 center;  ///< at motion.over.from, inside the group
    std::optional<std::array<render::Placement, 2>> group;
  };

  /// A group around what is added.
  struct Group {
    Placing placing;                ///< in the world
    render::Placement middle;       ///< half-way between the opening and the closing; of a check
    bool is_turning = false;        ///< while the shutter is open; of a check
    bool has_bad_material = false;  ///< one is written that was wrong, here or further out
  };

  /// Whether the root says nothing of a picture, as files do that are only placed in others. The
  /// settings are added before anything else.
  bool is_part() const noexcept {
    return purpose_ == Purpose::Check && cameras_.empty() && !background_ && !render_ &&
           !is_animated_;
  }

  /// As it stands in the group around it.
  Group read_group(const Object& object) const;
  Group in_world(const Group& group) const;
  void add_sphere(const Object& object);
  bool may_hold_another(Location where);
  bool may_take_more_memory(Location where);
  /// Of all that was added.
  std::size_t bytes() const noexcept;
  /// Spheres that there may be now.
  std::uint64_t most_objects() const noexcept;
  const Object* choose_camera(const Overrides& overrides);
  void check_for_picture(const Overrides& overrides);
  void lower_camera(const Object& camera, LoweredScene& lowered);
  /// Whether a check finds a camera with a shutter, chosen or not.
  bool has_open_shutter() const;
  void check_cameras(LoweredScene& lowered);
  void find_places(LoweredScene& lowered) const;
  void lower_background(render::Scene& scene);
  void lower_motion(render::Interval shutter, render::Scene& scene);
  void lower_settings(const Overrides& overrides, LoweredScene& lowered);
  /// Error and time to reach, and the samples that may be taken for them.
  /// The name of the scene's own picture.
  void check_output(const LoweredScene& lowered);
  void lower_goals(const Overrides& overrides, LoweredScene& lowered);
  void diagnose_few_samples(const LoweredScene& lowered, bool is_by_flag);
  /// Width, height and the aspect of the view plane, which the camera's aspect and both formats'
  /// sizes decide.
  void lower_size(const Object* camera, const Overrides& overrides, LoweredScene& lowered);
  void find_bent_path(std::uint32_t sphere, render::Vec3 opening, render::Vec3 closing);
  void drop_coincident(LoweredScene& lowered);

  Location whole_file() const { return {file_, {0, 0}}; }
  std::string_view name_of(const Object& object, std::size_t property) const;
  /// The value of a whole-number property, checked to fit an int; nothing where it is absent or
  /// wrong.
  std::optional<int> whole(const Object& object, std::size_t property) const;

  const SourceFile* file_;
  Limits limits_;
  DiagnosticSink* sink_;
  Purpose purpose_;
  std::vector<Object> cameras_;
  std::optional<Object> background_;
  std::optional<Object> render_;
  bool is_animated_ = false;
  PlacedSpheres world_;  ///< but for those of instances
  GroupRepeats repeats_;
  std::vector<MovingSphere> moving_;
  std::vector<Group> groups_;  ///< the innermost last
  std::vector<DroppedSphere> dropped_;
  std::vector<BentPath> bent_paths_;  ///< by the order in which spheres were added
  bool had_spheres_ = false;          ///< also those that were wrong
  bool is_full_ = false;              ///< there were more than may be
  std::size_t forgotten_ = 0;         ///< spheres
  CountedBytes bytes_;
  MaterialTable materials_;
};

}  // namespace sdlc::lang
