#pragma once

#include <optional>
#include <string>

#include "cli/farm_job.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "render/kernel/kernel.hpp"

/// Divides the work of a farm into tasks.
namespace sdlc::cli {

/// The cost of a picture, as measured.
struct FarmProbe {
  double picture_seconds = 0;
  std::string description;  ///< "measured 1.2 M samples/s: 38 s per frame"
};

/// Renders for two seconds. `compile_seconds`: for reading the scene. Moves kernel and scene away.
FarmProbe probe(render::Kernel kernel, lang::LoweredScene& lowered, double compile_seconds,
                bool has_frames);

/// The largest number of shards of a picture; 0 if it cannot be divided.
std::uint32_t max_farm_shards(const render::RenderSettings& settings);

/// Sets frames_per_task and shards such that a task takes about job.task_seconds.
void divide(FarmJob& job, const FarmProbe& probe, std::uint32_t max_shards);
/// The same for about this number of tasks.
void divide_into(FarmJob& job, std::size_t tasks, std::uint32_t max_shards);

/// Throws UsageError if the job has more than kMaxFarmTasks.
void check_task_count(const FarmJob& job);

/// "12 tasks of 8 frames", "8 tasks, the shards of the picture".
std::string describe_division(const FarmJob& job);

}  // namespace sdlc::cli
