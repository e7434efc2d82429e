#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/tiles/render.hpp"

/// The wide kernel in all configurations that this machine can run.
namespace sdlc::test {

struct WideForm {
  render::Isa isa;
  render::Precision precision;

  render::KernelRequest request() const {
    return {.kind = render::KernelKind::Wide, .precision = precision, .isa = isa};
  }
};

inline std::vector<WideForm> wide_forms() {
  std::vector<WideForm> forms;
  for (const render::Isa isa : render::available_isas()) {
    forms.push_back({isa, render::Precision::Float});
    forms.push_back({isa, render::Precision::Double});
  }
  return forms;
}

inline std::string form_name(const testing::TestParamInfo<WideForm>& test) {
  return std::string(name_of(test.param.isa)) + "_" + std::string(name_of(test.param.precision));
}

inline render::RenderResult render_with(const render::Scene& scene,
                                        const render::RenderSettings& settings,
                                        const render::KernelRequest& request) {
  render::RenderMonitor monitor;
  return render::render(scene, settings, monitor, request);
}

}  // namespace sdlc::test
