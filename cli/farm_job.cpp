#include "cli/farm_job.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/frames.hpp"
#include "cli/usage_error.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kFarmVersion = 1;

/// Calls `visit(name, member)` with each member that is stored without a conversion.
constexpr auto kMembers = [](auto& job, auto visit) {
  visit("scene", job.scene);
  visit("name", job.name);
  visit("extension", job.extension);
  visit("flags", job.flags);
  visit("merge_flags", job.merge_flags);
  visit("frames_per_task", job.frames_per_task);
  visit("shards", job.shards);
  visit("width", job.width);
  visit("height", job.height);
  visit("task_seconds", job.task_seconds);
  visit("image", job.image);
};

}  // namespace

std::vector<FarmTask> chunks_of(const FarmJob& job, const std::vector<int>& frames) {
  std::vector<FarmTask> tasks;
  for (std::size_t i = 0; i < frames.size(); i += job.frames_per_task) {
    const auto begin = frames.begin() + static_cast<std::ptrdiff_t>(i);
    const std::size_t count = std::min(job.frames_per_task, frames.size() - i);
    tasks.push_back({.frames = {begin, begin + static_cast<std::ptrdiff_t>(count)}});
  }
  return tasks;
}

std::vector<FarmTask> all_tasks(const FarmJob& job) {
  if (!job.has_shards() && !job.frames.empty()) return chunks_of(job, job.frames);
  if (!job.has_shards()) return {FarmTask{}};
  std::vector<FarmTask> tasks;
  for (const std::optional<int> frame : pictures_of(job)) {
    for (std::uint32_t shard = 1; shard <= job.shards; ++shard) {
      FarmTask& task = tasks.emplace_back(FarmTask{.frames = {}, .shard = shard});
      if (frame) task.frames = {*frame};
    }
  }
  return tasks;
}

std::vector<std::optional<int>> pictures_of(const FarmJob& job) {
  if (job.frames.empty()) return {std::nullopt};
  return {job.frames.begin(), job.frames.end()};
}

std::string picture_pattern(const FarmJob& job) {
  return fmt::format("frames/{}{}.{}", job.name, job.frames.empty() ? "" : ".####", job.extension);
}

std::string part_pattern(const FarmJob& job, const std::string& shard) {
  return fmt::format("parts/{}{}.{}.film", job.name, job.frames.empty() ? "" : ".####", shard);
}

std::string picture_name(const FarmJob& job, std::optional<int> frame) {
  const std::string pattern = picture_pattern(job);
  return frame ? name_of_frame(pattern, *frame) : pattern;
}

std::string part_name(const FarmJob& job, std::optional<int> frame, std::uint32_t shard) {
  const std::string pattern = part_pattern(job, std::to_string(shard));
  return frame ? name_of_frame(pattern, *frame) : pattern;
}

bool has_checkpoints(const FarmJob& job) { return !job.has_shards() && job.frames_per_task == 1; }

std::string farm_text(const FarmJob& job) {
  Json json{{"version", kFarmVersion},
            {"engine", kFarmEngineWords[static_cast<std::size_t>(job.engine)]},
            {"frames", job.frames.empty() ? Json() : Json(describe_frames(job.frames))},
            {"pictures", picture_pattern(job)}};
  kMembers(job, [&](const char* name, const auto& member) { json[name] = member; });
  if (job.has_shards()) json["parts"] = part_pattern(job, "{shard}");
  try {
    return json.dump(2) + "\n";
  } catch (const Json::type_error&) {
    throw UsageError("a name or a flag is not UTF-8, which job files need; rename the file");
  }
}

std::string read_farm_file(const FarmJob& job, const std::string& name) {
  const std::filesystem::path path = job.folder / name;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw render::IoError("read", path,
                          "it is missing; `sdlc farm FILE -o FOLDER` makes the folder of a job");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

FarmJob read_farm_job(const std::filesystem::path& folder) {
  FarmJob job;
  job.folder = folder;
  const std::filesystem::path path = folder / kFarmFileName;
  const std::string text = read_farm_file(job, kFarmFileName);
  try {
    const Json json = Json::parse(text);
    if (json.at("version") != kFarmVersion) {
      throw render::IoError("read", path, "it is of another version of sdlc; make the job again");
    }
    const auto engine = std::ranges::find(kFarmEngineWords, json.at("engine").get<std::string>());
    if (engine == kFarmEngineWords.end()) throw render::IoError("read", path, "unknown engine");
    job.engine = static_cast<FarmEngine>(engine - kFarmEngineWords.begin());
    kMembers(job, [&](const char* name, auto& member) { json.at(name).get_to(member); });
    if (!json.at("frames").is_null()) {
      const auto ranges = parse_frames(json.at("frames").get<std::string>());
      if (!ranges) throw render::IoError("read", path, "`frames` is not a list of frames");
      job.frames = frames_of(*ranges);
    }
  } catch (const Json::exception& error) {
    throw render::IoError("read", path, error.what());
  }
  if (job.frames_per_task == 0) throw render::IoError("read", path, "`frames_per_task` is 0");
  return job;
}

std::string difference(const FarmJob& job, const FarmJob& expected) {
  const auto differs = [](const char* what, const std::string& has, const std::string& wanted) {
    return fmt::format("its {} is {}, not {}", what, has.empty() ? "none" : has,
                       wanted.empty() ? "none" : wanted);
  };
  if (job.scene != expected.scene) return differs("scene", job.scene, expected.scene);
  if (job.flags != expected.flags) {
    return differs("list of flags", fmt::format("{}", fmt::join(job.flags, " ")),
                   fmt::format("{}", fmt::join(expected.flags, " ")));
  }
  if (job.frames != expected.frames) {
    return differs("list of frames", describe_frames(job.frames), describe_frames(expected.frames));
  }
  if (job.extension != expected.extension) {
    return differs("format", job.extension, expected.extension);
  }
  return {};
}

}  // namespace sdlc::cli
