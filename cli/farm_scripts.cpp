#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

#include "cli/farm_engines.hpp"
#include "cli/frames.hpp"
#include "cli/shell_quote.hpp"

namespace sdlc::cli {
namespace {

/// Runs each task as a child that ignores INT and TERM: an engine may send them to this script
/// alone or to all processes of the job, and the renderer must get exactly one signal, since a
/// second one ends it without a film. It is HUP, or TERM where nohup has made all ignore HUP.
constexpr const char* kRunTasks = R"sh(
list=$1 first=$2 last=${3:-$2}
attempts=${SDLC_ATTEMPTS:-5} pause=${SDLC_PAUSE:-10}

signal=HUP ignored='INT TERM'
if { sh -c 'kill -s HUP $$'; } 2>/dev/null; then signal=TERM ignored=INT; fi

child=
stop() {
  trap '' INT TERM
  if [ -n "$child" ]; then
    kill -s "$signal" "$child" 2>/dev/null
    wait "$child"
  fi
  exit 130
}
trap stop INT TERM
trap : HUP

run_task() {
  task=$(sed -n "$(($1 + 1))p" "$list")
  if [ -z "$task" ]; then
    echo "task.sh: $list has no task $1" >&2
    return 2
  fi
  attempt=1
  while :; do
    (
      trap '' $ignored
      render "${task%% *}" "${task##* }"
    ) &
    child=$!
    wait "$child"
    status=$?
    # The terminal's HUP, which the renderer gets too, ends `wait` early.
    while kill -0 "$child" 2>/dev/null; do
      wait "$child"
      status=$?
    done
    child=
    # 75: the disk was full or the like; 137 and 143: it was killed.
    case $status in
      0 | 130) return "$status" ;;
      75 | 137 | 143) [ "$attempt" -lt "$attempts" ] || return "$status" ;;
      *)
        [ -z "${SDLC_FAILED:-}" ] || echo "$status" >>"$SDLC_FAILED"
        return "$status"
        ;;
    esac
    attempt=$((attempt + 1))
    echo "task.sh: task $1 ended with status $status; attempt $attempt of $attempts in $pause s" >&2
    sleep "$pause" &
    child=$!
    wait "$child"
    child=
  done
}

code=0
while [ "$first" -le "$last" ]; do
  run_task "$first"
  status=$?
  [ "$status" -ne 130 ] || exit 130
  [ "$status" -eq 0 ] || code=$status
  first=$((first + 1))
done
exit "$code"
)sh";

/// Ends with the gravest status. 75, which means that parts are missing, is the least grave.
constexpr const char* kMergeParts = R"sh(
code=0
while read -r frame; do
  base=$name
  [ "$frame" = - ] || base=$name.$frame
  picture=frames/$base.$extension
  [ -s "$picture" ] && continue
  set -- "parts/$base."*.film
  if [ -e "$1" ]; then
    merge "$@" </dev/null
    status=$?
  else
    echo "merge.sh: $picture has no parts yet" >&2
    status=75
  fi
  case $status in
    0) rm -f -- "frames/$base.partial.$extension" ;;
    75) [ "$code" -ne 0 ] || code=75 ;;
    130) exit 130 ;;
    *) if [ "$code" -eq 75 ] || [ "$status" -gt "$code" ]; then code=$status; fi ;;
  esac
done <pictures.txt
exit "$code"
)sh";

std::string words(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += ' ' + shell_quoted(argument);
  return text;
}

}  // namespace

std::vector<std::string> render_flags(const FarmJob& job) {
  std::vector<std::string> flags = job.flags;
  if (job.has_shards() || has_checkpoints(job)) {
    flags.insert(flags.end(), {"--checkpoint", "60s", "--resume"});
  }
  if (!job.has_shards()) flags.push_back("--skip-existing");
  return flags;
}

std::string engine_name(const FarmJob& job) {
  std::string name;
  for (const char c : job.name) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 && (c & 0x80) == 0;
    name += is_plain ? static_cast<char>(std::tolower(static_cast<unsigned char>(c))) : '-';
  }
  name = ("sdlc-" + name).substr(0, 40);
  name.resize(name.find_last_not_of('-') + 1);
  return name;
}

FarmFile task_list(const FarmRun& run) {
  std::string text;
  for (const FarmTask& task : run.tasks) {
    text += task.frames.empty() ? "-" : describe_frames(task.frames);
    if (task.shard > 0) text += fmt::format(" {}", task.shard);
    text += '\n';
  }
  return {.name = run.name + ".tasks", .content = std::move(text)};
}

FarmFile task_script(const FarmJob& job) {
  std::string text = kScriptStart;
  text +=
      "# Runs the tasks FIRST to LAST of a list, which count from 0: task.sh LIST FIRST [LAST]\n"
      "# SDLC is the program. A task that was killed or that may succeed later is tried\n"
      "# SDLC_ATTEMPTS times, with SDLC_PAUSE seconds between.\n"
      "# shellcheck disable=SC2016,SC2086,SC2317\n\n"
      "# render FRAMES SHARD\n"
      "render() {\n";
  text += fmt::format("  exec \"${{SDLC:-sdlc}}\" render {}{}", shell_quoted(job.scene),
                      words(render_flags(job)));
  if (job.engine == FarmEngine::Slurm && std::ranges::count(job.flags, "--threads") == 0) {
    text += " \\\n    ${SLURM_CPUS_ON_NODE:+--threads \"$SLURM_CPUS_ON_NODE\"}";
  }
  if (!job.frames.empty()) text += " \\\n    --frames \"$1\"";
  if (job.has_shards()) {
    const std::string pattern = part_pattern(job, "");
    const std::string before = pattern.substr(0, pattern.size() - std::string_view(".film").size());
    text += fmt::format(" \\\n    --shard \"$2/{}\" -o {}\"$2\".film", job.shards,
                        shell_quoted(before));
  } else {
    text += " \\\n    -o " + shell_quoted(picture_pattern(job));
  }
  text += "\n}\n";
  return {.name = "task.sh", .content = text + kRunTasks, .is_program = true};
}

std::vector<FarmFile> merge_scripts(const FarmJob& job) {
  if (!job.has_shards()) return {};
  std::string text = kScriptStart;
  text +=
      "# Merges the parts of each picture that is not there: merge.sh. Exit status 75: parts are\n"
      "# missing.\n\n";
  text +=
      fmt::format("name={}\nextension={}\n", shell_quoted(job.name), shell_quoted(job.extension));
  text +=
      fmt::format("merge() {{ \"${{SDLC:-sdlc}}\" merge \"$@\" --expect {}{} -o \"$picture\"; }}\n",
                  job.shards, words(job.merge_flags));
  std::string list;
  for (const std::optional<int> frame : pictures_of(job)) {
    list += frame ? name_of_frame(kFrameMark, *frame) : "-";
    list += '\n';
  }
  return {{.name = "merge.sh", .content = text + kMergeParts, .is_program = true},
          {.name = "pictures.txt", .content = std::move(list)}};
}

std::vector<FarmFile> farm_files(const FarmJob& job, const FarmRun& run) {
  switch (job.engine) {
    case FarmEngine::Slurm: return slurm_files(job, run);
    case FarmEngine::OpenJd: return openjd_files(job, run);
    case FarmEngine::Kubernetes: return kubernetes_files(job, run);
    case FarmEngine::Shell: return shell_files(job, run);
  }
  return {};
}

std::string start_command(const FarmJob& job, const FarmRun& run) {
  const auto path = [&](const std::string& name) {
    return shell_quoted((job.folder / name).string());
  };
  switch (job.engine) {
    case FarmEngine::Slurm:
      return fmt::format("sh {}", path(run.name == "render" ? "submit.sh" : run.name + ".sh"));
    case FarmEngine::OpenJd: return fmt::format("openjd run {}", path(run.name + ".json"));
    case FarmEngine::Kubernetes:
      return fmt::format("kubectl create -f {}", path(run.name + ".json"));
    case FarmEngine::Shell: return fmt::format("sh {}", path(run.name + ".sh"));
  }
  return {};
}

}  // namespace sdlc::cli
