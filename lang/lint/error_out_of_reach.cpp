#include <algorithm>

#include <fmt/format.h>

#include "lang/lint/context.hpp"
#include "render/session/error_goal.hpp"
#include "render/session/render.hpp"

namespace sdlc::lang {
namespace {

/// Preparing larger scenes would take longer than all other rules together.
constexpr std::size_t kMaxSpheres = 100'000;
constexpr int kTrialWidth = 64, kTrialSamples = 32, kTrialDepth = 64;

/// Settings of the trial render.
render::RenderSettings trial_of(const render::RenderSettings& asked, double aspect) {
  render::RenderSettings trial = asked;
  trial.width = kTrialWidth;
  trial.height = std::clamp(static_cast<int>(kTrialWidth / aspect), 1, kTrialWidth);
  trial.samples = std::min(asked.samples, kTrialSamples);
  trial.depth = std::min(asked.depth, kTrialDepth);
  trial.error.reset();
  trial.seconds.reset();
  return trial;
}

}  // namespace

/// The samples are too few for the requested error: a trial render, a small picture with few
/// samples, predicts a larger error even at the fastest possible convergence. The trial may miss
/// rare light and underestimate the noise. It overestimates noise only at edges, which take a
/// larger share of a small picture; the factor kMargin allows for that.
void check_error_out_of_reach(LintContext& context) {
  const LoweredScene& lowered = context.lowered();
  const render::RenderSettings& asked = lowered.settings;
  if (!asked.error || lowered.checked_cameras.empty() || asked.samples == render::kMaxSamples) {
    return;
  }
  if (context.spheres().size() > kMaxSpheres || !context.scene().instances.empty()) return;
  render::Scene scene = context.scene();
  scene.camera = lowered.checked_cameras.front().camera;
  const render::RenderSettings trial = trial_of(asked, scene.camera.aspect);
  render::RenderMonitor monitor;
  const std::stop_callback cancel(context.stop_token(), [&] { monitor.cancel = true; });
  render::KernelRequest request{.precision = lowered.precision};
  request.may_take_double = true;
  const render::RenderResult result = render::render(std::move(scene), trial, monitor, request);
  context.stop_if_requested();
  if (!result.error) return;

  constexpr double kMargin = 2;
  const double more = static_cast<double>(asked.samples) / trial.samples;
  const double at_best = render::min_error(result.error->interval.from, more);
  if (at_best <= kMargin * *asked.error) return;
  const double needed =
      trial.samples * render::usual_growth(*asked.error / result.error->relative_error);
  const bool is_written = lowered.places.samples.file != nullptr;
  Finding& finding =
      context.add(diag::error_out_of_reach,
                  LintPlace::of(is_written ? lowered.places.samples : lowered.places.error),
                  fmt::format("{}", asked.samples), fmt::format("{:.2g}%", 100 * at_best),
                  fmt::format("{:.6g}%", 100 * *asked.error));
  finding.help.push_back(
      fmt::format("a small trial render predicts that about {:.0f} samples are needed", needed));
}

}  // namespace sdlc::lang
