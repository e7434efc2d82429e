#include "cli/farm_folder.hpp"

#include <span>
#include <system_error>

#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

}  // namespace

fs::path absolute_path(const std::string& path) {
  const fs::path full = fs::absolute(path).lexically_normal();
  return full.has_filename() ? full : full.parent_path();
}

void make_farm_folders(const FarmJob& job) {
  std::vector<std::string> names{"frames"};
  if (job.has_shards()) names.emplace_back("parts");
  if (job.engine == FarmEngine::Slurm) names.emplace_back("log");
  for (const std::string& name : names) {
    std::error_code error;
    fs::create_directories(job.folder / name, error);
    if (error) throw render::IoError("make", job.folder / name, error);
  }
}

void write_farm_files(const FarmJob& job, const std::vector<FarmFile>& files) {
  for (const FarmFile& file : files) {
    const fs::path path = job.folder / file.name;
    render::write_file_atomically(path, std::as_bytes(std::span(file.content)));
    if (!file.is_program) continue;
    using enum fs::perms;
    std::error_code error;
    fs::permissions(path, owner_exec | group_exec | others_exec, fs::perm_options::add, error);
    if (error) throw render::IoError("make executable", path, error);
  }
}

void remove_farm_run(const FarmJob& job, const FarmRun& run) {
  for (const char* extension : {".tasks", ".tasks.failed", ".sh", ".sbatch", ".json"}) {
    std::error_code ignored;
    fs::remove(job.folder / (run.name + extension), ignored);
  }
}

}  // namespace sdlc::cli
