#include "lang/lower/scene_builder.hpp"

#include <utility>

#include "lang/lower/background.hpp"
#include "lang/lower/camera.hpp"
#include "lang/lower/placement.hpp"
#include "lang/schema/schema.hpp"
#include "render/exactness/coincident.hpp"

namespace sdlc::lang {
namespace {

// Includes the search for coincident spheres, and the SphereTree of the lints.
constexpr std::size_t kBytesPerCheckedSphere = 96;
constexpr std::size_t kBytesPerSphere = 64, kBytesPerCamera = 2 * sizeof(Object);

Object moved_to(const CameraPose& pose, Object camera) {
  camera.slots[camera_property::kFrom].value = Triple{pose.from, Unit::Length};
  camera.slots[camera_property::kAt].value = Triple{pose.at, Unit::Length};
  return camera;
}

}  // namespace

SceneBuilder::SceneBuilder(const SourceFile& file, const Limits& limits, DiagnosticSink& sink,
                           Purpose purpose, Instancing instancing)
    : file_(&file), limits_(limits), sink_(&sink), purpose_(purpose), repeats_(instancing) {
  limits_.objects = std::min(limits_.objects, kMaxObjects);
  render_.kind = &kind_info(ObjectKind::Render);
  render_.where = {&file, {0, 0}};
}

void SceneBuilder::add(const Object& object) {
  switch (object.kind->id) {
    case ObjectKind::Camera:
      if (may_take_more_memory(object.where)) cameras_.push_back(object);
      named_.want(object);
      break;
    case ObjectKind::Background:
      if (!background_) background_ = object;  // a second one has been reported
      break;
    case ObjectKind::Sphere: add_sphere(object); break;
    case ObjectKind::Render:
      if (!std::exchange(has_render_, true)) render_ = object;
      break;
    case ObjectKind::Animation: is_animated_ = true; break;
    case ObjectKind::Group: break;  // see enter()
  }
}

// Groups

SceneBuilder::Group SceneBuilder::read_group(const Object& object) const {
  using namespace group_property;
  const double scale = object.get<double>(kScale).value_or(1);
  const auto translate = object.get<render::Vec3>(kTranslate).value_or(render::Vec3{});
  const auto rotate = object.get<AngleTriple>(kRotate).value_or(AngleTriple{});
  const render::Placement opening = placement_of(translate, rotate.degrees, scale);
  Group group{.placing = {.placements = {opening, opening}, .material = {}},
              .path = {.halfway = opening},
              .has_bad_material = object.slot(kMaterial).is_written || object.is_broken};
  if (!object.closing.empty()) {
    const auto translate_to = object.get_closing<render::Vec3>(kTranslate).value_or(translate);
    const auto rotate_to = object.get_closing<AngleTriple>(kRotate).value_or(rotate);
    group.placing.is_moving = true;
    group.placing.placements[1] = placement_of(translate_to, rotate_to.degrees, scale);
    if (purpose_ == Purpose::Check) {
      group.path = {.halfway = placement_of((translate + translate_to) * 0.5,
                                            (rotate.degrees + rotate_to.degrees) * 0.5, scale),
                    .is_turning = rotate != rotate_to};
    }
  }
  if (const auto material = object.get<MaterialValue>(kMaterial)) {
    group.placing.material = lower_material(*material);
  }
  return group;
}

SceneBuilder::Group SceneBuilder::in_world(const Group& group) const {
  if (groups_.empty()) return group;
  const Group& outer = groups_.back();
  return {.placing = outer.placing.around(group.placing),
          .path = outer.path.around(group.path),
          .has_bad_material = group.has_bad_material || outer.has_bad_material};
}

void SceneBuilder::enter(const Object& object) {
  const Group group = read_group(object);
  repeats_.enter(group.placing);
  if (named_.is_used()) named_.enter();
  groups_.push_back(in_world(group));
}

void SceneBuilder::leave() {
  repeats_.leave();
  if (named_.is_used()) named_.leave();
  groups_.pop_back();
}

bool SceneBuilder::repeat(const Object& object, std::uint32_t contents) {
  const Group group = read_group(object);
  const auto outcome =
      repeats_.repeat(contents, group.placing, in_world(group).placing,
                      {.spheres = world_, .materials = materials_, .max_objects = max_objects()});
  bytes_.set(bytes());
  if (outcome == GroupRepeats::Outcome::Duplicate) {
    sink_->report(diag::duplicate_sphere, object.where, "group is the same as an earlier one");
  }
  if (outcome == GroupRepeats::Outcome::Added) named_.repeat(object, contents);
  return outcome != GroupRepeats::Outcome::Unknown;
}

// Limits

std::size_t SceneBuilder::bytes() const noexcept {
  const bool is_checked = purpose_ == Purpose::Check;
  return world_.spheres.size() * (is_checked ? kBytesPerCheckedSphere : kBytesPerSphere) +
         world_.shifts.size() * sizeof(render::Vec3) + moving_.size() * sizeof(MovingSphere) +
         bent_paths_.size() * sizeof(BentPath) + cameras_.size() * kBytesPerCamera +
         materials_.bytes() + repeats_.bytes();
}

bool SceneBuilder::may_take_more_memory(Location where) {
  sink_->stop_if_requested();
  bytes_.set(bytes());
  if (CountedBytes::sum() <= limits_.memory) return true;
  if (std::exchange(is_full_, true)) return false;
  sink_->report(diag::too_much_memory, where, limits_.memory)
      .help("`--limit memory=N` allows more");
  return false;
}

std::uint64_t SceneBuilder::max_objects() const noexcept {
  const std::uint64_t free =
      limits_.memory - std::min<std::uint64_t>(limits_.memory, CountedBytes::sum());
  return std::min<std::uint64_t>(
      limits_.objects, world_.spheres.size() + repeats_.object_count() + free / kBytesPerSphere);
}

void SceneBuilder::forget_spheres() {
  forgotten_ += world_.spheres.size();
  world_ = {};
  moving_.clear();
  bent_paths_.clear();
}

bool SceneBuilder::may_hold_another(Location where) {
  constexpr std::size_t kInterval = 256;  // count memory once per this many spheres
  const bool is_due = is_full_ || world_.spheres.size() % kInterval == 0;
  if (is_due && !may_take_more_memory(where)) return false;
  if (sphere_count() + skipped_ + repeats_.object_count() < limits_.objects) return true;
  if (std::exchange(is_full_, true)) return false;  // reported once
  sink_->report(diag::too_many_objects, where, limits_.objects)
      .help("`--limit objects=N` allows more");
  return false;
}

// Spheres

std::optional<render::Material> SceneBuilder::material_of(const Object& sphere) {
  using sphere_property::kMaterial;
  if (const auto own = sphere.get<MaterialValue>(kMaterial)) return lower_material(*own);
  if (sphere.slot(kMaterial).is_written) return std::nullopt;  // invalid, and reported
  if (!groups_.empty() && groups_.back().placing.material) return groups_.back().placing.material;
  const bool is_reported =
      sphere.is_broken || (!groups_.empty() && groups_.back().has_bad_material);
  if (!is_reported && !is_part()) {
    sink_->report(diag::no_material, sphere.where)
        .help(
            "set it on the sphere or on a group around it, such as "
            "`material: diffuse(color: white)`");
  }
  return std::nullopt;
}

void SceneBuilder::add_sphere(const Object& object) {
  using namespace sphere_property;
  had_spheres_ = true;
  if (named_.is_used()) {
    named_.add(object,
               groups_.empty() ? render::Placement() : groups_.back().placing.placements[0]);
  }
  const auto center = object.get<render::Vec3>(kCenter);
  const auto radius = object.get<double>(kRadius);
  const auto material = material_of(object);
  if (!center || !radius || !material) {  // reported where it was read
    ++skipped_;
    static_cast<void>(may_hold_another(object.where));
    return;
  }
  if (*radius == 0) {
    sink_->report(diag::zero_radius, object.location(kRadius));
    return;
  }
  if (!has_finite_light(*material)) {
    sink_->report(diag::beyond_numbers, object.location(kMaterial),
                  "the light's color * intensity");
    return;
  }
  if (!may_hold_another(object.where)) return;

  if (object.slot(kMotion).is_written) add_motion(object);
  const std::uint32_t row = materials_.index_of(*material);
  if (groups_.empty() && object.closing.empty()) {
    world_.add({.center = *center, .radius = *radius, .material = row}, {});
    return;
  }
  InnerSphere sphere{.center = *center,
                     .closing = *object.get_closing<render::Vec3>(kCenter),
                     .radius = *radius,
                     .material = {},
                     .is_moving = !object.closing.empty()};
  if (object.slot(kMaterial).is_written) sphere.material = row;
  add_to_groups(object, sphere, row);
}

void SceneBuilder::add_to_groups(const Object& object, const InnerSphere& sphere,
                                 std::uint32_t material) {
  const Placing placing = groups_.empty() ? Placing() : groups_.back().placing;
  const bool is_turning = !groups_.empty() && groups_.back().path.is_turning;
  if (is_turning && !object.slot(sphere_property::kMotion).is_written) {
    bent_paths_.push_back(
        {.sphere = static_cast<std::uint32_t>(world_.spheres.size()),
         .sagitta = sagitta_of(placing, groups_.back().path, sphere.center, sphere.closing)});
  }
  if (sphere.add_to(world_, placing, material)) {
    repeats_.add_sphere(sphere);
  } else {
    sink_->report(diag::beyond_numbers, object.where,
                  "the position or size of this sphere in its groups");
  }
}

void SceneBuilder::add_motion(const Object& object) {
  using namespace sphere_property;
  const auto motion = object.get<MotionValue>(kMotion);
  if (!motion) return;  // invalid, and reported
  moving_.push_back({.sphere = static_cast<std::uint32_t>(world_.spheres.size()),
                     .where = object.location(kMotion),
                     .motion = *motion,
                     .center = *object.get<render::Vec3>(kCenter),
                     .groups = {}});
  if (!groups_.empty()) moving_.back().groups = groups_.back().placing.placements;
  repeats_.spoil();
}

// The scene

LoweredScene SceneBuilder::finish(const Overrides& overrides) {
  named_.finish(!sink_->has_errors());
  const WantedSettings wanted{
      .file = *file_, .render = render_, .overrides = overrides, .sink = *sink_};
  LoweredScene lowered;
  lowered.scene.spheres = std::move(world_.spheres);
  lowered.scene.prototypes = repeats_.take_prototypes();
  lowered.scene.instances = repeats_.take_instances();
  lowered.scene.materials = materials_.take();
  if (background_) lower_background(*background_, *sink_, lowered.scene.background);

  const Object* camera = choose_camera(wanted, cameras_, purpose_ == Purpose::Check);
  // After an error the camera may be missing for another reason.
  if (camera == nullptr && !sink_->has_errors() && !is_part()) check_for_picture(overrides);
  for (const Object& declared : cameras_) lowered.cameras.push_back(declared.name);
  if (purpose_ == Purpose::Check) {
    lowered.checked_cameras = check_cameras(cameras_, file_->format(), named_, *sink_);
  }
  lowered.places = find_places(wanted, background_ ? &*background_ : nullptr);
  if (camera != nullptr) {
    lower_chosen_camera(overrides.pose ? moved_to(*overrides.pose, *camera) : *camera, lowered);
  }
  lower_settings(wanted, cameras_.empty(), lowered);
  lower_size(wanted, camera, lowered);
  if (!overrides.names_output) check_output(wanted, is_animated_, lowered);
  sink_->stop_if_requested();
  drop_coincident(lowered);
  lowered.dropped_spheres = dropped_.size();
  bytes_.set(0);  // the caller owns the scene now
  return lowered;
}

void SceneBuilder::check_for_picture(const Overrides& overrides) const {
  using namespace render_property;
  const Location whole_file{file_, {0, 0}};
  if (had_spheres_) {
    sink_->report(diag::no_camera, whole_file)
        .help("add `camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }`");
    return;
  }
  const auto is_given = [&](std::size_t property) {
    return overrides.has(property) || render_.slot(property).is_written;
  };
  const bool has_color = background_ && background_->slot(background_property::kColor).is_written;
  if (!is_given(kWidth) || !is_given(kHeight) || !has_color) {
    sink_->report(diag::nothing_to_render, whole_file)
        .help("add a `camera`, or `import` this file in a scene if it only declares names");
  }
}

void SceneBuilder::lower_chosen_camera(const Object& object, LoweredScene& lowered) {
  if (auto camera = lower_camera(object, file_->format(), named_, *sink_)) {
    lowered.scene.camera = camera->camera;
    lowered.camera = std::move(camera->written);
  }
  move_spheres(object, lowered.scene);
}

void SceneBuilder::move_spheres(const Object& camera, render::Scene& scene) {
  using camera_property::kShutter;
  if (const auto shutter = camera.get<render::Interval>(kShutter)) {
    std::vector<render::Vec3>& shifts = world_.shifts;
    if (!moving_.empty() || !shifts.empty()) shifts.resize(scene.spheres.size());
    lower_motion(moving_, *shutter, *sink_, scene.spheres, shifts);
    const bool is_moving =
        std::ranges::any_of(shifts, [](render::Vec3 shift) { return shift != render::Vec3{}; });
    if (is_moving) scene.shifts = std::move(shifts);
    return;
  }
  // A check considers the shutters of all cameras.
  const bool has_shutter =
      purpose_ == Purpose::Check && std::ranges::any_of(cameras_, [](const Object& other) {
        return other.get<render::Interval>(kShutter).has_value();
      });
  if (moving_.empty() || has_shutter) return;
  const Location where = moving_.front().where;
  const bool is_config = where.file->format() == SourceFormat::Json;
  sink_->report(diag::no_effect, where, is_config ? "movement" : "motion")
      .help(is_config ? "without `time_interval` spheres do not move"
                      : "the camera has no `shutter`, so nothing moves");
}

void SceneBuilder::drop_coincident(LoweredScene& lowered) {
  render::Scene& scene = lowered.scene;
  lowered.bent_paths = std::move(bent_paths_);
  const auto coincident = render::find_coincident(scene.spheres, scene.shifts);
  if (coincident.empty()) return;
  for (const render::CoincidentSphere& pair : coincident) {
    dropped_.push_back({.sphere = pair.sphere,
                        .earlier = pair.earlier,
                        .is_exact = pair.is_exact,
                        .has_other_material = scene.spheres[pair.sphere].material !=
                                              scene.spheres[pair.earlier].material});
  }
  render::remove_coincident(coincident, scene.spheres, scene.shifts);
  renumber(coincident, lowered.bent_paths);
}

}  // namespace sdlc::lang
