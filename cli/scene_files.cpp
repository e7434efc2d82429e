#include "cli/scene_files.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "cli/usage_error.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/text/display_width.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

/// Whether the text contains two keys of the format: this accepts configs with mistakes, and
/// excludes other JSON.
bool looks_like_config(const fs::path& path, const Environment& env) {
  constexpr std::uint64_t kMaxConfig = lang::Limits().config;
  std::error_code error;
  const std::optional<std::string> text = env.workspace.read(path, kMaxConfig, error);
  if (!text) return true;  // the reader will report why it cannot be read
  const auto is_there = [&](const lang::JsonKey& key) {
    return text->find(fmt::format("\"{}\"", key.key)) != std::string::npos;
  };
  return std::ranges::count_if(lang::json_config().keys, is_there) >= 2;
}

bool is_wanted(const fs::path& path, const Environment& env, SceneFiles wanted) {
  if (path.extension() == ".scene") return true;
  if (wanted == SceneFiles::Scenes) return false;
  return path.extension() == ".json" && looks_like_config(path, env);
}

std::vector<std::string> scenes_in(const fs::path& folder, const Environment& env,
                                   SceneFiles wanted, bool is_sandboxed) {
  std::vector<std::string> names;
  // Checked first, because the other checks follow links.
  const auto leads_out = [&](const fs::directory_entry& entry) {
    return is_sandboxed && entry.is_symlink() &&
           !lang::Sandbox(env.workspace, entry.path()).resolve(entry.path());
  };
  for (fs::recursive_directory_iterator entry(folder), end; entry != end; ++entry) {
    const fs::path& path = entry->path();
    const bool is_hidden = path.filename().string().starts_with('.');
    if (leads_out(*entry)) continue;
    std::error_code error;  // of a link that leads nowhere or to itself
    const fs::file_status status = entry->status(error);
    const bool is_file = fs::is_regular_file(status);
    const bool is_broken = error || status.type() == fs::file_type::not_found;
    if (fs::is_directory(status)) {
      if (is_hidden) entry.disable_recursion_pending();
    } else if (!is_hidden && ((is_file && is_wanted(path, env, wanted)) ||
                              (is_broken && path.extension() == ".scene"))) {
      names.push_back(path.lexically_normal().string());  // reading a broken link is an error
    }
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<std::string> find_scene_files(const std::vector<std::string>& arguments,
                                          const Environment& env, SceneFiles wanted,
                                          bool is_sandboxed) {
  std::vector<std::string> names;
  for (const std::string& argument : arguments) {
    std::error_code error;
    if (!fs::is_directory(argument, error)) {
      names.push_back(argument);
      continue;
    }
    const std::vector<std::string> found = scenes_in(argument, env, wanted, is_sandboxed);
    if (found.empty()) {
      throw UsageError(fmt::format("no scenes in `{}`", lang::printable(argument)));
    }
    names.insert(names.end(), found.begin(), found.end());
  }
  std::vector<std::string> each;
  for (std::string& name : names) {
    if (std::ranges::find(each, name) == each.end()) each.push_back(std::move(name));
  }
  return each;
}

}  // namespace sdlc::cli
