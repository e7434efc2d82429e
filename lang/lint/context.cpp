#include "lang/lint/context.hpp"

#include <algorithm>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

std::span<const std::uint32_t> LintContext::occluders() {
  if (occluders_) return *occluders_;
  occluders_.emplace();
  const auto& cameras = lowered_.checked_cameras;
  if (is_part() || cameras.size() > kMaxCameras) return *occluders_;
  for (std::uint32_t i = 0; i < spheres().size(); ++i) {
    stop_if_requested();
    const bool may_contain_camera = std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return may_be_inside(*this, camera.camera.from, i);
    });
    if (!is_transmissive(i) && !may_contain_camera) occluders_->push_back(i);
  }
  return *occluders_;
}

std::span<const LintContext::HiddenSphere> LintContext::hidden() {
  if (hidden_) return *hidden_;
  hidden_.emplace();
  is_hidden_.resize(spheres().size());
  SphereTree tree(*this, occluders());
  std::vector<std::uint32_t> order = tree.spheres();
  std::vector<bool> is_in_tree(spheres().size());
  for (const std::uint32_t i : order) is_in_tree[i] = true;
  for (std::uint32_t i = 0; i < is_in_tree.size(); ++i) {
    if (!is_in_tree[i]) order.push_back(i);
  }
  for (const std::uint32_t i : order) {
    stop_if_requested();
    const auto container = tree.find_container(i);
    if (!container) continue;
    hidden_->push_back({.sphere = i, .container = *container});
    is_hidden_[i] = true;
  }
  return *hidden_;
}

bool LintContext::is_hidden(std::uint32_t sphere) {
  hidden();
  return is_hidden_[sphere];
}

std::vector<std::uint32_t> LintContext::spheres_of_materials() {
  std::vector<bool> is_seen(scene().materials.size());
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < spheres().size(); ++i) {
    if (is_seen[spheres()[i].material] || is_hidden(i)) continue;
    is_seen[spheres()[i].material] = true;
    first.push_back(i);
  }
  return first;
}

std::vector<std::uint32_t> LintContext::visible_transmissive() {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < spheres().size(); ++i) {
    if (is_transmissive(i) && !is_hidden(i)) found.push_back(i);
  }
  return found;
}

SphereOrigins::SphereOrigins(LintContext& context, std::vector<std::uint32_t> spheres)
    : spheres_(std::move(spheres)) {
  std::ranges::sort(spheres_);
  spheres_.erase(std::unique(spheres_.begin(), spheres_.end()), spheres_.end());
  if (!spheres_.empty()) origins_ = context.trace(spheres_);
}

const Origin& SphereOrigins::of(std::uint32_t sphere) const {
  const auto found = std::ranges::lower_bound(spheres_, sphere);
  return origins_[static_cast<std::size_t>(found - spheres_.begin())];
}

}  // namespace sdlc::lang
