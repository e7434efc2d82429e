#include "lang/lower/named_spheres.hpp"

#include <algorithm>
#include <utility>

#include "lang/schema/schema.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {

render::Vec3 NamedSphere::opening(const std::optional<render::Interval>& shutter) const {
  const bool is_moving = motion && shutter;
  return groups.apply(is_moving ? center_at(*motion, *center, shutter->from) : *center);
}

void NamedSpheres::want(const Object& camera) {
  const auto name = camera.get<Word>(camera_property::kFocus);
  if (name) wanted_.try_emplace(name->text);
}

void NamedSpheres::add(const Object& sphere, const render::Placement& groups) {
  if (sphere.name.empty()) return;
  using namespace sphere_property;
  add(sphere.name, {.where = sphere.where,
                    .center = sphere.get<render::Vec3>(kCenter),
                    .motion = sphere.get<MotionValue>(kMotion),
                    .groups = groups});
}

void NamedSpheres::add(std::string_view name, NamedSphere sphere) {
  const auto wanted = wanted_.find(name);
  if (wanted == wanted_.end()) {
    if (others_.size() < kMaxOthers) others_.emplace(name);
    return;
  }
  Found& found = wanted->second;
  ++found.count;
  // A loop places many at one place of the text.
  const bool is_known = std::ranges::any_of(found.spheres, [&](const NamedSphere& other) {
    return other.where.file == sphere.where.file && other.where.span == sphere.where.span;
  });
  if (!is_known && found.spheres.size() < kMaxShown) found.spheres.push_back(std::move(sphere));
  for (const std::uint32_t contents : contents_) {
    if (contents != kNoContents) names_in_contents_[contents].emplace(name);
  }
}

void NamedSpheres::repeat(const Object& group, std::uint32_t contents) {
  const auto names = names_in_contents_.find(contents);
  if (names == names_in_contents_.end()) return;
  const auto known = names->second;  // add() may insert
  for (const std::string& name : known) add(name, {.where = group.where});
}

const NamedSpheres::Found& NamedSpheres::find(std::string_view name) const {
  static const Found kNone;
  const auto found = wanted_.find(name);
  return found == wanted_.end() ? kNone : found->second;
}

std::optional<std::string> NamedSpheres::nearest(std::string_view name) const {
  std::vector<std::string_view> names(others_.begin(), others_.end());
  for (const auto& [wanted, found] : wanted_) {
    if (found.count > 0) names.push_back(wanted);
  }
  const auto nearest = nearest_name(name, names);
  return nearest ? std::optional<std::string>(*nearest) : std::nullopt;
}

}  // namespace sdlc::lang
