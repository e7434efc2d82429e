#include "lang/resolve/scopes.hpp"

#include <algorithm>

namespace sdlc::lang {

std::optional<std::uint32_t> Scopes::find(std::string_view name) const {
  if (locals_.size() > kMaxLinear) {
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) return found->second;
  }
  for (std::size_t i = std::min(locals_.size(), kMaxLinear); i > 0; --i) {
    if (locals_[i - 1].name == name) return static_cast<std::uint32_t>(i - 1);
  }
  return std::nullopt;
}

std::uint32_t Scopes::declare(std::string_view name) {
  const auto index = static_cast<std::uint32_t>(locals_.size());
  std::uint32_t hidden = kNone;
  if (index >= kMaxLinear) {
    const auto [known, is_new] = by_name_.try_emplace(name, index);
    if (!is_new) hidden = std::exchange(known->second, index);
  }
  const std::uint32_t next = index == frame_begin_ ? 0 : locals_.back().slot + 1;
  const std::uint32_t slot = std::max(next, reserved_);
  locals_.push_back({.name = name, .frame = frame_, .slot = slot, .hidden = hidden});
  frame_size_ = std::max(frame_size_, slot + 1);
  return index;
}

void Scopes::leave(std::size_t size) {
  for (; locals_.size() > size; locals_.pop_back()) {
    if (locals_.size() <= kMaxLinear) continue;
    const Local& last = locals_.back();
    if (last.hidden == kNone) {
      by_name_.erase(last.name);
    } else {
      by_name_[last.name] = last.hidden;
    }
  }
}

}  // namespace sdlc::lang
