#pragma once

#include <filesystem>
#include <vector>

#include "lang/pack/pack.hpp"
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::lang {

/// A pack, and the files that are in it.
struct CollectedFiles {
  Pack pack;
  std::vector<std::filesystem::path> files;  ///< absolute, without the scene
};

/// The scene `root` with the files that its program has loaded (Compiler::read_all_files). Links
/// count as files: a file that is imported by two names is there twice. Throws ZipError for an
/// absolute path in an import or include, which would lead nowhere on another machine; its message
/// begins with the place. `program`: null for a config.
CollectedFiles collect_files(const SourceFile& root, const Program* program,
                             const Workspace& workspace);

/// The deepest folder with both. The paths are absolute and normal.
std::filesystem::path common_folder(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace sdlc::lang
