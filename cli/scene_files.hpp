#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/environment.hpp"

namespace sdlc::cli {

/// What is looked for in folders.
enum class SceneFiles : std::uint8_t { ScenesAndConfigs, Scenes };

/// The scenes that the arguments name, each once: files and `-` as they are, of folders all the
/// .scene files and, if wanted, the .json files that look like configs, at any depth, in the order
/// of their paths. Hidden folders and links to folders are not entered; in a sandbox links to files
/// outside the link's folder are left out. Throws UsageError for a folder without any.
std::vector<std::string> find_scene_files(const std::vector<std::string>& arguments,
                                          const Environment& env,
                                          SceneFiles wanted = SceneFiles::ScenesAndConfigs,
                                          bool is_sandboxed = false);

}  // namespace sdlc::cli
