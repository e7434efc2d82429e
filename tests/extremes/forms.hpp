#pragma once

#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "render/scene/precision.hpp"
#include "render/tiles/render.hpp"

/// All kernels, precisions and instruction sets that this machine can run.
namespace sdlc::test {

struct Form {
  render::KernelKind kind = render::KernelKind::Scalar;
  render::Precision precision = render::Precision::Double;
  std::optional<render::Isa> isa{};

  render::KernelRequest request() const {
    if (kind == render::KernelKind::Scalar) return {.kind = kind};
    return {.kind = kind, .precision = precision, .isa = isa};
  }
};

inline std::vector<Form> all_forms() {
  std::vector<Form> forms{Form{}};
  for (const render::Isa isa : render::available_isas()) {
    for (const auto kind : {render::KernelKind::Wide, render::KernelKind::Bvh}) {
      for (const auto precision : {render::Precision::Float, render::Precision::Double}) {
        forms.push_back({kind, precision, isa});
      }
    }
  }
  return forms;
}

inline std::string name_of(const Form& form) {
  if (form.kind == render::KernelKind::Scalar) return "scalar";
  return std::string(name_of(form.kind)) + "_" + std::string(name_of(*form.isa)) + "_" +
         std::string(name_of(form.precision));
}

inline std::string form_name(const testing::TestParamInfo<Form>& test) {
  return name_of(test.param);
}

/// Whether the form can trace the scene: the wide kernel supports it, and float, or float with a
/// few spheres in double, resolves it.
inline bool may_trace(const Form& form, const render::Scene& scene,
                      const render::RenderSettings& settings) {
  if (!choose_kernel(scene, settings, form.request()).refusal.empty()) return false;
  return form.precision == render::Precision::Double ||
         judge_float(scene, scene.camera, settings).is_accepted;
}

inline render::RenderResult render_in(const Form& form, const render::Scene& scene,
                                      const render::RenderSettings& settings) {
  render::RenderMonitor monitor;
  return render::render(scene, settings, monitor, form.request());
}

}  // namespace sdlc::test
