#include "render/light/emitter_tally.hpp"

#include "render/light/choose_lights.hpp"

namespace sdlc::render {

EmitterTally::EmitterTally(const Scene& scene) {
  const std::vector<std::uint32_t> emitters = choose_lights(scene, LightSampling::On);
  if (emitters.empty()) return;
  paths_ = std::vector<std::atomic<std::uint8_t>>(scene.spheres.size());
  for (auto& paths : paths_) paths.store(kEnough, std::memory_order_relaxed);
  for (const std::uint32_t i : emitters) paths_[i].store(0, std::memory_order_relaxed);
  scarce_ = emitters.size();
}

std::vector<ReachedEmitter> EmitterTally::scarce() const {
  std::vector<ReachedEmitter> emitters;
  if (!is_counting()) return emitters;
  for (std::uint32_t i = 0; i < paths_.size(); ++i) {
    const std::uint8_t paths = paths_[i].load(std::memory_order_relaxed);
    if (paths < kEnough) emitters.push_back({.sphere = i, .paths = paths});
  }
  return emitters;
}

}  // namespace sdlc::render
