#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The file's stem as a name: "pool_table" for "library/pool-table.scene".
std::string name_for_file(std::string_view file);

/// Whether a file of this name can be imported or, with `is_include`, included.
bool is_loadable(std::string_view file_name, bool is_include);

/// The path of the existing file that `written`, a path without a file, probably means. `from`: the
/// scene with the import, which is never the answer; both paths are relative to its folder. In each
/// part of the path the name with the smallest edit distance replaces one that does not exist.
std::optional<std::string> nearest_file(const std::filesystem::path& from, std::string_view written,
                                        bool is_include, const PathLister& list);

}  // namespace sdlc::lang
