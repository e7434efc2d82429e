#include "lang/program/nearest_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "lang/source/data_format.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

bool can_be_written(std::string_view name) {
  return std::ranges::none_of(
      name, [](char c) { return c == '"' || c == '\\' || static_cast<unsigned char>(c) < ' '; });
}

/// The stem of a file, so that equal extensions do not make names similar.
std::string_view stem_of(std::string_view file) { return file.substr(0, file.rfind('.')); }

std::vector<std::string_view> names_of(const std::vector<FolderEntry>& entries, bool are_folders) {
  std::vector<std::string_view> names;
  for (const FolderEntry& entry : entries) {
    if (entry.is_folder == are_folders && can_be_written(entry.name)) names.push_back(entry.name);
  }
  return names;
}

/// The name of an existing folder; empty if none is similar.
std::string folder_like(std::string_view written, const std::vector<FolderEntry>& entries) {
  const auto names = names_of(entries, true);
  if (std::ranges::find(names, written) != names.end()) return std::string(written);
  return std::string(nearest_name(written, names).value_or(""));
}

/// The name among `files`; empty if none is similar. Files with the written extension come first.
std::string file_like(std::string_view written, std::vector<std::string_view> files) {
  if (std::ranges::find(files, written) != files.end()) return std::string(written);
  const std::string_view extension = written.substr(stem_of(written).size());
  std::ranges::stable_partition(
      files, [&](std::string_view file) { return file.substr(stem_of(file).size()) == extension; });
  std::vector<std::string_view> stems;
  for (const std::string_view file : files) stems.push_back(stem_of(file));
  auto found = std::ranges::find(stems, stem_of(written));
  if (found == stems.end()) {
    const auto nearest = nearest_name(stem_of(written), stems);
    if (!nearest) return {};
    found = std::ranges::find(stems, *nearest);
  }
  return std::string(files[static_cast<std::size_t>(found - stems.begin())]);
}

}  // namespace

std::string name_for_file(std::string_view file) {
  std::string name = fs::path(file).stem().string();
  for (char& c : name) {
    if (!is_idchar(c)) c = '_';
  }
  return name.empty() || !is_letter(name.front()) ? "library" : name;
}

bool is_loadable(std::string_view file_name, bool is_include) {
  if (file_name.ends_with(".scene")) return true;
  return is_include ? file_name.ends_with(".json") : data_format_of(file_name).has_value();
}

std::optional<std::string> nearest_file(const fs::path& from, std::string_view written,
                                        bool is_include, const PathLister& list) {
  std::string with_slashes(written);
  std::ranges::replace(with_slashes, '\\', '/');
  const fs::path wanted(with_slashes);
  // `here.scene` has no parent path: it is in the working folder.
  const fs::path folder = from.has_parent_path() ? from.parent_path() : fs::path(".");
  if (wanted.is_absolute() || !wanted.has_filename()) return std::nullopt;
  fs::path found;
  for (const fs::path& part : wanted.parent_path()) {
    const bool is_step = part == "." || part == ".." || part.empty();
    const std::string name =
        is_step ? part.string() : folder_like(part.string(), list(folder / found));
    if (name.empty()) return std::nullopt;
    found /= name;
  }
  const std::vector<FolderEntry> entries = list((folder / found).lexically_normal());
  std::vector<std::string_view> files = names_of(entries, false);
  const bool is_own_folder = found.lexically_normal().empty() || found.lexically_normal() == ".";
  std::erase_if(files, [&](std::string_view file) {
    return !is_loadable(file, is_include) || (is_own_folder && file == from.filename());
  });
  const std::string file = file_like(wanted.filename().string(), std::move(files));
  if (file.empty()) return std::nullopt;
  return (found / file).generic_string();
}

}  // namespace sdlc::lang
