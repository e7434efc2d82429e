#include <algorithm>
#include <fstream>
#include <map>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/farm_folder.hpp"
#include "cli/frames.hpp"
#include "lang/text/display_width.hpp"
#include "render/film/film_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

enum class FileState : std::uint8_t { Present, Missing, Unfinished, Damaged };

struct CheckedFile {
  std::string name;  ///< in the folder of the job
  std::optional<int> frame;
  std::uint32_t shard = 0;  ///< 0 for a picture
  FileState state = FileState::Missing;
  std::string cause = {};  ///< why it is damaged
};

/// All files of one kind.
struct CheckedFiles {
  std::size_t expected = 0;
  std::vector<CheckedFile> absent;  ///< those that have to be rendered

  std::size_t present() const { return expected - absent.size(); }
};

class FarmStatus {
 public:
  explicit FarmStatus(FarmJob job) : job_(std::move(job)) {
    for (const std::optional<int> frame : pictures_of(job_)) check_picture(frame);
  }

  bool is_complete() const { return pictures_.absent.empty(); }

  /// Moves damaged files aside: tasks skip pictures that are there and go on from films.
  void move_damaged() const {
    for (const CheckedFiles* files : {&pictures_, &parts_}) {
      for (const CheckedFile& file : files->absent) {
        if (file.state == FileState::Damaged) fs::rename(path_of(file), moved_name(file));
      }
    }
    for (const CheckedFile& film : checkpoints_) fs::rename(path_of(film), moved_name(film));
  }

  /// What has to be rendered again.
  FarmRun retry() const {
    FarmRun run{.name = "retry", .tasks = {}};
    if (job_.has_shards()) {
      for (const CheckedFile& part : parts_.absent) {
        FarmTask& task = run.tasks.emplace_back(FarmTask{.frames = {}, .shard = part.shard});
        if (part.frame) task.frames = {*part.frame};
      }
      return run;
    }
    std::vector<int> frames;
    for (const CheckedFile& picture : pictures_.absent) {
      if (picture.frame) frames.push_back(*picture.frame);
    }
    run.tasks = frames.empty() ? std::vector{FarmTask{}} : chunks_of(job_, frames);
    return run;
  }

  void print(std::ostream& out) const {
    print(pictures_, job_.frames.empty() ? "picture" : "frame", out);
    if (job_.has_shards()) print(parts_, "part", out);
    for (const CheckedFile& film : checkpoints_) print_damaged(film, out);
  }

  Json json() const {
    Json json{{"complete", is_complete()}, {"frames", json_of(pictures_)}};
    if (job_.has_shards()) json["parts"] = json_of(parts_);
    return json;
  }

 private:
  fs::path path_of(const CheckedFile& file) const { return job_.folder / file.name; }
  fs::path moved_name(const CheckedFile& file) const {
    return job_.folder / (file.name + ".damaged");
  }

  /// Missing or Damaged if `read` throws.
  template <typename Read>
  CheckedFile check(CheckedFile file, const Read& read) const {
    const fs::path path = path_of(file);
    std::error_code error;
    if (!fs::exists(path, error)) return file;
    if (!std::ifstream(path)) throw render::IoError("read", path, "it cannot be opened");
    file.state = FileState::Present;
    try {
      read(path, file);
    } catch (const render::IoError& failure) {
      file.state = FileState::Damaged;
      file.cause = failure.cause();
    } catch (const render::FilmError& failure) {
      file.state = FileState::Damaged;
      file.cause = failure.what();
    }
    return file;
  }

  static void damage(CheckedFile& file, std::string cause) {
    file.state = FileState::Damaged;
    file.cause = std::move(cause);
  }

  static void add(CheckedFiles& files, CheckedFile file) {
    ++files.expected;
    if (file.state != FileState::Present) files.absent.push_back(std::move(file));
  }

  void check_picture(std::optional<int> frame) {
    const auto read = [&](const fs::path& path, CheckedFile& file) {
      const render::Picture picture = render::read_picture(path);
      if (picture.width == job_.width && picture.height == job_.height) return;
      damage(file, fmt::format("it has {} x {} pixels, not {} x {}", picture.width, picture.height,
                               job_.width, job_.height));
    };
    const CheckedFile picture = check({.name = picture_name(job_, frame), .frame = frame}, read);
    add(pictures_, picture);
    if (has_checkpoints(job_) && picture.state != FileState::Present) check_checkpoint(frame);
    if (!job_.has_shards()) return;
    // The parts of a finished picture are no longer needed.
    if (picture.state == FileState::Present) {
      parts_.expected += job_.shards;
      return;
    }
    for (std::uint32_t shard = 1; shard <= job_.shards; ++shard) check_part(frame, shard);
  }

  void check_part(std::optional<int> frame, std::uint32_t shard) {
    const auto read = [&](const fs::path& path, CheckedFile& file) {
      const render::StoredFilm film = render::read_film_file(path);
      if (film.record.shards != job_.shards || film.record.frame != frame) {
        damage(file, "it is a part of another job");
      } else if (std::ranges::count(film.shards, shard) == 0) {
        file.state = FileState::Unfinished;
      }
    };
    add(parts_,
        check({.name = part_name(job_, frame, shard), .frame = frame, .shard = shard}, read));
  }

  void check_checkpoint(std::optional<int> frame) {
    const fs::path name = fs::path(picture_name(job_, frame)).replace_extension(".film");
    const CheckedFile film =
        check({.name = name.string(), .frame = frame},
              [](const fs::path& path, CheckedFile&) { render::read_film_file(path); });
    if (film.state == FileState::Damaged) checkpoints_.push_back(film);
  }

  void print_damaged(const CheckedFile& file, std::ostream& out) const {
    out << fmt::format("damaged: {}: {}; moved to {}\n", lang::printable(file.name),
                       lang::printable(file.cause), lang::printable(file.name + ".damaged"));
  }

  void print(const CheckedFiles& files, const char* what, std::ostream& out) const {
    out << (files.expected == 1
                ? fmt::format("the {} is {}\n", what, files.present() == 1 ? "there" : "missing")
                : fmt::format("{} of {} {}s are there\n", files.present(), files.expected, what));
    // Frames in one line, however many they are.
    std::map<std::pair<FileState, std::uint32_t>, std::vector<int>> numbers;
    for (const CheckedFile& file : files.absent) {
      if (file.state == FileState::Damaged) {
        print_damaged(file, out);
      } else if (file.frame) {
        numbers[{file.state, file.shard}].push_back(*file.frame);
      } else {
        out << fmt::format("{}: {}\n", word(file.state), lang::printable(file.name));
      }
    }
    for (const auto& [key, frames] : numbers) {
      const auto& [state, shard] = key;
      out << fmt::format("{}: {}{} {}\n", word(state),
                         shard > 0 ? fmt::format("part {} of ", shard) : "",
                         frames.size() == 1 ? "frame" : "frames", describe_frames(frames));
    }
  }

  static const char* word(FileState state) {
    return state == FileState::Unfinished ? "unfinished" : "missing";
  }

  static Json json_of(const CheckedFiles& files) {
    Json json{{"expected", files.expected},
              {"present", files.present()},
              {"missing", Json::array()},
              {"unfinished", Json::array()},
              {"damaged", Json::array()}};
    for (const CheckedFile& file : files.absent) {
      if (file.state == FileState::Damaged) {
        json["damaged"].push_back({{"file", file.name}, {"cause", file.cause}});
      } else {
        json[word(file.state)].push_back(file.name);
      }
    }
    return json;
  }

  FarmJob job_;
  CheckedFiles pictures_, parts_;
  std::vector<CheckedFile> checkpoints_;  ///< those that are damaged
};

/// Throws IoError if no task can read the scene.
void check_pack(const FarmJob& job) {
  const fs::path pack = job.folder / job.scene;
  if (std::error_code ignored; fs::is_regular_file(pack, ignored)) return;
  throw render::IoError("read", pack,
                        "it is missing, and the job renders it; put it back, or make "
                        "the job again with `sdlc farm`");
}

}  // namespace

ExitCode report_farm_status(const std::string& folder, bool as_json, Environment& env) {
  const FarmJob job = read_farm_job(absolute_path(folder));
  const FarmStatus status(job);
  FarmRun run{.name = "retry", .tasks = {}};
  if (status.is_complete()) {
    remove_farm_run(job, run);
  } else {
    check_pack(job);
    status.move_damaged();
    run = status.retry();
    make_farm_folders(job);
    write_farm_files(job, farm_files(job, run));
  }
  const std::string start = status.is_complete() ? "" : start_command(job, run);
  if (as_json) {
    Json json = status.json();
    json["retry"] = start.empty() ? Json() : Json(start);
    env.out << json.dump(2, ' ', false, Json::error_handler_t::replace) << "\n";
  } else {
    status.print(env.out);
    if (!start.empty()) env.out << fmt::format("for these: {}\n", lang::printable(start));
  }
  return status.is_complete() ? ExitCode::Success : ExitCode::TryAgain;
}

}  // namespace sdlc::cli
