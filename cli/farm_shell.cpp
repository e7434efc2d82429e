#include <fmt/format.h>

#include "cli/farm_engines.hpp"

namespace sdlc::cli {
namespace {

/// xargs ends at status 255; otherwise an interrupted task would be followed by the next one. After
/// Ctrl-C it does not wait for tasks that save their films, but `cat` does.
/// --termseq: the renderer needs time to save its film.
constexpr const char* kRunAll = R"sh(
jobs=${JOBS:-1}
SDLC_FAILED=$list.failed
export SDLC_FAILED
rm -f "$SDLC_FAILED"
if parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  seq 0 $((tasks - 1)) |
    parallel --will-cite --jobs "$jobs" --line-buffer --termseq TERM,60000,KILL,25 \
      ./task.sh "$list" '{}'
else
  seq 0 $((tasks - 1)) |
    xargs -n 1 -P "$jobs" sh -c './task.sh "$0" "$1"; s=$?; [ $s -ne 130 ] || s=255; exit $s' "$list" |
    (trap '' INT && exec cat)
fi
)sh";

}  // namespace

std::vector<FarmFile> shell_files(const FarmJob& job, const FarmRun& run) {
  std::string text = kScriptStart;
  text +=
      "# Renders on this machine, JOBS tasks at a time (1: a task uses all processors unless\n"
      "# --threads was given). Run it again to go on: what is finished is not rendered again.\n"
      "trap 'exit 130' INT\n\n";
  if (!run.tasks.empty()) {
    text += fmt::format("tasks={} list={}.tasks{}", run.tasks.size(), run.name, kRunAll);
  }
  if (job.has_shards()) text += "./merge.sh\nmerged=$?\n";
  text +=
      "\"${SDLC:-sdlc}\" farm status .\n"
      "code=$?\n"
      "# Of what would fail again:\n";
  if (job.has_shards()) text += "case $merged in 0 | 75) ;; *) code=$merged ;; esac\n";
  if (!run.tasks.empty()) {
    text += "[ ! -e \"$SDLC_FAILED\" ] || code=$(sort -n \"$SDLC_FAILED\" | tail -n 1)\n";
  }
  text += "exit \"$code\"\n";
  std::vector<FarmFile> files{task_script(job)};
  for (FarmFile& file : merge_scripts(job)) files.push_back(std::move(file));
  files.push_back(task_list(run));
  files.push_back({.name = run.name + ".sh", .content = std::move(text), .is_program = true});
  return files;
}

}  // namespace sdlc::cli
