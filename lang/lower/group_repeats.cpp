#include "lang/lower/group_repeats.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "render/exactness/coincident.hpp"

namespace sdlc::lang {
namespace {

// Limits recordings that may never be used. Larger contents are rarely repeated; they are evaluated
// again instead.
constexpr std::size_t kMaxRecordedBytes = std::size_t{96} << 20;

// The tables of the renderer have 32-bit slot numbers, and some slots stay empty.
constexpr std::uint64_t kMaxPrototypeSlots = std::uint64_t{1} << 31;

/// An upper bound: on average leaves are at least half full.
std::uint64_t slots_of(std::uint64_t spheres) { return 2 * ((spheres + 15) / 16 * 16); }

std::uint32_t material_of(const InnerSphere& sphere, const Placing& placing,
                          MaterialTable& materials) {
  return sphere.material ? *sphere.material : materials.index_of(*placing.material);
}

}  // namespace

void GroupRepeats::enter(const Placing& group) {
  Recording* const current = recording();
  if (current == nullptr) return;
  Recording::Open open{.group = 0, .parts = current->contents.parts()};
  if (!current->is_spoilt) {
    open.group = current->contents.add_group(current->groups.back().group, group);
  }
  current->groups.push_back(open);
  charge(sizeof(Placing));
}

void GroupRepeats::begin(std::uint32_t contents, const Placing& in_world) {
  recordings_.push_back({.number = contents,
                         .in_world = in_world,
                         .contents = {},
                         .groups = {{}},
                         .bytes = 0,
                         .is_spoilt = is_full_});
}

void GroupRepeats::leave() {
  Recording* current = recording();
  if (current == nullptr) return;
  if (current->groups.size() == 1) {
    finish_recording();
    current = recording();
    if (current == nullptr) return;
  }
  const auto [group, parts] = current->groups.back();
  current->groups.pop_back();
  const bool is_empty = group > 0 && current->contents.parts() == parts;
  if (is_empty && !current->is_spoilt) current->contents.remove_groups_from(group);
}

void GroupRepeats::finish_recording() {
  Recording done = std::move(recordings_.back());
  recordings_.pop_back();
  if (done.is_spoilt) {
    recorded_bytes_ -= done.bytes;
    spoil();
    return;
  }
  Record& record = records_[done.number];
  record = {
      .contents = std::move(done.contents), .bytes = done.bytes, .is_used = false, .uses = {}};
  if (record.contents.count() > kSpheresPerInstance) {
    places_.insert(identity_of(done.number, record, done.in_world));
  }
  Recording* const outer = valid_recording();
  if (outer != nullptr && record.contents.count() > 0) {
    outer->contents.add_reference(outer->groups.back().group, done.number, record.contents);
    record.is_used = true;
    charge(sizeof(GroupContents::Reference));
  }
}

void GroupRepeats::charge(std::size_t bytes) {
  Recording* const current = valid_recording();
  if (current == nullptr) return;
  current->bytes += bytes;
  recorded_bytes_ += bytes;
  if (recorded_bytes_ <= kMaxRecordedBytes) return;
  drop_unused();
  is_full_ = recorded_bytes_ > kMaxRecordedBytes / 2;
  if (is_full_) spoil();
}

void GroupRepeats::drop_unused() {
  std::erase_if(records_, [&](const auto& entry) {
    if (entry.second.is_used) return false;
    recorded_bytes_ -= entry.second.bytes;
    return true;
  });
}

void GroupRepeats::add_sphere(const InnerSphere& sphere) {
  Recording* const current = valid_recording();
  if (current == nullptr) return;
  current->contents.add_sphere(current->groups.back().group, sphere);
  charge(sizeof(InnerSphere) + sizeof(std::uint32_t));
}

void GroupRepeats::spoil() {
  Recording* const current = valid_recording();
  if (current == nullptr) return;
  current->is_spoilt = true;
  current->contents = {};
  recorded_bytes_ -= std::exchange(current->bytes, 0);
}

void GroupRepeats::forget(std::uint32_t contents) {
  const auto found = records_.find(contents);
  if (found == records_.end() || found->second.is_used) return;
  recorded_bytes_ -= found->second.bytes;
  records_.erase(found);
}

GroupRepeats::Identity GroupRepeats::identity_of(std::uint32_t contents, const Record& record,
                                                 const Placing& in_world) const {
  Identity identity{contents, ~std::uint64_t{contents}};
  const auto mix = [&](double number) {
    // Adding 0 turns -0, which equals 0, into 0.
    const auto word = std::bit_cast<std::uint64_t>(number + 0.0);
    identity[0] = (identity[0] ^ word) * 0x9E3779B97F4A7C15u;
    identity[0] ^= identity[0] >> 29;
    identity[1] = (identity[1] ^ word) * 0xD6E8FEB86659FD93u;
    identity[1] ^= identity[1] >> 32;
  };
  for (const render::Placement& at : in_world.placements) {
    for (const render::Vec3 v : {at.x, at.y, at.z, at.translate}) {
      for (const double number : {v.x, v.y, v.z}) mix(number);
    }
  }
  if (record.contents.inherits() && in_world.material) {
    const render::Material& material = *in_world.material;
    const render::LinearRgb color = material.color;
    for (const double number :
         {color.r, color.g, color.b, material.parameter, static_cast<double>(material.type),
          static_cast<double>(material.fresnel)}) {
      mix(number);
    }
  }
  return identity;
}

GroupRepeats::Outcome GroupRepeats::repeat(std::uint32_t contents, const Placing& group,
                                           const Placing& in_world, const World& world) {
  const auto found = records_.find(contents);
  if (found == records_.end()) return Outcome::Unknown;
  Record& record = found->second;
  if (record.contents.inherits() && !(in_world.material && has_finite_light(*in_world.material))) {
    return Outcome::Unknown;
  }
  if (record.contents.count() == 0) return Outcome::Added;
  const bool may_be_instance = record.contents.count() > kSpheresPerInstance;
  const Identity identity = may_be_instance ? identity_of(contents, record, in_world) : Identity{};
  if (may_be_instance && places_.contains(identity)) {
    // Duplicates of plain spheres are found and reported one by one.
    if (stays_plain(record.contents, in_world, world)) return Outcome::Unknown;
    skip(record.contents.count(), world);
    return Outcome::Duplicate;
  }

  const std::size_t spheres = world.spheres.spheres.size(), instances = instances_.size();
  const std::size_t runs = runs_.size();
  const std::uint64_t in_last_run = runs_.empty() ? 0 : runs_.back().count;
  if (!place(record, in_world, world)) {
    world.spheres.shrink_to(spheres);
    instances_.resize(instances);
    runs_.resize(runs);
    if (runs > 0) runs_.back().count = in_last_run;
    return Outcome::Unknown;
  }
  record.is_used = true;
  repeated_spheres_ += world.spheres.spheres.size() - spheres;
  if (may_be_instance) places_.insert(identity);
  if (Recording* const current = valid_recording()) {
    const std::uint32_t inner = current->contents.add_group(current->groups.back().group, group);
    current->contents.add_reference(inner, contents, record.contents);
    charge(sizeof(Placing) + sizeof(GroupContents::Reference));
  }
  return Outcome::Added;
}

bool GroupRepeats::place(Record& record, const Placing& placing, const World& world) {
  const GroupContents& contents = record.contents;
  if (stays_plain(contents, placing, world)) {
    const std::uint64_t objects = objects_in(world);
    if (objects > world.max_objects || contents.count() > world.max_objects - objects) {
      return false;
    }
    return add_spheres(contents, placing, world.spheres, world.materials);
  }
  std::optional<std::uint32_t> inherited;
  if (contents.inherits()) inherited = world.materials.index_of(*placing.material);
  Use& use = record.uses[inherited];
  if (!use.prototype && wants_prototype(contents, use, world)) {
    use.prototype = make_prototype(contents, placing.material, world.materials);
    if (!use.prototype) return false;
  }
  if (use.prototype) return add_instance(contents, *use.prototype, placing, world);
  return contents.for_each(
      placing,
      [&](const InnerSphere& sphere, const Placing& there) {
        return objects_in(world) < world.max_objects &&
               sphere.add_to(world.spheres, there, material_of(sphere, there, world.materials));
      },
      [&](const GroupContents::Reference& reference, const Placing& there) {
        return place(records_.at(reference.contents), there, world);
      });
}

bool GroupRepeats::stays_plain(const GroupContents& contents, const Placing& placing,
                               const World& world) const {
  // A rotation while the shutter is open moves each sphere by a different vector.
  if (instancing_ == Instancing::Never || !placing.keeps_shape()) return true;
  if (instancing_ == Instancing::Always) return false;
  const std::size_t plain = world.spheres.spheres.size();
  if (contents.count() <= kSpheresPerInstance) return true;
  if (plain <= kMaxPlainSpheres && contents.count() <= kMaxPlainSpheres - plain) return true;
  // With instances, plain spheres take 50 % more memory, so a few repetitions are not worth it.
  const std::uint64_t repeated =
      repeated_spheres_ + std::min(contents.count(), std::uint64_t{1} << 62);
  return 3 * repeated < plain;
}

/// Ski rental: makes a prototype once it takes less memory than the parts placed individually so
/// far. This takes at most twice the memory of the best choice.
bool GroupRepeats::wants_prototype(const GroupContents& contents, Use& use,
                                   const World& world) const {
  const std::uint64_t objects = objects_in(world);
  const bool may_be = contents.count() <= kMaxPrototypeSlots &&
                      slots_of(contents.count()) <= kMaxPrototypeSlots - prototype_slots_ &&
                      objects <= world.max_objects &&
                      contents.count() <= world.max_objects - objects;
  if (instancing_ == Instancing::Always) return may_be;
  std::uint64_t parts = contents.own_count();
  for (const GroupContents::Reference& reference : contents.references()) {
    parts += std::min(records_.at(reference.contents).contents.count(), kSpheresPerInstance);
  }
  use.added += parts;
  return may_be && use.added >= contents.count() + kSpheresPerPrototype;
}

std::optional<std::uint32_t> GroupRepeats::make_prototype(
    const GroupContents& contents, const std::optional<render::Material>& material,
    MaterialTable& materials) {
  Placing own;
  own.material = material;
  PlacedSpheres placed;
  if (!add_spheres(contents, own, placed, materials)) return std::nullopt;
  if (!placed.shifts.empty()) placed.shifts.resize(placed.spheres.size());
  render::Prototype prototype{.spheres = std::move(placed.spheres),
                              .shifts = std::move(placed.shifts)};
  render::remove_coincident(render::find_coincident(prototype.spheres, prototype.shifts),
                            prototype.spheres,
                            prototype.shifts);  // reported at the first occurrence
  prototype.spheres.shrink_to_fit();
  prototype.shifts.shrink_to_fit();
  const auto smallest = std::ranges::min_element(prototype.spheres, {}, &render::Sphere::radius);
  reaches_.push_back(
      {.bounding_sphere = render::bounding_sphere(prototype), .smallest_radius = smallest->radius});
  prototype_spheres_ += prototype.spheres.size();
  prototype_slots_ += slots_of(prototype.spheres.size());
  prototypes_.push_back(std::move(prototype));
  return static_cast<std::uint32_t>(prototypes_.size() - 1);
}

bool GroupRepeats::add_instance(const GroupContents& contents, std::uint32_t prototype,
                                const Placing& placing, const World& world) {
  if (objects_in(world) + kSpheresPerInstance > world.max_objects) return false;
  const auto& [opening, closing] = placing.placements;
  const render::Instance instance{
      .prototype = prototype, .placement = opening, .shift = closing.translate - opening.translate};
  const auto& [bounds, smallest_radius] = reaches_[prototype];
  const double radius = bounds.radius * opening.scale;
  const bool is_in_range = render::is_finite(opening.apply(bounds.center)) &&
                           std::isfinite(2 * radius) && smallest_radius * opening.scale > 0 &&
                           render::is_finite(instance.shift);
  if (!is_in_range) return false;
  instances_.push_back(instance);
  skip(contents.count(), world);
  return true;
}

void GroupRepeats::skip(std::uint64_t spheres, const World& world) {
  const std::size_t before = world.spheres.spheres.size();
  if (!runs_.empty() && runs_.back().before == before) {
    runs_.back().count += spheres;
  } else {
    runs_.push_back({.before = before, .count = spheres});
  }
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
