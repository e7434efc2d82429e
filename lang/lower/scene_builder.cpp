#include "lang/lower/scene_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/lower/camera.hpp"
#include "lang/lower/placement.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/image/image_format.hpp"
#include "render/image/picture.hpp"
#include "render/scene/choices.hpp"
#include "render/scene/coincident.hpp"

namespace sdlc::lang {
namespace {

// With what finding coincident spheres takes, and the tree in which a check looks for neighbours.
constexpr std::size_t kBytesOfCheckedSphere = 96;
constexpr std::size_t kBytesOfSphere = 64, kBytesOfCamera = 2 * sizeof(Object);

render::Material lower_material(const MaterialValue& value) {
  static constexpr std::array kTypes{render::MaterialType::Diffuse, render::MaterialType::Specular,
                                     render::MaterialType::Transmissive,
                                     render::MaterialType::Emissive, render::MaterialType::Unlit};
  return {.color = value.color,
          .parameter = value.parameter,
          .type = kTypes[static_cast<std::size_t>(value.kind)],
          .fresnel = value.exact_fresnel ? render::Fresnel::Exact : render::Fresnel::Schlick};
}

render::Tone lower_tone(std::string_view word) {
  if (word == "sqrt") return render::Tone::Sqrt;
  if (word == "linear") return render::Tone::Linear;
  return render::Tone::Srgb;
}

/// Nothing: whatever suits the scene.
std::optional<render::Precision> lower_precision(std::string_view word) {
  if (word == "float") return render::Precision::Float;
  if (word == "double") return render::Precision::Double;
  return std::nullopt;
}

/// The one that the word names.
template <typename T, std::size_t N>
T lower_choice(std::string_view word, const std::array<T, N>& choices) {
  const auto found =
      std::ranges::find(choices, word, [](T choice) { return render::name_of(choice); });
  return found == choices.end() ? choices.front() : *found;
}

}  // namespace

void SceneBuilder::add(const Object& object) {
  switch (object.kind->id) {
    case ObjectKind::Camera:
      if (may_take_more_memory(object.where)) cameras_.push_back(object);
      break;
    case ObjectKind::Background:
      if (!background_) background_ = object;  // a second one has been reported
      break;
    case ObjectKind::Sphere: add_sphere(object); break;
    case ObjectKind::Render:
      if (!render_) render_ = object;
      break;
    case ObjectKind::Animation: is_animated_ = true; break;
    case ObjectKind::Group: break;  // see enter()
  }
}

SceneBuilder::Group SceneBuilder::read_group(const Object& object) const {
  using namespace group_property;
  const double scale = object.get<double>(kScale).value_or(1);
  const auto translate = object.get<render::Vec3>(kTranslate).value_or(render::Vec3{});
  const auto rotate = object.get<AngleTriple>(kRotate).value_or(AngleTriple{});
  const render::Placement opening = placement_of(translate, rotate.degrees, scale);
  Group group{.placing = {.placements = {opening, opening}, .material = {}},
              .middle = opening,
              .has_bad_material = object.slot(kMaterial).is_written || object.is_broken};
  if (!object.closing.empty()) {
    const auto translate_to = object.get_closing<render::Vec3>(kTranslate).value_or(translate);
    const auto rotate_to = object.get_closing<AngleTriple>(kRotate).value_or(rotate);
    group.placing.is_moving = true;
    group.placing.placements[1] = placement_of(translate_to, rotate_to.degrees, scale);
    group.is_turning = purpose_ == Purpose::Check && rotate != rotate_to;
    if (purpose_ == Purpose::Check) {
      group.middle = placement_of((translate + translate_to) * 0.5,
                                  (rotate.degrees + rotate_to.degrees) * 0.5, scale);
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
          .middle = outer.middle.around(group.middle),
          .is_turning = group.is_turning || outer.is_turning,
          .has_bad_material = group.has_bad_material || outer.has_bad_material};
}

void SceneBuilder::enter(const Object& object) {
  const Group group = read_group(object);
  repeats_.enter(group.placing);
  groups_.push_back(in_world(group));
}

void SceneBuilder::leave() {
  repeats_.leave();
  groups_.pop_back();
}

bool SceneBuilder::repeat(const Object& object, std::uint32_t contents) {
  const Group group = read_group(object);
  const auto outcome =
      repeats_.repeat(contents, group.placing, in_world(group).placing,
                      {.spheres = world_, .materials = materials_, .most_objects = most_objects()});
  bytes_.set(bytes());
  if (outcome == GroupRepeats::Outcome::Duplicate) {
    sink_->report(diag::duplicate_sphere, object.where, "group is the same as an earlier one");
  }
  return outcome != GroupRepeats::Outcome::Unknown;
}

std::size_t SceneBuilder::bytes() const noexcept {
  const bool is_checked = purpose_ == Purpose::Check;
  return world_.spheres.size() * (is_checked ? kBytesOfCheckedSphere : kBytesOfSphere) +
         world_.shifts.size() * sizeof(render::Vec3) + moving_.size() * sizeof(MovingSphere) +
         bent_paths_.size() * sizeof(BentPath) + cameras_.size() * kBytesOfCamera +
         materials_.bytes() + repeats_.bytes();
}

bool SceneBuilder::may_take_more_memory(Location where) {
  bytes_.set(bytes());
  if (CountedBytes::sum() <= limits_.memory) return true;
  if (std::exchange(is_full_, true)) return false;
  sink_->report(diag::too_much_memory, where, limits_.memory)
      .help("`--limit memory=N` allows more");
  return false;
}

std::uint64_t SceneBuilder::most_objects() const noexcept {
  const std::uint64_t free = limits_.memory - std::min(limits_.memory, CountedBytes::sum());
  return std::min(limits_.objects,
                  world_.spheres.size() + repeats_.object_count() + free / kBytesOfSphere);
}

void SceneBuilder::forget_spheres() {
  forgotten_ += world_.spheres.size();
  world_ = {};
  moving_.clear();
  bent_paths_.clear();
}

bool SceneBuilder::may_hold_another(Location where) {
  constexpr std::size_t kAtOnce = 256;  // spheres, for which the rest may grow uncounted
  const bool is_due = is_full_ || world_.spheres.size() % kAtOnce == 0;
  if (is_due && !may_take_more_memory(where)) return false;
  if (sphere_count() + repeats_.object_count() < limits_.objects) return true;
  if (std::exchange(is_full_, true)) return false;  // it is told once
  sink_->report(diag::too_many_objects, where, limits_.objects)
      .help("`--limit objects=N` allows more");
  return false;
}

void SceneBuilder::add_sphere(const Object& object) {
  using namespace sphere_property;
  had_spheres_ = true;
  const auto center = object.get<render::Vec3>(kCenter);
  const auto radius = object.get<double>(kRadius);
  const auto own_material = object.get<MaterialValue>(kMaterial);
  std::optional<render::Material> material;
  if (own_material) material = lower_material(*own_material);
  if (!object.slot(kMaterial).is_written) {
    if (!groups_.empty()) material = groups_.back().placing.material;
    const bool is_reported =
        object.is_broken || (!groups_.empty() && groups_.back().has_bad_material);
    if (!material && !is_reported && !is_part()) {
      sink_->report(diag::no_material, object.where)
          .help("give it or a group around it one, such as `material: diffuse(color: white)`");
    }
  }
  if (!center || !radius || !material) return;  // reported where it was read
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

  const auto index = static_cast<std::uint32_t>(world_.spheres.size());
  if (const auto motion = object.get<MotionValue>(kMotion)) {
    moving_.push_back({.sphere = index,
                       .where = object.location(kMotion),
                       .motion = *motion,
                       .center = *center,
                       .group = {}});
    if (!groups_.empty()) moving_.back().group = groups_.back().placing.placements;
    repeats_.spoil();
  }
  const std::uint32_t row = materials_.index_of(*material);
  if (groups_.empty() && object.closing.empty()) {
    world_.add({.center = *center, .radius = *radius, .material = row}, {});
    return;
  }
  const auto closing = *object.get_closing<render::Vec3>(kCenter);
  const bool is_turning = !groups_.empty() && groups_.back().is_turning;
  if (is_turning && !object.slot(kMotion).is_written) find_bent_path(index, *center, closing);
  InnerSphere sphere{.center = *center,
                     .closing = closing,
                     .radius = *radius,
                     .material = {},
                     .is_moving = !object.closing.empty()};
  if (own_material) sphere.material = row;
  if (!sphere.add_to(world_, groups_.empty() ? Placing() : groups_.back().placing, row)) {
    sink_->report(diag::beyond_numbers, object.where, "where the groups around this sphere put it");
    return;
  }
  repeats_.add_sphere(sphere);
}

void SceneBuilder::find_bent_path(std::uint32_t sphere, render::Vec3 opening,
                                  render::Vec3 closing) {
  const Group& group = groups_.back();
  const render::Vec3 from = group.placing.placements[0].apply(opening);
  const render::Vec3 to = group.placing.placements[1].apply(closing);
  const render::Vec3 middle = group.middle.apply((opening + closing) * 0.5);
  bent_paths_.push_back({.sphere = sphere, .sagitta = length(middle - (from + to) * 0.5)});
}

LoweredScene SceneBuilder::finish(const Overrides& overrides) {
  LoweredScene lowered;
  lowered.scene.spheres = std::move(world_.spheres);
  lowered.scene.prototypes = repeats_.take_prototypes();
  lowered.scene.instances = repeats_.take_instances();
  lowered.scene.materials = materials_.take();
  lower_background(lowered.scene);

  const Object* camera = choose_camera(overrides);
  for (const Object& declared : cameras_) lowered.cameras.push_back(declared.name);
  if (purpose_ == Purpose::Check) check_cameras(lowered);
  find_places(lowered);
  if (camera != nullptr) {
    lower_camera(*camera, lowered);
    if (const auto shutter = camera->get<render::Interval>(camera_property::kShutter)) {
      lower_motion(*shutter, lowered.scene);
    } else if (!moving_.empty() && !has_open_shutter()) {
      const Location where = moving_.front().where;
      const bool is_config = where.file->format() == SourceFormat::Json;
      sink_->report(diag::no_effect, where, is_config ? "movement" : "motion")
          .help(is_config ? "without `time_interval` every sphere stays at its origin"
                          : "the camera has no `shutter`: everything stands still");
    }
  }
  lower_settings(overrides, lowered);
  lower_size(camera, overrides, lowered);
  if (!overrides.names_output) check_output(lowered);
  drop_coincident(lowered);
  lowered.dropped_spheres = dropped_.size();
  bytes_.set(0);  // the scene is the caller's now
  return lowered;
}

const Object* SceneBuilder::choose_camera(const Overrides& overrides) {
  using namespace render_property;
  std::vector<std::string_view> names;
  for (const Object& camera : cameras_) names.push_back(camera.name);

  std::string wanted;
  Location where = whole_file();
  if (overrides.camera) {
    wanted = *overrides.camera;
  } else if (render_ && render_->slot(kCamera).is_written) {
    const auto word = render_->get<Word>(kCamera);
    if (!word) return nullptr;
    wanted = word->text;
    where = render_->location(kCamera);
  }
  if (!wanted.empty()) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found != names.end()) return &cameras_[static_cast<std::size_t>(found - names.begin())];
    const auto nearest = nearest_name(wanted, names);
    std::erase(names, "");
    const std::string help =
        names.empty() ? "" : fmt::format("cameras of the scene: {}", fmt::join(names, ", "));
    if (!overrides.camera) {
      auto report =
          sink_->report(diag::unknown_camera, where, wanted).suggest(nearest).help_if(help);
      if (nearest) {
        const auto named = std::ranges::find(cameras_, *nearest, &Object::name);
        report.label(named->where, fmt::format("`{}` is declared here", *nearest));
      }
      return nullptr;
    }
    // The name stands on the command line, where no text of a file is to blame.
    auto report = sink_->report(diag::unknown_camera, {}, wanted);
    if (nearest) report.help(fmt::format("did you mean `{}`?", *nearest));
    report.help_if(help);
    return nullptr;
  }
  if (cameras_.size() == 1) return &cameras_.front();
  if (cameras_.size() > 1 && purpose_ == Purpose::Check) return &cameras_.front();
  if (cameras_.size() > 1) {
    sink_->report(diag::ambiguous_camera, cameras_[1].where, static_cast<int>(cameras_.size()))
        .label(cameras_[0].where, "the first camera")
        .help("choose one with --camera NAME or `render { camera: NAME }`");
    return nullptr;
  }

  // An earlier error may have taken the camera away.
  if (!sink_->has_errors() && !is_part()) check_for_picture(overrides);
  return nullptr;
}

void SceneBuilder::check_for_picture(const Overrides& overrides) {
  using namespace render_property;
  if (had_spheres_) {
    sink_->report(diag::no_camera, whole_file())
        .help("add `camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }`");
    return;
  }
  const bool has_size = (overrides.width || (render_ && render_->slot(kWidth).is_written)) &&
                        (overrides.height || (render_ && render_->slot(kHeight).is_written));
  const bool has_color = background_ && background_->slot(background_property::kColor).is_written;
  if (!has_size || !has_color) {
    sink_->report(diag::nothing_to_render, whole_file())
        .help("a file that only declares names is for `import`, one of spheres needs a `camera`");
  }
}

std::string_view SceneBuilder::name_of(const Object& object, std::size_t property) const {
  return property_name(object, property, file_->format());
}

void SceneBuilder::lower_camera(const Object& object, LoweredScene& lowered) {
  auto camera = lang::lower_camera(object, file_->format(), *sink_);
  if (!camera) return;
  lowered.scene.camera = camera->camera;
  lowered.camera = std::move(camera->written);
}

bool SceneBuilder::has_open_shutter() const {
  return purpose_ == Purpose::Check && std::ranges::any_of(cameras_, [](const Object& camera) {
           return camera.get<render::Interval>(camera_property::kShutter).has_value();
         });
}

void SceneBuilder::check_cameras(LoweredScene& lowered) {
  using namespace camera_property;
  for (const Object& declared : cameras_) {
    lowered.camera.reset();
    lower_camera(declared, lowered);
    if (!lowered.camera) continue;
    lowered.checked_cameras.push_back({.name = declared.name,
                                       .camera = lowered.scene.camera,
                                       .shutter = lowered.camera->shutter,
                                       .from = declared.location(kFrom),
                                       .aspect = {}});
    if (declared.slot(kAspect).is_written) {
      lowered.checked_cameras.back().aspect = declared.location(kAspect);
    }
  }
  lowered.camera.reset();
}

void SceneBuilder::find_places(LoweredScene& lowered) const {
  using namespace render_property;
  if (background_) lowered.places.background = background_->where;
  if (!render_) return;
  const auto place = [&](std::size_t property) {
    return render_->slot(property).is_written ? render_->location(property) : Location{};
  };
  lowered.places.width = place(kWidth);
  lowered.places.height = place(kHeight);
  lowered.places.samples = place(kSamples);
  lowered.places.depth = place(kDepth);
  lowered.places.precision = place(kPrecision);
  lowered.places.error = place(kError);
  lowered.places.output = place(kOutput);
}

void SceneBuilder::lower_background(render::Scene& scene) {
  using namespace background_property;
  if (!background_) return;  // the renderer's default is the JSON format's gradient
  const Object& object = *background_;
  const bool has_ends = object.slot(kBottom).is_written || object.slot(kTop).is_written;
  if (object.slot(kColor).is_written && has_ends) {
    const std::size_t end = object.slot(kBottom).is_written ? kBottom : kTop;
    sink_->report(diag::not_together, object.location(end), "`color`", "`bottom` or `top`")
        .label(object.location(kColor), "`color` is the same radiance from everywhere");
    return;
  }
  if (const auto color = object.get<render::LinearRgb>(kColor)) {
    scene.background = {.bottom = *color, .top = *color};
    return;
  }
  if (!has_ends) {
    if (!object.slot(kColor).is_written && !object.is_broken) {
      sink_->report(diag::missing, object.where, "background", "color")
          .help("give a `color`, or `bottom` and `top`");
    }
    return;
  }
  for (const std::size_t end : {kBottom, kTop}) {
    if (object.slot(end).is_written || object.is_broken) continue;
    sink_->report(diag::missing, object.where, "background", object.kind->properties[end].name)
        .help("a gradient has both a `bottom` and a `top`");
  }
  const auto bottom = object.get<render::LinearRgb>(kBottom);
  const auto top = object.get<render::LinearRgb>(kTop);
  if (bottom && top) scene.background = {.bottom = *bottom, .top = *top};
}

void SceneBuilder::lower_motion(render::Interval shutter, render::Scene& scene) {
  if (!moving_.empty() || !world_.shifts.empty()) world_.shifts.resize(scene.spheres.size());
  for (const MovingSphere& moving : moving_) {
    render::Sphere& sphere = scene.spheres[moving.sphere];
    const render::Interval over = moving.motion.over;
    const double duration = over.to - over.from;
    const render::Vec3 way = moving.motion.to - moving.center;
    render::Vec3 opening = moving.center + way * ((shutter.from - over.from) / duration);
    render::Vec3 shift = way * ((shutter.to - shutter.from) / duration);
    if (moving.group) {
      const auto& [at_opening, at_closing] = *moving.group;
      const render::Vec3 closing = at_closing.apply(opening + shift);
      opening = at_opening.apply(opening);
      shift = closing - opening;
    }
    if (!is_finite(opening) || !is_finite(opening + shift)) {
      sink_->report(diag::beyond_numbers, moving.where, "where the motion leads");
      continue;
    }
    sphere.center = opening;
    world_.shifts[moving.sphere] = shift;
  }
  const bool is_moving = std::any_of(world_.shifts.begin(), world_.shifts.end(),
                                     [](render::Vec3 shift) { return shift != render::Vec3{}; });
  if (is_moving) scene.shifts = std::move(world_.shifts);
}

std::optional<int> SceneBuilder::whole(const Object& object, std::size_t property) const {
  const auto value = object.get<double>(property);
  if (!value) return std::nullopt;
  constexpr double kLargest = std::numeric_limits<int>::max();
  if (*value > kLargest) {
    sink_->report(diag::out_of_range, object.location(property), name_of(object, property),
                  fmt::format("at most {}", std::numeric_limits<int>::max()), to_text(*value));
    return std::nullopt;
  }
  return static_cast<int>(*value);
}

void SceneBuilder::lower_settings(const Overrides& overrides, LoweredScene& lowered) {
  using namespace render_property;
  if (!render_)
    render_ = Object{.kind = &kind_info(ObjectKind::Render),
                     .where = whole_file(),
                     .name = {},
                     .is_broken = false,
                     .slots = {},
                     .closing = {}};
  const Object& object = *render_;
  render::RenderSettings& settings = lowered.settings;
  const auto set = [](auto& setting, const auto& value) {
    if (value) setting = static_cast<std::remove_reference_t<decltype(setting)>>(*value);
  };
  set(settings.depth, overrides.depth ? overrides.depth : whole(object, kDepth));
  set(settings.threads, overrides.threads ? overrides.threads : whole(object, kThreads));
  // A config's number_cores says how many it would like; more than there are means all.
  const bool is_config = file_->format() == SourceFormat::Json && !overrides.threads;
  if (is_config && settings.threads > static_cast<int>(std::thread::hardware_concurrency())) {
    settings.threads = 0;
  }
  set(settings.seed, object.get<double>(kSeed));
  set(settings.seed, overrides.seed);
  set(lowered.output.output, object.get<std::string>(kOutput));
  if (const auto tone = object.get<Word>(kTone)) lowered.output.tone = lower_tone(tone->text);
  if (overrides.tone) lowered.output.tone = lower_tone(*overrides.tone);
  if (const auto precision = object.get<Word>(kPrecision)) {
    lowered.precision = lower_precision(precision->text);
  }
  if (overrides.precision) lowered.precision = lower_precision(*overrides.precision);
  const auto word = [&](const std::optional<std::string>& flag, std::size_t property) {
    const auto written = object.get<Word>(property).value_or(Word{});
    return flag.value_or(written.text);
  };
  settings.sampler = lower_choice(word(overrides.sampler, kSampler), render::kSamplerKinds);
  settings.light_sampling =
      lower_choice(word(overrides.light_sampling, kLightSampling), render::kLightSamplings);
  lower_goals(overrides, lowered);
}

void SceneBuilder::check_output(const LoweredScene& lowered) {
  const std::string& name = lowered.output.output;
  Location where = render_->location(render_property::kOutput);
  if (!render_->get<std::string>(render_property::kOutput)) return;
  const auto format = render::image_format_of(name);
  std::string refusal = render::refusal_of_name(name);
  if (refusal.empty()) {
    refusal = render::refusal_of_size(lowered.settings.width, lowered.settings.height, *format);
  }
  if (!refusal.empty()) {
    std::string extension = std::filesystem::path(name).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    const auto nearest =
        format ? std::nullopt : nearest_name(extension, render::image_extensions());
    // In a literal only the extension is wrong.
    const bool is_literal = nearest && where.file->text(where.span).ends_with(extension + '"');
    if (is_literal) {
      --where.span.end;
      where.span.begin = where.span.end - static_cast<std::uint32_t>(extension.size());
    }
    auto report = sink_->report(diag::bad_output, where, abbreviated(name), refusal);
    if (is_literal) report.suggest(nearest);
    if (nearest && !is_literal) report.help(fmt::format("did you mean `.{}`?", *nearest));
  } else if (is_animated_ && name.find("####") == std::string::npos) {
    sink_->report(diag::no_frame_number, where, name);
  }
}

void SceneBuilder::lower_goals(const Overrides& overrides, LoweredScene& lowered) {
  using namespace render_property;
  const Object& object = *render_;
  render::RenderSettings& settings = lowered.settings;
  if (cameras_.empty()) {  // a plain picture has no noise
    settings.samples = settings.depth = 1;
    return;
  }
  const bool is_by_flag = overrides.error || overrides.seconds;
  settings.error = is_by_flag ? overrides.error : object.get<double>(kError);
  settings.seconds = overrides.seconds;
  settings.is_adaptive = overrides.is_adaptive && settings.error;
  // The scene's samples are the most for its own goal only, and where it says how many.
  const bool is_by_scene =
      !is_by_flag && (object.slot(kSamples).is_written || !settings.error.has_value());
  if (overrides.samples) {
    settings.samples = *overrides.samples;
  } else if (!is_by_scene) {
    settings.samples = render::kMostSamples;
  } else if (const auto written = whole(object, kSamples)) {
    settings.samples = *written;
  }
  diagnose_few_samples(lowered, overrides.samples.has_value());
}

void SceneBuilder::diagnose_few_samples(const LoweredScene& lowered, bool is_by_flag) {
  // Fewer samples of a pixel give no estimate of its error.
  constexpr int kLeastSamples = 8;
  const std::optional<double> error = lowered.settings.error;
  const int samples = lowered.settings.samples;
  if (!error || samples >= kLeastSamples) return;
  const WrittenPlaces& places = lowered.places;
  const Location where = is_by_flag ? places.error : places.samples;
  auto report = sink_->report(diag::samples_below_error, where,
                              fmt::format("{} sample{}", samples, samples == 1 ? "" : "s"),
                              fmt::format("{:.6g}%", 100 * *error),
                              fmt::format("of fewer than {} no error is known", kLeastSamples));
  if (!is_by_flag) report.label(places.error, "the error to reach");
  report.help(fmt::format("leave `{}` out, or give {} or more",
                          is_by_flag ? "--samples" : "samples", kLeastSamples));
}

void SceneBuilder::lower_size(const Object* camera, const Overrides& overrides,
                              LoweredScene& lowered) {
  using namespace render_property;
  std::optional<int> written_width;
  if (render_->slot(kWidth).is_written) written_width = whole(*render_, kWidth);
  const std::optional<int> written_height = whole(*render_, kHeight);
  // What is wrong has been reported; the size that follows from the rest would be another.
  const bool lacks_width = render_->slot(kWidth).is_written && !written_width;
  const bool lacks_height = render_->slot(kHeight).is_written && !written_height;
  const bool lacks_camera = !lowered.camera && sink_->has_errors();
  lowered.settings.width = lowered.settings.height = 0;
  if (lacks_width || lacks_height || lacks_camera) return;
  const bool is_aspect_written =
      camera != nullptr && camera->slot(camera_property::kAspect).is_written;
  double& aspect = lowered.scene.camera.aspect;
  if (written_width && written_height && !is_aspect_written) {
    aspect = static_cast<double>(*written_width) / *written_height;
  }

  // The picture's own sides keep their proportion; else it is the view plane's.
  const bool has_both = written_width && written_height;
  const double proportion =
      has_both ? static_cast<double>(*written_width) / *written_height : aspect;
  const auto width_of = [&](double height) {
    return std::max(1.0, std::round(height * proportion));
  };
  const auto height_of = [&](double width) {
    // A product of whole numbers below 2^53 is exact, and so is the floor of its quotient.
    return std::floor(has_both ? width * written_height.value() / written_width.value()
                               : width / proportion);
  };

  double width, height;
  if (overrides.width && overrides.height) {
    width = *overrides.width;
    height = *overrides.height;
    aspect = width / height;
  } else if (overrides.height) {
    height = *overrides.height;
    width = width_of(height);
  } else if (overrides.width) {
    width = *overrides.width;
    height = height_of(width);
  } else if (has_both) {
    width = *written_width;
    height = *written_height;
  } else if (written_height) {
    height = *written_height;
    width = width_of(height);
  } else {
    width = render_->get<double>(kWidth).value_or(0);
    height = height_of(width);
  }

  if (height < 1) {
    Location where = whole_file();
    if (is_aspect_written) where = camera->location(camera_property::kAspect);
    if (render_->slot(kWidth).is_written) where = render_->location(kWidth);
    sink_->report(diag::no_rows, where, static_cast<int>(width), to_text(proportion))
        .help(
            "the height is width / aspect, rounded down; make the picture wider, or the aspect "
            "smaller");
  } else if (!(width * height <= static_cast<double>(render::kMaxPicturePixels))) {
    const Location where =
        render_->slot(kWidth).is_written ? render_->location(kWidth) : whole_file();
    sink_
        ->report(diag::picture_too_large, where, fmt::format("{:.0f}", width),
                 fmt::format("{:.0f}", height))
        .help(fmt::format("it may have {} pixels in all", render::kMaxPicturePixels));
  } else {
    lowered.settings.width = static_cast<int>(width);
    lowered.settings.height = static_cast<int>(height);
  }
}

void SceneBuilder::drop_coincident(LoweredScene& lowered) {
  render::Scene& scene = lowered.scene;
  lowered.bent_paths = std::move(bent_paths_);
  const auto coincident = render::find_coincident(scene.spheres, scene.shifts);
  if (coincident.empty()) return;
  for (const render::CoincidentSphere& pair : coincident) {
    dropped_.push_back({.sphere = static_cast<std::uint32_t>(pair.sphere),
                        .earlier = static_cast<std::uint32_t>(pair.earlier),
                        .is_exact = pair.is_exact,
                        .has_other_material = scene.spheres[pair.sphere].material !=
                                              scene.spheres[pair.earlier].material});
  }

  render::remove_coincident(coincident, scene.spheres, scene.shifts);
  // What was dropped has no path, and each moves those behind it one place down.
  std::size_t next = 0;
  std::erase_if(lowered.bent_paths, [&](BentPath& path) {
    while (next < coincident.size() && coincident[next].sphere < path.sphere) ++next;
    const bool is_dropped = next < coincident.size() && coincident[next].sphere == path.sphere;
    path.sphere -= static_cast<std::uint32_t>(next);
    return is_dropped;
  });
}

}  // namespace sdlc::lang
