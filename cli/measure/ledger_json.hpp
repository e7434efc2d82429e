#pragma once

#include "cli/measure/json.hpp"
#include "render/measure/study.hpp"

/// The results of a study as JSON, with exact numbers.
namespace sdlc::cli {

SDLC_MEMBERS(render::StudyTask, kind, configuration, samples, round)
SDLC_MEMBERS(render::ConfigurationCost, configuration, build_seconds, seconds_per_sample,
             seconds_per_pixel, refusal)
SDLC_MEMBERS(render::StudyPlan, width, height, costs, reference_configuration, reference_samples,
             depths, probe_samples, thread_counts, tasks)
SDLC_MEMBERS(render::DepthProbe, depth, round, mean, seconds, cut_paths)
SDLC_MEMBERS(render::PrecisionProbe, round, mean, other_mean, rms_difference, seconds,
             other_seconds)
SDLC_MEMBERS(render::ThreadProbe, threads, round, seconds, is_same)
SDLC_MEMBERS(render::StudyLedger, plan, reference, points, depths, precisions, threads,
             precision_bound, light_choice, other_seconds, spent_seconds, finished_budget_seconds,
             nonfinite_samples)

}  // namespace sdlc::cli
