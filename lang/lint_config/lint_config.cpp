#include "lang/lint_config/lint_config.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

// Header-only: the library's binary would have to be loaded at each start.
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

#include "lang/source/sandbox.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// The name of the type in messages, such as "an array".
std::string_view describe(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "an array";
    case toml::node_type::string: return "a string";
    case toml::node_type::integer: return "a whole number";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
  }
}

class ConfigReader {
 public:
  ConfigReader(const std::string& name, std::vector<std::string>& errors)
      : name_(name), errors_(errors) {}

  LintConfig read(std::string_view text, const fs::path& folder) {
    LintConfig config{.folder = folder};
    try {
      const toml::table root = toml::parse(text, name_);
      for (const auto& [key, value] : root) {
        if (key.str() == "lint") {
          read_lint(value, config);
        } else {
          refuse_key(key, "", std::array<std::string_view, 1>{"lint"});
        }
      }
    } catch (const toml::parse_error& error) {
      report(error.source(), error.description());
    }
    // The library sorts keys alphabetically.
    std::ranges::stable_sort(found_,
                             [](const Mistake& a, const Mistake& b) { return a.where < b.where; });
    for (const Mistake& mistake : found_) errors_.push_back(mistake.text);
    return config;
  }

 private:
  struct Mistake {
    toml::source_position where;
    std::string text;
  };

  void report(const toml::source_region& where, std::string_view message) {
    found_.push_back({where.begin, fmt::format("{}:{}:{}: {}", printable(name_), where.begin.line,
                                               where.begin.column, printable(message))});
  }

  void refuse_key(const toml::key& key, std::string_view table,
                  std::span<const std::string_view> known) {
    report(key.source(),
           fmt::format("unknown key `{}`{}{}", key.str(), table, did_you_mean(key.str(), known)));
  }

  void refuse_type(const toml::node& value, std::string_view key, std::string_view wanted) {
    report(value.source(), fmt::format("`{}` takes {}, not {}", key, wanted, describe(value)));
  }

  void read_lint(const toml::node& value, LintConfig& config) {
    static constexpr std::array<std::string_view, 4> kKeys{"select", "ignore", "max-warnings",
                                                           "overrides"};
    const toml::table* table = value.as_table();
    if (table == nullptr) return refuse_type(value, "lint", "a table: [lint]");
    for (const auto& [key, entry] : *table) {
      if (key.str() == "select") {
        config.filter.selected = read_codes(key.str(), entry);
      } else if (key.str() == "ignore") {
        config.filter.ignored = read_codes(key.str(), entry);
      } else if (key.str() == "max-warnings") {
        config.max_warnings = read_count(key.str(), entry);
      } else if (key.str() == "overrides") {
        read_overrides(entry, config);
      } else {
        refuse_key(key, " in [lint]", kKeys);
      }
    }
  }

  void read_overrides(const toml::node& value, LintConfig& config) {
    const toml::array* tables = value.as_array();
    if (tables == nullptr) return refuse_type(value, "overrides", "tables: [[lint.overrides]]");
    for (const toml::node& entry : *tables) {
      if (const toml::table* table = entry.as_table()) {
        config.overrides.push_back(read_override(*table));
      } else {
        refuse_type(entry, "overrides", "tables: [[lint.overrides]]");
      }
    }
  }

  LintOverride read_override(const toml::table& table) {
    static constexpr std::array<std::string_view, 3> kKeys{"files", "select", "ignore"};
    LintOverride result;
    bool has_files = false;
    for (const auto& [key, entry] : table) {
      if (key.str() == "files") {
        has_files = true;
        result.files = read_globs(key.str(), entry);
      } else if (key.str() == "select") {
        result.filter.selected = read_codes(key.str(), entry);
      } else if (key.str() == "ignore") {
        result.filter.ignored = read_codes(key.str(), entry);
      } else {
        refuse_key(key, " in [[lint.overrides]]", kKeys);
      }
    }
    if (!has_files) report(table.source(), "[[lint.overrides]] has no `files`");
    return result;
  }

  std::optional<std::uint64_t> read_count(std::string_view key, const toml::node& value) {
    const auto* number = value.as_integer();
    if (number != nullptr && number->get() >= 0) return static_cast<std::uint64_t>(number->get());
    if (number == nullptr) {
      refuse_type(value, key, "a whole number");
    } else {
      report(value.source(), fmt::format("`{}` cannot be negative", key));
    }
    return std::nullopt;
  }

  std::vector<std::string> read_codes(std::string_view key, const toml::node& value) {
    std::vector<std::string> codes;
    read_strings(key, value, "an array of codes, such as [\"E104\", \"W4\"]",
                 [&](const std::string& text) { codes.push_back(parse_code(text)); });
    return codes;
  }

  std::vector<Glob> read_globs(std::string_view key, const toml::node& value) {
    std::vector<Glob> globs;
    read_strings(
        key, value, "an array of patterns, such as [\"library/**\"]", [&](const std::string& text) {
          try {
            globs.emplace_back(text);
          } catch (const std::invalid_argument& error) {
            throw std::invalid_argument(fmt::format("the pattern `{}` {}", text, error.what()));
          }
        });
    return globs;
  }

  /// Passes each string to `take`; exceptions are reported at the string.
  template <typename Take>
  void read_strings(std::string_view key, const toml::node& value, std::string_view wanted,
                    Take take) {
    const toml::array* array = value.as_array();
    if (array == nullptr) return refuse_type(value, key, wanted);
    for (const toml::node& element : *array) {
      const auto* text = element.as_string();
      if (text == nullptr) {
        refuse_type(element, key, wanted);
        continue;
      }
      try {
        take(text->get());
      } catch (const std::invalid_argument& error) {
        report(element.source(), error.what());
      }
    }
  }

  const std::string& name_;
  std::vector<std::string>& errors_;
  std::vector<Mistake> found_;
};

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

/// The path relative to the working folder, for messages.
std::string shown_name(const fs::path& path) {
  std::error_code no_folder;
  const fs::path shown = path.lexically_proximate(fs::current_path(no_folder));
  return shown.empty() ? path.string() : shown.string();
}

}  // namespace

bool LintConfig::wants(std::string_view code, const fs::path& file) const {
  const std::string path = file.lexically_relative(folder).generic_string();
  const auto is_for_it = [&](const Glob& glob) { return glob.matches(path); };
  for (auto each = overrides.rbegin(); each != overrides.rend(); ++each) {
    if (!std::ranges::any_of(each->files, is_for_it)) continue;
    if (const auto answer = each->filter.answer(code)) return *answer;
  }
  return filter.wants(code);
}

LintConfig parse_lint_config(std::string_view text, const std::string& name, const fs::path& folder,
                             std::vector<std::string>& errors) {
  return ConfigReader(name, errors).read(text, folder);
}

LintConfigs::LintConfigs(const LintConfigOptions& options, const Workspace& workspace)
    : workspace_(workspace),
      searches_(options.file.empty() && !options.is_unused),
      is_sandboxed_(options.is_sandboxed) {
  if (options.file.empty()) return;
  const fs::path path = fs::absolute(options.file).lexically_normal();
  if (auto config = read(path)) {
    common_ = std::move(*config);
  } else {
    throw render::IoError("read", options.file, "No such file or directory");
  }
}

const LintConfig& LintConfigs::of(const std::string& file, const std::string& scene) {
  if (!searches_) return common_;
  return in_folder(folder_of(file), is_sandboxed_ ? folder_of(scene) : fs::path());
}

const LintConfig& LintConfigs::in_folder(const fs::path& folder, const fs::path& last) {
  if (const auto known = nearest_.find({folder, last}); known != nearest_.end()) {
    return *known->second;
  }
  const LintConfig* found = &common_;
  const bool is_last = folder == last || !folder.has_relative_path();
  std::error_code ignored;
  if (const auto read_before = own_.find(folder); read_before != own_.end()) {
    found = &read_before->second;
  } else if (auto own = read(folder / kLintConfigName)) {
    found = &own_.emplace(folder, std::move(*own)).first->second;
  } else if (!is_last && !fs::exists(folder / ".git", ignored)) {
    found = &in_folder(folder.parent_path(), last);
  }
  nearest_.emplace(std::pair(folder, last), found);
  return *found;
}

std::optional<LintConfig> LintConfigs::read(const fs::path& path) {
  constexpr std::uint64_t kMaxBytes = std::uint64_t{1} << 20;
  if (searches_ && is_sandboxed_ && !Sandbox(workspace_, path).resolve(path)) {
    throw render::IoError("read", shown_name(path),
                          "it is outside its folder, which --sandbox refuses");
  }
  const bool is_searched = path.filename() == kLintConfigName;
  if (is_searched && workspace_.is_special(path)) {
    throw render::IoError("read", shown_name(path), "it is not a regular file");
  }
  std::error_code error;
  const std::optional<std::string> text = workspace_.read(path, kMaxBytes, error);
  if (text && text->size() > kMaxBytes) {
    throw render::IoError("read", shown_name(path),
                          fmt::format("it has more than {} bytes", kMaxBytes));
  }
  if (!text) {
    if (error == std::errc::no_such_file_or_directory || error == std::errc::not_a_directory) {
      return std::nullopt;
    }
    throw render::IoError("read", shown_name(path), error.message());
  }
  return parse_lint_config(*text, shown_name(path), path.parent_path(), errors_);
}

}  // namespace sdlc::lang
