#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/environment.hpp"

namespace sdlc::cli {

/// Which files to search for in folders.
enum class SceneFiles : std::uint8_t { ScenesAndConfigs, Scenes };

/// The scenes that the arguments name, each once: files and `-` unchanged, and from folders all
/// .scene files and, if wanted, the .json files that look like configs, recursively, ordered by
/// path. Hidden folders and links to folders are skipped; in a sandbox also links to files outside
/// the link's folder. Throws UsageError for a folder without any.
std::vector<std::string> find_scene_files(const std::vector<std::string>& arguments,
                                          const Environment& env,
                                          SceneFiles wanted = SceneFiles::ScenesAndConfigs,
                                          bool is_sandboxed = false);

}  // namespace sdlc::cli
