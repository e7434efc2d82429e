#pragma once

#include "cli/environment.hpp"
#include "cli/exit_code.hpp"
#include "cli/farm_engines.hpp"

/// The folder of a farm's job.
namespace sdlc::cli {

/// Absolute, without a trailing slash.
std::filesystem::path absolute_path(const std::string& path);

/// Makes the folders for the results.
void make_farm_folders(const FarmJob& job);
/// Each file appears whole. Throws render::IoError.
void write_farm_files(const FarmJob& job, const std::vector<FarmFile>& files);
/// Removes the job files of this run.
void remove_farm_run(const FarmJob& job, const FarmRun& run);

/// `sdlc farm status`: reports what is missing or damaged, and writes job files for it.
ExitCode report_farm_status(const std::string& folder, bool as_json, Environment& env);

}  // namespace sdlc::cli
