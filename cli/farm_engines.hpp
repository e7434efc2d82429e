#pragma once

#include <string>
#include <vector>

#include "cli/farm_job.hpp"

/// Job files for existing engines. The engines hand out numbers of tasks from 0; RUN.tasks has the
/// frames and the shard of each in a line, so that no job file depends on how tasks are divided.
namespace sdlc::cli {

struct FarmFile {
  std::string name;  ///< in the folder of the job
  std::string content;
  bool is_program = false;
};

/// What the engine of the job needs to run these tasks and to merge their films.
std::vector<FarmFile> farm_files(const FarmJob& job, const FarmRun& run);
/// How a user starts them.
std::string start_command(const FarmJob& job, const FarmRun& run);

// One function per engine, in farm_NAME.cpp.
std::vector<FarmFile> slurm_files(const FarmJob& job, const FarmRun& run);
std::vector<FarmFile> openjd_files(const FarmJob& job, const FarmRun& run);
std::vector<FarmFile> kubernetes_files(const FarmJob& job, const FarmRun& run);
std::vector<FarmFile> shell_files(const FarmJob& job, const FarmRun& run);

/// RUN.tasks: `1-5` for whole pictures, `12 3` for shard 3 of frame 12, `-` for no frame.
FarmFile task_list(const FarmRun& run);
/// task.sh, which runs some tasks of a list and repeats those that failed for a passing reason.
FarmFile task_script(const FarmJob& job);
/// merge.sh, which merges the parts of each picture in pictures.txt; none without shards.
std::vector<FarmFile> merge_scripts(const FarmJob& job);

/// The name of the job for engines: letters, digits and -, at most 40.
std::string engine_name(const FarmJob& job);
/// The arguments of `render` after the scene, without its frames, shard and output.
std::vector<std::string> render_flags(const FarmJob& job);

/// The beginning of a script: it works in its own folder.
inline constexpr const char* kScriptStart =
    "#!/bin/sh\n"
    "# Written by `sdlc farm`.\n"
    "case $0 in */*) cd -- \"${0%/*}\" || exit 2 ;; esac\n";

}  // namespace sdlc::cli
