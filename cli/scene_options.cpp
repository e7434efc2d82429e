#include "cli/scene_options.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/outputs.hpp"
#include "lang/pack/zip.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

/// Splits NAME=VALUE.
std::pair<std::string, std::string> split_pair(const std::string& flag, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ArgumentError(flag, fmt::format("takes NAME=VALUE, not `{}`", lang::printable(text)));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

/// Parses `4096` or `64MiB`.
std::optional<std::uint64_t> read_limit(std::string_view text) {
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  const std::string_view unit = text.substr(static_cast<std::size_t>(stop - text.data()));
  int shift = 0;
  for (const std::string_view known : {"", "KiB", "MiB", "GiB"}) {
    const bool fits = number <= std::numeric_limits<std::uint64_t>::max() >> shift;
    if (unit == known) return fits ? std::optional(number << shift) : std::nullopt;
    shift += 10;
  }
  return std::nullopt;
}

void set_limit(const std::string& text, lang::Limits& limits) {
  const auto [name, value] = split_pair("--limit", text);
  const auto found = std::find_if(lang::kLimits.begin(), lang::kLimits.end(),
                                  [&name = name](const auto& limit) { return limit.name == name; });
  if (found == lang::kLimits.end()) {
    std::vector<std::string_view> names;
    for (const lang::LimitInfo& limit : lang::kLimits) names.push_back(limit.name);
    throw ArgumentError("--limit", fmt::format("unknown limit `{}`{}", lang::printable(name),
                                               lang::did_you_mean(name, names)));
  }
  const std::optional<std::uint64_t> number = read_limit(value);
  if (!number) {
    throw ArgumentError(
        "--limit", fmt::format("{} takes a whole number, optionally with KiB, MiB or GiB, not `{}`",
                               name, lang::printable(value)));
  }
  limits.*(found->limit) = *number;
}

}  // namespace

void add_limit_option(Command& command, lang::Limits& limits) {
  std::string all;
  for (const lang::LimitInfo& limit : lang::kLimits) {
    all += fmt::format("{}{} ({}: {})", all.empty() ? "" : ", ", limit.name, limits.*(limit.limit),
                       limit.doc);
  }
  command
      .add_repeated(
          "--limit",
          [&limits](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) set_limit(pair, limits);
          },
          "Change the resource limits of a scene: " + all)
      .type_name("NAME=N");
}

void add_reading_options(Command& command, ReadingOptions& options) {
  command.add_flag("--sandbox", options.is_sandboxed,
                   "Refuse to read files outside the scene's folder, and to write files there that "
                   "the scene names");
  add_limit_option(command, options.limits);
  command.add_text("--stdin-filename", options.stdin_filename,
                   "Name of a scene from standard input in messages");
}

std::string stdin_name(const ReadingOptions& options) {
  return options.stdin_filename.empty() ? "<stdin>" : options.stdin_filename;
}

std::shared_ptr<const lang::Document> read_document(const std::string& path,
                                                    const std::string& name, const Environment& env,
                                                    std::uint64_t max_bytes) {
  std::error_code error;
  auto document = env.workspace.load(path, name, max_bytes, error);
  if (!document) throw render::IoError("read", name, error.message());
  if (lang::is_zip(document->text())) {
    throw render::IoError("read", name,
                          "it is a ZIP archive; render, inspect, lint, measure and convert read "
                          "packs, by the name of the file");
  }
  return document;
}

void refuse_special(const std::string& path, const Environment& env) {
  if (path == kStandardStream || !env.workspace.is_special(path)) return;
  throw render::IoError("replace", path, "it is not a regular file");
}

lang::ProgramOptions program_options(const ReadingOptions& options, const Environment& env) {
  return {.workspace = &env.workspace,
          .limits = options.limits,
          .is_sandboxed = options.is_sandboxed,
          .sets = {}};
}

std::string SceneOptions::given_name() const {
  return file == kStandardStream ? reading.stdin_filename : file;
}

std::string SceneOptions::name() const {
  return file == kStandardStream ? stdin_name(reading) : file;
}

void add_set_option(Command& command, std::vector<lang::SetOption>& sets) {
  command
      .add_repeated(
          "--set",
          [&sets](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) {
              auto [name, value] = split_pair("--set", pair);
              sets.push_back({.name = std::move(name), .value = std::move(value)});
            }
          },
          "Set a param of the scene (may be repeated)")
      .type_name("NAME=VALUE");
}

void add_scene_options(Command& command, SceneOptions& options) {
  command.add_text("FILE", options.file, "The scene; `-` reads standard input").required();
  add_set_option(command, options.sets);
  add_reading_options(command, options.reading);
  add_diagnostics_options(command, options.diagnostics);
}

void enter_pack(SceneOptions& options, const Environment& env) {
  options.pack = open_pack(options.file, options.reading.limits, env.workspace);
  if (options.pack) options.file = options.pack->scene();
}

std::shared_ptr<const lang::Document> read_scene(const SceneOptions& options,
                                                 const Environment& env) {
  if (options.pack) return options.pack->read_scene();
  return read_document(options.file, options.name(), env, options.reading.limits.any_file());
}

lang::ProgramOptions program_options(const SceneOptions& options, const Environment& env) {
  lang::ProgramOptions program = program_options(options.reading, env);
  if (options.pack) options.pack->confine(program);
  program.sets = options.sets;
  return program;
}

}  // namespace sdlc::cli
