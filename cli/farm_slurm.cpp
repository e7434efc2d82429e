#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/farm_engines.hpp"

namespace sdlc::cli {
namespace {

/// Slurm's default MaxArraySize, 1001, allows the indices 0 to 1000.
constexpr std::size_t kMaxArrayTasks = 1000;

std::string sbatch_header(const FarmJob& job, const std::string& log) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Written by `sdlc farm`; submit it in its folder, as submit.sh does.\n"
      "#SBATCH --job-name={}\n"
      "#SBATCH --output=log/{}.txt\n"
      "#SBATCH --open-mode=append\n"
      "#SBATCH --requeue\n",
      engine_name(job), log);
}

/// The script becomes task.sh, so that a signal of scancel or preemption reaches it.
FarmFile array_script(const FarmJob& job, const FarmRun& run) {
  const std::size_t tasks = run.tasks.size();
  const std::size_t per_index = (tasks + kMaxArrayTasks - 1) / kMaxArrayTasks;
  const std::size_t indices = (tasks + per_index - 1) / per_index;
  std::string text = sbatch_header(job, "%x-%A_%a");
  text += fmt::format("#SBATCH --array=0-{}\n", indices - 1);
  const auto threads = std::ranges::find(job.flags, "--threads");
  if (threads != job.flags.end() && *(threads + 1) != "0") {
    text += fmt::format("#SBATCH --cpus-per-task={}\n", *(threads + 1));
  }
  text += fmt::format(
      "tasks={} per_index={}\n"
      "first=$((SLURM_ARRAY_TASK_ID * per_index))\n"
      "last=$((first + per_index - 1))\n"
      "[ \"$last\" -lt \"$tasks\" ] || last=$((tasks - 1))\n"
      "exec ./task.sh {}.tasks \"$first\" \"$last\"\n",
      tasks, per_index, run.name);
  return {.name = run.name + ".sbatch", .content = std::move(text), .is_program = true};
}

FarmFile submit_script(const FarmJob& job, const FarmRun& run, const std::string& name) {
  std::string text = kScriptStart;
  text += fmt::format("# Submits the job; arguments go to sbatch: {} --partition=short\n\n", name);
  if (!run.tasks.empty()) {
    text += fmt::format(
        "render=$(sbatch --parsable \"$@\" {}.sbatch) || exit\n"
        "render=${{render%%;*}}\n"
        "echo \"render: job $render\"\n",
        run.name);
  }
  if (job.has_shards()) {
    // afterok would cancel the merge after a task that succeeded when it was requeued.
    const char* after = run.tasks.empty() ? "" : " --dependency=afterany:\"$render\"";
    text += fmt::format(
        "merge=$(sbatch --parsable{} \"$@\" merge.sbatch) || exit\n"
        "echo \"merge: job ${{merge%%;*}}\"\n",
        after);
  }
  text += "echo 'sdlc farm status shows what is there'\n";
  return {.name = name, .content = std::move(text), .is_program = true};
}

}  // namespace

std::vector<FarmFile> slurm_files(const FarmJob& job, const FarmRun& run) {
  std::vector<FarmFile> files{task_script(job)};
  for (FarmFile& file : merge_scripts(job)) files.push_back(std::move(file));
  if (!run.tasks.empty()) {
    files.push_back(task_list(run));
    files.push_back(array_script(job, run));
  }
  if (job.has_shards()) {
    files.push_back({.name = "merge.sbatch",
                     .content = sbatch_header(job, "%x-merge-%j") + "exec ./merge.sh\n",
                     .is_program = true});
  }
  files.push_back(submit_script(job, run, run.name == "render" ? "submit.sh" : run.name + ".sh"));
  return files;
}

}  // namespace sdlc::cli
