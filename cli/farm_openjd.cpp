#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/farm_engines.hpp"
#include "cli/frames.hpp"

/// Open Job Description, jobtemplate-2023-09: a YAML or JSON document.
namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

/// AWS Deadline Cloud accepts no larger chunks.
constexpr std::size_t kMaxChunk = 150;
/// Of a range that is a list. One that is an expression has no limit.
constexpr std::size_t kMaxRangeList = 1024;

/// Whether a text may be an argument: that is a format string, without control characters.
bool is_plain_argument(const std::string& text) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  return text.find("{{") == std::string::npos && text.find("}}") == std::string::npos &&
         std::ranges::none_of(text, is_control);
}

/// The parameters of the job. Texts that are no plain arguments become some too: a default is no
/// format string, and may have any characters.
class JobParameters {
 public:
  explicit JobParameters(const FarmJob& job) {
    list_ = Json::array(
        {{{"name", "Scene"},
          {"type", "PATH"},
          {"objectType", "FILE"},
          {"dataFlow", "IN"},
          {"default", (job.folder / job.scene).string()}},
         {{"name", "Folder"},
          {"type", "PATH"},
          {"objectType", "DIRECTORY"},
          {"dataFlow", "INOUT"},
          {"default", job.folder.string()},
          {"description", "Where pictures and parts are written, as made by `sdlc farm`"}},
         {{"name", "Sdlc"},
          {"type", "STRING"},
          {"default", "sdlc"},
          {"description", "The program"}}});
  }

  std::string argument(const std::string& text) {
    if (is_plain_argument(text)) return text;
    const std::string name = fmt::format("Text{}", ++texts_);
    list_.push_back({{"name", name}, {"type", "STRING"}, {"default", text}});
    return fmt::format("{{{{Param.{}}}}}", name);
  }

  const Json& list() const { return list_; }

 private:
  Json list_;
  int texts_ = 0;
};

/// The renderer saves its film when it is canceled.
Json cancelation() { return {{"mode", "NOTIFY_THEN_TERMINATE"}, {"notifyPeriodInSeconds", 120}}; }

Json render_action(const FarmJob& job, JobParameters& parameters) {
  std::vector<std::string> arguments{"render", "{{Param.Scene}}"};
  for (const std::string& flag : render_flags(job)) arguments.push_back(parameters.argument(flag));
  arguments.insert(arguments.end(), {"--progress", "openjd"});
  const std::string folder = "{{Param.Folder}}/";
  if (!job.frames.empty()) {
    arguments.insert(arguments.end(), {"--frames", job.has_shards() ? "{{Task.Param.Frame}}"
                                                                    : "{{Task.Param.Frames}}"});
  }
  if (job.has_shards()) {
    arguments.insert(arguments.end(),
                     {"--shard", fmt::format("{{{{Task.Param.Shard}}}}/{}", job.shards), "-o",
                      folder + part_pattern(job, "{{Task.Param.Shard}}")});
  } else {
    arguments.insert(arguments.end(), {"-o", folder + picture_pattern(job)});
  }
  return {{"command", "{{Param.Sdlc}}"}, {"args", arguments}, {"cancelation", cancelation()}};
}

/// Ascending numbers as a range expression.
std::string range_of(const std::vector<int>& numbers) { return describe_frames(numbers); }

bool is_contiguous(const std::vector<int>& frames) {
  return frames.back() - frames.front() + 1 == static_cast<int>(frames.size());
}

Json chunk_space(const FarmJob& job, const std::vector<FarmTask>& tasks) {
  std::vector<int> frames;
  for (const FarmTask& task : tasks) {
    frames.insert(frames.end(), task.frames.begin(), task.frames.end());
  }
  Json chunks{{"defaultTaskCount", std::min(job.frames_per_task, kMaxChunk)}};
  if (job.task_seconds > 0 && job.frames_per_task > 1) {
    chunks["targetRuntimeSeconds"] = std::max(1, static_cast<int>(job.task_seconds));
  }
  chunks["rangeConstraint"] = is_contiguous(frames) ? "CONTIGUOUS" : "NONCONTIGUOUS";
  return {{"taskParameterDefinitions", Json::array({{{"name", "Frames"},
                                                     {"type", "CHUNK[INT]"},
                                                     {"range", range_of(frames)},
                                                     {"chunks", std::move(chunks)}}})}};
}

Json int_parameter(const char* name, Json range) {
  return {{"name", name}, {"type", "INT"}, {"range", std::move(range)}};
}

/// All shards of all frames.
Json shard_space(const FarmJob& job) {
  Json parameters = Json::array();
  if (!job.frames.empty()) parameters.push_back(int_parameter("Frame", range_of(job.frames)));
  parameters.push_back(int_parameter("Shard", fmt::format("1-{}", job.shards)));
  return {{"taskParameterDefinitions", std::move(parameters)}};
}

/// Some shards of some frames, side by side.
Json pair_space(const FarmJob& job, std::span<const FarmTask> tasks) {
  std::vector<int> frames, shards;
  for (const FarmTask& task : tasks) {
    if (!task.frames.empty()) frames.push_back(task.frames.front());
    shards.push_back(static_cast<int>(task.shard));
  }
  Json parameters = Json::array({int_parameter("Shard", shards)});
  if (job.frames.empty()) return {{"taskParameterDefinitions", std::move(parameters)}};
  parameters.push_back(int_parameter("Frame", frames));
  return {{"taskParameterDefinitions", std::move(parameters)}, {"combination", "(Frame, Shard)"}};
}

Json step_of(const std::string& name, const Json& action, Json space) {
  Json step{{"name", name}};
  if (!space.is_null()) step["parameterSpace"] = std::move(space);
  step["script"] = {{"actions", {{"onRun", action}}}};
  return step;
}

Json render_steps(const FarmJob& job, const FarmRun& run, const Json& action) {
  if (run.tasks.empty()) return Json::array();
  if (!job.has_shards()) {
    return Json::array(
        {step_of("Render", action, job.frames.empty() ? Json() : chunk_space(job, run.tasks))});
  }
  if (run.tasks.size() == pictures_of(job).size() * job.shards) {
    return Json::array({step_of("Render", action, shard_space(job))});
  }
  Json steps = Json::array();
  for (std::size_t i = 0; i < run.tasks.size(); i += kMaxRangeList) {
    const std::span tasks(run.tasks);
    const std::string name = i == 0 ? "Render" : fmt::format("Render{}", 1 + i / kMaxRangeList);
    steps.push_back(
        step_of(name, action,
                pair_space(job, tasks.subspan(i, std::min(kMaxRangeList, run.tasks.size() - i)))));
  }
  return steps;
}

Json merge_step(const Json& render_steps) {
  Json step = step_of(
      "Merge",
      {{"command", "sh"}, {"args", {"{{Param.Folder}}/merge.sh"}}, {"cancelation", cancelation()}},
      Json());
  if (!render_steps.empty()) {
    step["dependencies"] = Json::array();
    for (const Json& other : render_steps) {
      step["dependencies"].push_back({{"dependsOn", other.at("name")}});
    }
  }
  step["stepEnvironments"] =
      Json::array({{{"name", "Program"}, {"variables", {{"SDLC", "{{Param.Sdlc}}"}}}}});
  return step;
}

}  // namespace

std::vector<FarmFile> openjd_files(const FarmJob& job, const FarmRun& run) {
  JobParameters parameters(job);
  Json steps = render_steps(job, run, render_action(job, parameters));
  if (job.has_shards()) steps.push_back(merge_step(steps));
  Json json{{"specificationVersion", "jobtemplate-2023-09"}};
  if (!job.has_shards() && !job.frames.empty()) json["extensions"] = {"TASK_CHUNKING"};
  json["name"] = engine_name(job);
  json["parameterDefinitions"] = parameters.list();
  json["steps"] = std::move(steps);
  std::vector<FarmFile> files = merge_scripts(job);
  files.push_back({.name = run.name + ".json", .content = json.dump(2) + "\n"});
  return files;
}

}  // namespace sdlc::cli
