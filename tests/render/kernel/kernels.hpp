#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/scene/settings.hpp"
#include "render/session/render.hpp"

/// The wide kernel in all configurations that this machine can run.
namespace sdlc::test {

struct WideForm {
  const render::Backend* backend;
  render::Precision precision;

  render::KernelRequest request() const {
    return {.search = render::Search::All, .precision = precision, .backend = backend};
  }
};

inline std::vector<WideForm> wide_forms() {
  std::vector<WideForm> forms;
  for (const render::Backend* backend : render::available_vectors()) {
    forms.push_back({backend, render::Precision::Float});
    forms.push_back({backend, render::Precision::Double});
  }
  return forms;
}

/// The backends that this machine can run and that round as the best one does.
inline std::vector<const render::Backend*> equal_backends() {
  std::vector<const render::Backend*> equal;
  for (const render::Backend* backend : render::available_vectors()) {
    if (backend->is_fused == render::best_backend().is_fused) equal.push_back(backend);
  }
  return equal;
}

inline std::string form_name(const testing::TestParamInfo<WideForm>& test) {
  return std::string(test.param.backend->name) + "_" + std::string(name_of(test.param.precision));
}

inline render::RenderResult render_with(const render::Scene& scene,
                                        const render::RenderSettings& settings,
                                        const render::KernelRequest& request) {
  render::RenderMonitor monitor;
  return render::render(scene, settings, monitor, request);
}

}  // namespace sdlc::test
