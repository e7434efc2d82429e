#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/farm_engines.hpp"

/// A List of Jobs in JSON, which kubectl reads as it reads YAML.
namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Pods at a time; the scheduler lets those wait for which there is no node.
constexpr std::size_t kMaxPods = 1000;

Json on_codes(const char* action, std::vector<int> codes) {
  return {{"action", action}, {"onExitCodes", {{"operator", "In"}, {"values", std::move(codes)}}}};
}

/// Disruptions are tried again without being counted. `rule`: a further one.
Json failure_policy(const char* action_of_errors, Json rule = {}) {
  // These would occur again.
  Json rules = Json::array(
      {on_codes(action_of_errors, {1, 2, 3}),
       {{"action", "Ignore"},
        {"onPodConditions", Json::array({{{"type", "DisruptionTarget"}, {"status", "True"}}})}}});
  if (!rule.is_null()) rules.push_back(std::move(rule));
  return {{"rules", std::move(rules)}};
}

/// The volume has the same path in the pod as here, so that the paths in the scripts hold.
Json pod_template(const FarmJob& job, std::vector<std::string> command) {
  return {
      {"spec",
       {{"restartPolicy", "Never"},
        // The renderer saves its film when its pod is evicted.
        {"terminationGracePeriodSeconds", 120},
        {"containers",
         Json::array({{{"name", "sdlc"},
                       {"image", job.image},
                       {"workingDir", job.folder.string()},
                       {"command", std::move(command)},
                       {"volumeMounts",
                        Json::array({{{"name", "farm"}, {"mountPath", job.folder.string()}}})}}})},
        {"volumes", Json::array({{{"name", "farm"},
                                  {"persistentVolumeClaim", {{"claimName", "sdlc-farm"}}}}})}}}};
}

/// A retry may be started several times, but not the job itself.
Json job_object(const std::string& name, bool is_retry, Json spec) {
  const Json labels{{"app.kubernetes.io/name", "sdlc"}};
  return {{"apiVersion", "batch/v1"},
          {"kind", "Job"},
          {"metadata", is_retry ? Json{{"generateName", name + "-"}, {"labels", labels}}
                                : Json{{"name", name}, {"labels", labels}}},
          {"spec", std::move(spec)}};
}

}  // namespace

std::vector<FarmFile> kubernetes_files(const FarmJob& job, const FarmRun& run) {
  const std::size_t tasks = run.tasks.size();
  const bool is_retry = run.name != "render";
  const std::string name = engine_name(job) + (is_retry ? "-" + run.name : "");
  Json items = Json::array();
  if (tasks > 0) {
    items.push_back(
        job_object(name, is_retry,
                   {{"completionMode", "Indexed"},
                    {"completions", tasks},
                    {"parallelism", std::min(tasks, kMaxPods)},
                    {"backoffLimitPerIndex", 5},
                    {"podFailurePolicy", failure_policy("FailIndex", on_codes("Ignore", {75}))},
                    {"template", pod_template(job, {"/bin/sh", "./task.sh", run.name + ".tasks",
                                                    "$(JOB_COMPLETION_INDEX)"})}}));
  }
  if (job.has_shards()) {
    // Its status is 75 until all parts are there; the pauses grow to six minutes, so it is given up
    // after four days.
    items.push_back(job_object(name + "-merge", is_retry,
                               {{"backoffLimit", 1000},
                                {"podFailurePolicy", failure_policy("FailJob")},
                                {"template", pod_template(job, {"/bin/sh", "./merge.sh"})}}));
  }
  const Json list{{"apiVersion", "v1"}, {"kind", "List"}, {"items", std::move(items)}};
  std::vector<FarmFile> files{task_script(job)};
  for (FarmFile& file : merge_scripts(job)) files.push_back(std::move(file));
  files.push_back(task_list(run));
  files.push_back({.name = run.name + ".json", .content = list.dump(2) + "\n"});
  return files;
}

}  // namespace sdlc::cli
