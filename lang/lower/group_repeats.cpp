#include "lang/lower/group_repeats.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/scene/coincident.hpp"

namespace sdlc::lang {
namespace {

// What is recorded may be in vain. Larger contents are rarely all of one def, which may be
// evaluated again.
constexpr std::size_t kMostRecordedBytes = std::size_t{96} << 20;

// Slots of spheres have 32 bits in the tables that they are traced from, some of them empty.
constexpr std::uint64_t kMostPrototypeSpheres = std::uint64_t{1} << 31;

bool is_finite(const render::Material& material) {
  return material.type != render::MaterialType::Emissive ||
         render::is_finite(material.color * material.parameter);
}

std::uint32_t material_of(const InnerSphere& sphere, const Placing& placing,
                          MaterialTable& materials) {
  return sphere.material ? *sphere.material : materials.index_of(*placing.material);
}

}  // namespace

void GroupRepeats::enter(const Placing& group) {
  Recording* const current = recording();
  if (current == nullptr) return;
  current->groups.push_back(
      current->is_spoilt ? 0 : current->contents.add_group(current->groups.back(), group));
}

void GroupRepeats::begin(std::uint32_t contents) {
  recordings_.push_back({.number = contents, .contents = {}, .groups = {0}});
}

void GroupRepeats::leave() {
  Recording* current = recording();
  if (current == nullptr) return;
  if (current->groups.size() == 1) {
    finish_recording();
    current = recording();
    if (current == nullptr) return;
  }
  current->groups.pop_back();
}

void GroupRepeats::finish_recording() {
  Recording done = std::move(recordings_.back());
  recordings_.pop_back();
  const std::size_t bytes = done.contents.memory_bytes();
  const bool is_kept = !done.is_spoilt && recorded_bytes_ + bytes <= kMostRecordedBytes;
  if (Recording* const outer = recording()) {
    if (is_kept) {
      outer->contents.add_reference(outer->groups.back(), done.number, done.contents);
    } else {
      spoil();
    }
  }
  if (!is_kept) return;
  recorded_bytes_ += bytes;
  records_[done.number].contents = std::move(done.contents);
}

void GroupRepeats::add_sphere(const InnerSphere& sphere) {
  Recording* const current = recording();
  if (current == nullptr || current->is_spoilt) return;
  current->contents.add_sphere(current->groups.back(), sphere);
  if (recorded_bytes_ + current->contents.memory_bytes() > kMostRecordedBytes) spoil();
}

void GroupRepeats::spoil() {
  if (Recording* const current = recording()) {
    current->is_spoilt = true;
    current->contents = {};
  }
}

bool GroupRepeats::repeat(std::uint32_t contents, const Placing& group, const Placing& in_world,
                          const World& world) {
  const auto found = records_.find(contents);
  if (found == records_.end()) return false;
  Record& record = found->second;
  if (record.contents.inherits() && !(in_world.material && is_finite(*in_world.material))) {
    return false;
  }
  const std::size_t spheres = world.spheres.spheres.size(), instances = instances_.size();
  const std::size_t runs = runs_.size();
  const std::uint64_t in_last_run = runs_.empty() ? 0 : runs_.back().count;
  if (!place(record, in_world, world)) {
    world.spheres.shrink_to(spheres);
    instances_.resize(instances);
    runs_.resize(runs);
    if (runs > 0) runs_.back().count = in_last_run;
    return false;
  }
  Recording* const current = recording();
  if (current != nullptr && !current->is_spoilt) {
    const std::uint32_t inner = current->contents.add_group(current->groups.back(), group);
    current->contents.add_reference(inner, contents, record.contents);
    if (recorded_bytes_ + current->contents.memory_bytes() > kMostRecordedBytes) spoil();
  }
  return true;
}

bool GroupRepeats::place(Record& record, const Placing& placing, const World& world) {
  const GroupContents& contents = record.contents;
  if (stays_plain(contents, placing, world)) {
    if (contents.count() > world.most_objects - objects_in(world)) return false;
    return add_spheres(contents, placing, world.spheres, world.materials);
  }
  if (wants_prototype(record, world)) {
    const auto prototype = prototype_of(record, placing.material, world.materials);
    return prototype && add_instance(contents, *prototype, placing, world);
  }
  return contents.for_each(
      placing,
      [&](const InnerSphere& sphere, const Placing& there) {
        return objects_in(world) < world.most_objects &&
               sphere.add_to(world.spheres, there, material_of(sphere, there, world.materials));
      },
      [&](const GroupContents::Reference& reference, const Placing& there) {
        return place(records_.at(reference.contents), there, world);
      });
}

bool GroupRepeats::stays_plain(const GroupContents& contents, const Placing& placing,
                               const World& world) const {
  // What turns while the shutter is open moves each sphere along a line of its own.
  if (instancing_ == Instancing::Never || contents.count() == 0 || !placing.keeps_shape()) {
    return true;
  }
  if (instancing_ == Instancing::Always) return false;
  const std::size_t plain = world.spheres.spheres.size();
  return contents.count() <= kSpheresPerInstance ||
         (plain <= kMostPlainSpheres && contents.count() <= kMostPlainSpheres - plain);
}

/// Whether a prototype of all of it takes less memory than its parts, placed one by one, have taken
/// so far and would take now: at most twice what is best in the end.
bool GroupRepeats::wants_prototype(Record& record, const World& world) const {
  const GroupContents& contents = record.contents;
  const bool may_be = contents.count() <= kMostPrototypeSpheres - prototype_spheres_ &&
                      contents.count() <= world.most_objects - objects_in(world);
  if (!record.prototypes.empty()) return true;
  if (instancing_ == Instancing::Always) return may_be;
  std::uint64_t parts = contents.own_count();
  for (const GroupContents::Reference& reference : contents.references()) {
    parts += std::min(records_.at(reference.contents).contents.count(), kSpheresPerInstance);
  }
  record.added += parts;
  return may_be && record.added >= contents.count();
}

std::optional<std::uint32_t> GroupRepeats::prototype_of(
    Record& record, const std::optional<render::Material>& material, MaterialTable& materials) {
  std::optional<std::uint32_t> inherited;
  if (record.contents.inherits()) inherited = materials.index_of(*material);
  const auto found = record.prototypes.find(inherited);
  if (found != record.prototypes.end()) return found->second;

  Placing own;
  own.material = material;
  PlacedSpheres placed;
  if (!add_spheres(record.contents, own, placed, materials)) return std::nullopt;
  if (!placed.shifts.empty()) placed.shifts.resize(placed.spheres.size());
  render::Prototype prototype{.spheres = std::move(placed.spheres),
                              .shifts = std::move(placed.shifts)};
  render::remove_coincident(render::find_coincident(prototype.spheres, prototype.shifts),
                            prototype.spheres, prototype.shifts);  // told of the first ones
  prototype.spheres.shrink_to_fit();
  prototype.shifts.shrink_to_fit();
  const auto smallest = std::ranges::min_element(prototype.spheres, {}, &render::Sphere::radius);
  reaches_.push_back({.ball = render::ball_around(prototype), .smallest_radius = smallest->radius});
  const auto index = static_cast<std::uint32_t>(prototypes_.size());
  prototype_spheres_ += prototype.spheres.size();
  prototypes_.push_back(std::move(prototype));
  record.prototypes.emplace(inherited, index);
  return index;
}

bool GroupRepeats::add_instance(const GroupContents& contents, std::uint32_t prototype,
                                const Placing& placing, const World& world) {
  if (objects_in(world) >= world.most_objects) return false;
  const auto& [opening, closing] = placing.placements;
  const render::Instance instance{
      .prototype = prototype, .placement = opening, .shift = closing.translate - opening.translate};
  const auto& [ball, smallest_radius] = reaches_[prototype];
  const double radius = ball.radius * opening.scale;
  const bool is_within_numbers = render::is_finite(opening.apply(ball.center)) &&
                                 std::isfinite(2 * radius) && smallest_radius * opening.scale > 0 &&
                                 render::is_finite(instance.shift);
  if (!is_within_numbers) return false;
  instances_.push_back(instance);
  const std::size_t before = world.spheres.spheres.size();
  if (!runs_.empty() && runs_.back().before == before) {
    runs_.back().count += contents.count();
  } else {
    runs_.push_back({.before = before, .count = contents.count()});
  }
  return true;
}

bool GroupRepeats::add_spheres(const GroupContents& contents, const Placing& placing,
                               PlacedSpheres& to, MaterialTable& materials) const {
  return contents.for_each(
      placing,
      [&](const InnerSphere& sphere, const Placing& there) {
        return sphere.add_to(to, there, material_of(sphere, there, materials));
      },
      [&](const GroupContents::Reference& reference, const Placing& there) {
        return add_spheres(records_.at(reference.contents).contents, there, to, materials);
      });
}

std::vector<render::Prototype> GroupRepeats::take_prototypes() {
  records_.clear();
  return std::move(prototypes_);
}

}  // namespace sdlc::lang
