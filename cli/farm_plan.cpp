#include "cli/farm_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "cli/numbers/format_numbers.hpp"
#include "cli/usage_error.hpp"
#include "render/session/render.hpp"
#include "render/session/shards.hpp"

namespace sdlc::cli {
namespace {

constexpr double kProbeSeconds = 2;

/// The samples per pixel that a picture will have. `measured` has fewer: its error falls with the
/// root of their number.
double expected_samples(const render::RenderSettings& settings,
                        const render::RenderResult& measured) {
  const auto limit = static_cast<double>(settings.samples);
  if (!settings.error || !measured.error) return limit;
  const double ratio = measured.error->relative_error / *settings.error;
  const auto pixels = static_cast<double>(measured.picture.pixels.size());
  return std::min(limit, static_cast<double>(measured.camera_samples) / pixels * ratio * ratio);
}

std::uint32_t rounded_up(double count, std::uint32_t max) {
  return static_cast<std::uint32_t>(std::clamp(std::ceil(count), 1.0, static_cast<double>(max)));
}

}  // namespace

FarmProbe probe(render::Kernel kernel, lang::LoweredScene& lowered, double compile_seconds,
                bool has_frames) {
  const render::RenderSettings& wanted = lowered.settings;
  render::RenderSettings settings = wanted;
  settings.error.reset();
  settings.seconds = kProbeSeconds;
  settings.is_adaptive = settings.is_denoised = false;
  render::RenderMonitor monitor;
  const render::RenderResult result =
      render::render(std::move(kernel), std::move(lowered.scene), settings, monitor);
  const double rate = static_cast<double>(result.new_samples) / result.render_seconds;
  const double pixels = static_cast<double>(wanted.width) * wanted.height;
  const double tracing =
      wanted.seconds ? *wanted.seconds : expected_samples(wanted, result) * pixels / rate;
  FarmProbe probe;
  probe.picture_seconds = compile_seconds + result.build_seconds + tracing;
  probe.description =
      fmt::format("measured {} samples/s on this machine: {}{}", format_count(rate),
                  format_seconds(probe.picture_seconds), has_frames ? " per frame" : "");
  return probe;
}

std::uint32_t max_farm_shards(const render::RenderSettings& settings) {
  // Both decide on the whole picture.
  if (settings.has_goal() || settings.is_denoised) return 0;
  constexpr std::uint64_t kMax = 4000;  // `merge` has all of them as arguments
  return static_cast<std::uint32_t>(
      std::min(kMax, std::max(max_shards(settings, render::ShardCut::Samples),
                              max_shards(settings, render::ShardCut::Tiles))));
}

void divide(FarmJob& job, const FarmProbe& probe, std::uint32_t max_shards) {
  const double tasks_per_picture = probe.picture_seconds / job.task_seconds;
  if (max_shards > 0 && (job.frames.empty() || tasks_per_picture > 1)) {
    job.shards = rounded_up(tasks_per_picture, max_shards);
    return;
  }
  const double per_task = std::floor(1 / tasks_per_picture);
  job.frames_per_task = static_cast<std::size_t>(
      std::clamp(per_task, 1.0, std::max(1.0, static_cast<double>(job.frames.size()))));
}

void divide_into(FarmJob& job, std::size_t tasks, std::uint32_t max_shards) {
  const std::size_t pictures = std::max<std::size_t>(job.frames.size(), 1);
  if (max_shards > 0 && (job.frames.empty() || tasks >= 2 * pictures)) {
    job.shards =
        static_cast<std::uint32_t>(std::clamp<std::size_t>(tasks / pictures, 1, max_shards));
    return;
  }
  job.frames_per_task = (pictures + tasks - 1) / std::min(tasks, pictures);
}

void check_task_count(const FarmJob& job) {
  const std::size_t pictures = std::max<std::size_t>(job.frames.size(), 1);
  const std::size_t tasks = job.has_shards()
                                ? pictures * job.shards
                                : (pictures + job.frames_per_task - 1) / job.frames_per_task;
  if (tasks <= kMaxFarmTasks) return;
  throw UsageError(
      fmt::format("{} tasks are more than {}; give a longer --task-time or fewer --tasks", tasks,
                  kMaxFarmTasks));
}

std::string describe_division(const FarmJob& job) {
  const std::size_t pictures = std::max<std::size_t>(job.frames.size(), 1);
  const auto plural = [](std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
  };
  if (job.has_shards()) {
    return fmt::format(
        "{}: {} of {}, then a merge", plural(pictures * job.shards, "task"),
        plural(job.shards, "shard"),
        job.frames.empty() ? "the picture" : fmt::format("each of {}", plural(pictures, "frame")));
  }
  if (job.frames.empty()) return "1 task: --error, --time and --denoise need the whole picture";
  const std::size_t tasks = (pictures + job.frames_per_task - 1) / job.frames_per_task;
  return fmt::format("{} of {}", plural(tasks, "task"), plural(job.frames_per_task, "frame"));
}

}  // namespace sdlc::cli
