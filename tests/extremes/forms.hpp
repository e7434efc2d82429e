#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/exactness/precision.hpp"
#include "render/scene/settings.hpp"
#include "render/session/render.hpp"

/// All kernels, precisions and instruction sets that this machine can run.
namespace sdlc::test {

struct Form {
  render::Search search = render::Search::Bvh;
  render::Precision precision = render::Precision::Double;
  const render::Backend* backend = &render::portable_backend();

  bool is_scalar() const { return backend == &render::portable_backend(); }
  render::KernelRequest request() const {
    return {.search = search, .precision = precision, .backend = backend};
  }
};

inline std::vector<Form> all_forms() {
  std::vector<Form> forms{Form{}};
  for (const render::Backend* backend : render::available_vectors()) {
    for (const auto search : {render::Search::All, render::Search::Bvh}) {
      for (const auto precision : {render::Precision::Float, render::Precision::Double}) {
        forms.push_back({search, precision, backend});
      }
    }
  }
  return forms;
}

inline std::string name_of(const Form& form) {
  if (form.is_scalar()) return "scalar";
  return (form.search == render::Search::All ? "wide_" : "bvh_") + std::string(form.backend->name) +
         "_" + std::string(name_of(form.precision));
}

inline std::string form_name(const testing::TestParamInfo<Form>& test) {
  return name_of(test.param);
}

/// Whether the form can trace the scene: the wide kernel supports it, and float, or float with a
/// few spheres in double, resolves it.
inline bool may_trace(const Form& form, const render::Scene& scene,
                      const render::RenderSettings& settings) {
  if (choose_kernel(scene, settings, form.request()).refusal) return false;
  return form.precision == render::Precision::Double ||
         judge_float(scene, scene.camera, settings).is_accepted;
}

inline render::RenderResult render_in(const Form& form, const render::Scene& scene,
                                      const render::RenderSettings& settings) {
  render::RenderMonitor monitor;
  return render::render(scene, settings, monitor, form.request());
}

}  // namespace sdlc::test
