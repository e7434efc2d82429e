#include "lang/lower/group_contents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sdlc::lang {

Placing Placing::around(const Placing& inner) const {
  return {.placements = {placements[0].around(inner.placements[0]),
                         placements[1].around(inner.placements[1])},
          .is_moving = is_moving || inner.is_moving,
          .material = inner.material ? inner.material : material};
}

bool Placing::keeps_shape() const noexcept {
  const auto& [opening, closing] = placements;
  return opening.x == closing.x && opening.y == closing.y && opening.z == closing.z;
}

void PlacedSpheres::add(const render::Sphere& sphere, render::Vec3 shift) {
  if (shift != render::Vec3{} || !shifts.empty()) {
    shifts.resize(spheres.size());
    shifts.push_back(shift);
  }
  spheres.push_back(sphere);
}

void PlacedSpheres::shrink_to(std::size_t count) {
  spheres.resize(std::min(count, spheres.size()));
  shifts.resize(std::min(count, shifts.size()));
}

bool InnerSphere::add_to(PlacedSpheres& to, const Placing& placing,
                         std::uint32_t material_there) const {
  const auto& [at_opening, at_closing] = placing.placements;
  const render::Sphere sphere{.center = at_opening.apply(center),
                              .radius = radius * at_opening.scale,
                              .material = material_there};
  render::Vec3 shift;
  if (is_moving || placing.is_moving) shift = at_closing.apply(closing) - sphere.center;
  if (!is_finite(sphere.center) || !is_finite(shift)) return false;
  if (!(sphere.radius > 0) || !std::isfinite(sphere.radius)) return false;
  to.add(sphere, shift);
  return true;
}

std::uint32_t GroupContents::add_group(std::uint32_t parent, Placing placing) {
  groups_.push_back({.parent = parent, .placing = std::move(placing)});
  return static_cast<std::uint32_t>(groups_.size());
}

void GroupContents::remove_groups_from(std::uint32_t group) { groups_.resize(group - 1); }

void GroupContents::add_sphere(std::uint32_t group, const InnerSphere& sphere) {
  spheres_.push_back(sphere);
  group_of_.push_back(group);
  inherits_ = inherits_ || (!sphere.material && inherits_through(group));
  if (count_ != std::numeric_limits<std::uint64_t>::max()) ++count_;
}

void GroupContents::add_reference(std::uint32_t group, std::uint32_t number,
                                  const GroupContents& contents) {
  references_.push_back({.group = group, .contents = number, .before = spheres_.size()});
  inherits_ = inherits_ || (contents.inherits_ && inherits_through(group));
  const std::uint64_t room = std::numeric_limits<std::uint64_t>::max() - count_;
  count_ += std::min(room, contents.count_);
}

/// Whether neither `group` nor a group around it has a material.
bool GroupContents::inherits_through(std::uint32_t group) const noexcept {
  for (; group != 0; group = groups_[group - 1].parent) {
    if (groups_[group - 1].placing.material) return false;
  }
  return true;
}

}  // namespace sdlc::lang
