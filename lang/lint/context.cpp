#include "lang/lint/context.hpp"

#include <algorithm>

#include "lang/lint/sphere_tree.hpp"

namespace sdlc::lang {

std::span<const std::uint32_t> LintContext::closed() {
  if (closed_) return *closed_;
  closed_.emplace();
  const auto& cameras = lowered_.checked_cameras;
  if (is_part() || cameras.size() > kMostCameras) return *closed_;
  for (std::uint32_t i = 0; i < spheres().size(); ++i) {
    stop_if_requested();
    const bool is_open = std::ranges::any_of(cameras, [&](const CheckedCamera& camera) {
      return may_be_inside(*this, camera.camera.from, i);
    });
    if (!is_transmissive(i) && !is_open) closed_->push_back(i);
  }
  return *closed_;
}

std::span<const LintContext::HiddenSphere> LintContext::hidden() {
  if (hidden_) return *hidden_;
  hidden_.emplace();
  is_hidden_.resize(spheres().size());
  SphereTree tree(*this, closed());
  std::vector<std::uint32_t> order = tree.members();
  std::vector<bool> is_member(spheres().size());
  for (const std::uint32_t member : order) is_member[member] = true;
  for (std::uint32_t i = 0; i < is_member.size(); ++i) {
    if (!is_member[i]) order.push_back(i);
  }
  for (const std::uint32_t i : order) {
    stop_if_requested();
    const auto around = tree.find_around(i);
    if (!around) continue;
    hidden_->push_back({.sphere = i, .around = *around});
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

}  // namespace sdlc::lang
