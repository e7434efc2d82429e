#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// `sdlc farm`: what a farm renders, and how it is divided into tasks.
namespace sdlc::cli {

enum class FarmEngine : std::uint8_t { Slurm, OpenJd, Kubernetes, Shell };
inline constexpr std::array<std::string_view, 4> kFarmEngineWords{"slurm", "openjd", "kubernetes",
                                                                  "shell"};

/// The description in FOLDER/farm.json.
struct FarmJob {
  std::filesystem::path folder;  ///< absolute; not in the file, so that the folder can be moved
  FarmEngine engine = FarmEngine::Shell;
  std::string scene;               ///< the name of its pack in the folder
  std::string name;                ///< of the pictures; without control characters and # { } /
  std::string extension;           ///< of the pictures
  std::vector<std::string> flags;  ///< of `render`
  std::vector<std::string> merge_flags;  ///< of `merge`
  std::vector<int> frames;               ///< ascending; empty for a scene without an animation
  std::size_t frames_per_task = 1;
  std::uint32_t shards = 0;  ///< of each picture; 0: pictures are not divided
  int width = 0, height = 0;
  double task_seconds = 0;
  std::string image = "sdlc";  ///< of containers

  bool has_shards() const noexcept { return shards > 0; }
};

/// The largest number of tasks: that of an indexed job of Kubernetes.
inline constexpr std::size_t kMaxFarmTasks = 100'000;

inline constexpr const char* kFarmFileName = "farm.json";

/// A part of a picture, or whole pictures.
struct FarmTask {
  std::vector<int> frames;  ///< empty for a scene without an animation
  std::uint32_t shard = 0;  ///< from 1; 0: the task renders whole pictures
};

/// The tasks that one set of job files runs.
struct FarmRun {
  std::string name = "render";  ///< the stem of the job files
  std::vector<FarmTask> tasks;
};

/// All tasks of these pictures that are not divided, with frames_per_task of them in each.
std::vector<FarmTask> chunks_of(const FarmJob& job, const std::vector<int>& frames);
/// All tasks of a job.
std::vector<FarmTask> all_tasks(const FarmJob& job);
/// The frames of the job one by one; nullopt for a scene without an animation.
std::vector<std::optional<int>> pictures_of(const FarmJob& job);

/// Names relative to the folder of the job. `frame` may be nullopt: then #### remains.
std::string picture_pattern(const FarmJob& job);
std::string part_pattern(const FarmJob& job, const std::string& shard);
std::string picture_name(const FarmJob& job, std::optional<int> frame);
std::string part_name(const FarmJob& job, std::optional<int> frame, std::uint32_t shard);

/// Whether the tasks keep an unfinished picture in a film beside it.
bool has_checkpoints(const FarmJob& job);

std::string farm_text(const FarmJob& job);
/// The content of a file in the folder. Throws render::IoError.
std::string read_farm_file(const FarmJob& job, const std::string& name);
/// Reads FOLDER/farm.json. Throws render::IoError.
FarmJob read_farm_job(const std::filesystem::path& folder);
/// The first difference between the pictures of two jobs with the same pack, as a clause; empty if
/// there is none. The engine and the division into tasks may differ.
std::string difference(const FarmJob& job, const FarmJob& expected);

}  // namespace sdlc::cli
