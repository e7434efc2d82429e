#include "render/scene/choices.hpp"

namespace sdlc::render {

std::string_view name_of(SamplerKind sampler) noexcept {
  switch (sampler) {
    case SamplerKind::Sobol: return "sobol";
    case SamplerKind::Independent: return "independent";
  }
  return "";
}

std::string_view name_of(LightSampling lights) noexcept {
  switch (lights) {
    case LightSampling::Auto: return "auto";
    case LightSampling::On: return "on";
    case LightSampling::Off: return "off";
  }
  return "";
}

}  // namespace sdlc::render
