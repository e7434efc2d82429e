#include "cli/outputs.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <sys/stat.h>

#include "cli/frames.hpp"
#include "cli/usage_error.hpp"
#include "cli/video_writer.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/text/replace_all.hpp"
#include "render/film/film_file.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/codec_loader.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

std::string numbered(const std::string& name, std::optional<int> frame) {
  return frame ? name_of_frame(name, *frame) : name;
}

/// The identity of a regular file; only regular files are replaced when written.
std::optional<std::pair<dev_t, ino_t>> regular_file(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

/// Identifies a file by its folder and its name in it, independent of spelling; `target` has its
/// links resolved.
std::string place_of(const fs::path& target) {
  struct stat folder {};
  const bool is_there = ::stat(target.parent_path().c_str(), &folder) == 0;
  return is_there
             ? fmt::format("{}:{}/{}", folder.st_dev, folder.st_ino, target.filename().string())
             : target.string();
}

/// /dev/null can receive any number of outputs.
bool is_null_device(const fs::path& target) { return target == "/dev/null"; }

[[noreturn]] void throw_two_outputs(const std::string& name) {
  throw UsageError(fmt::format("two outputs go to `{}`", lang::printable(name)));
}

fs::path output_file(const std::string& name) {
  return name == kStandardStream ? "/dev/stdout" : name;
}

std::vector<Output> name_outputs(const OutputRequest& request, std::optional<int> frame) {
  std::vector<Output> outputs;
  for (const std::string& given : request.pictures) {
    if (given == kStandardStream) {
      outputs.push_back({.path = "standard output", .is_stdout = true});
      continue;
    }
    const std::string name = name_of_scene(given, request.input);
    Output& output = outputs.emplace_back(Output{.path = numbered(name, frame)});
    output.is_film = is_film_name(name);
    if (!output.is_film) output.format = output_format(name);
  }
  if (!outputs.empty() || request.has_videos) return outputs;
  const auto name = default_picture(request.of_scene, request.input, frame);
  if (!name) throw UsageError("a scene from `-` requires -o OUT or --stdin-filename NAME");
  return {{.path = *name,
           .format = output_format(*name),
           .may_make_folders = !request.of_scene.empty()}};
}

}  // namespace

bool has_name_mark(const std::string& name) { return name.find(kNameMark) != std::string::npos; }

std::string name_of_scene(std::string name, const std::string& scene) {
  const std::string stem = fs::path(scene).stem().string();
  const std::string_view mark = kNameMark;
  if (stem.empty() && name.find(mark) != std::string::npos) {
    throw UsageError("{name} in an output's name requires --stdin-filename NAME");
  }
  return lang::replace_all(std::move(name), mark, stem);
}

void check_absent(const fs::path& path) {
  std::error_code error;
  // A dangling link also exists.
  if (fs::exists(fs::symlink_status(path, error))) {
    throw render::IoError("write", path, "the file exists and --no-clobber was given");
  }
}

bool is_film_name(const fs::path& path) { return path.extension() == ".film"; }

FilmState film_state(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return FilmState::None;
  try {
    return render::read_film_head(path).shards.empty() ? FilmState::Unfinished
                                                       : FilmState::Finished;
  } catch (const render::FilmError&) {
    return FilmState::None;
  }
}

render::ImageFormat picture_format(const fs::path& path, const std::string& action) {
  if (const auto format = render::image_format_of(path)) return *format;
  const std::string extension = path.extension().string();
  const std::string_view written = std::string_view(extension).substr(extension.empty() ? 0 : 1);
  throw render::IoError(
      action, path,
      render::refusal_of_name(path) + lang::did_you_mean(written, render::image_extensions()));
}

render::ImageFormat output_format(const fs::path& path) {
  const render::ImageFormat format = picture_format(path, "write");
  try {
    render::check_image_codec(format);
  } catch (const render::IoError& missing) {
    throw render::IoError("write", path, missing.what());
  }
  return format;
}

void check_formats(const std::vector<std::string>& outputs) {
  for (const std::string& name : outputs) {
    if (name != kStandardStream && !is_film_name(name) && !video_format_of(name)) {
      output_format(name);
    }
  }
}

std::optional<std::string> default_picture(const std::string& of_scene, const std::string& input,
                                           std::optional<int> frame) {
  if (!of_scene.empty()) return numbered(of_scene, frame);
  if (input.empty()) return std::nullopt;
  const std::string mark = frame ? fmt::format(".{}", kFrameMark) : "";
  return numbered(fs::path(input).stem().string() + mark + ".png", frame);
}

void OutputSet::add(const std::string& name) {
  const fs::path file = output_file(name);
  const fs::path target = render::written_path(file);
  if (is_null_device(target)) return;
  const auto known = regular_file(file);
  const bool is_new = places_.insert(place_of(target)).second;
  if (!is_new || (known && !files_.insert(*known).second)) throw_two_outputs(name);
}

void OutputSet::check_not_in(const std::string& name) const {
  const fs::path file = output_file(name);
  const fs::path target = render::written_path(file);
  if (is_null_device(target)) return;
  const auto known = regular_file(file);
  if (places_.contains(place_of(target)) || (known && files_.contains(*known))) {
    throw_two_outputs(name);
  }
}

void InputSet::add(const std::string& name) {
  const auto file = regular_file(name == kStandardStream ? "/dev/stdin" : name);
  if (file) files_.insert(*file);
}

bool InputSet::contains(const std::string& name) const {
  if (files_.empty()) return false;
  const auto file = regular_file(output_file(name));
  return file && files_.contains(*file);
}

void InputSet::check_not_in(const std::string& name) const {
  if (!contains(name)) return;
  throw UsageError(
      fmt::format("`{}` is an input file and would be overwritten", lang::printable(name)));
}

namespace {

/// Checks the text of the name and links inside. Does not access the file system outside.
void check_sandbox(const OutputRequest& request, const fs::path& name) {
  if (request.sandbox == nullptr || !request.pictures.empty()) return;
  if (request.sandbox->resolve(name)) return;
  throw UsageError(fmt::format(
      "`{}` is outside the scene's folder, which --sandbox refuses; use -o to choose another place",
      lang::printable(name.string())));
}

/// Checks the names of unfinished pictures. `all`: all other outputs.
void check_partial_names(const std::vector<Output>& outputs, const OutputSet& all) {
  OutputSet partial;  // of one frame: at most one is interrupted
  for (const Output& output : outputs) {
    if (output.is_stdout || output.is_film) continue;
    const std::string name = partial_name(output.path).string();
    all.check_not_in(name);
    partial.add(name);
  }
}

/// Checks the names for all frames, before the first one is rendered.
void check_names(const OutputRequest& request) {
  const InputSet inputs(request.inputs);
  OutputSet all;
  if (!request.stats.empty()) {
    all.add(request.stats);
    inputs.check_not_in(request.stats);
  }
  const std::vector<std::optional<int>> one{request.frame};
  const auto& frames = request.all_frames.empty() ? one : request.all_frames;
  for (const auto& frame : frames) {
    for (const Output& output : name_outputs(request, frame)) {
      if (output.is_stdout) {
        inputs.check_not_in(kStandardStream);
        all.add(kStandardStream);
        continue;
      }
      const fs::path partial = output.is_film ? output.path : partial_name(output.path);
      for (const fs::path& name : {output.path, partial}) {
        check_sandbox(request, name);  // first: the next line follows links
        inputs.check_not_in(name.string());
      }
      all.add(output.path.string());
    }
  }
  for (const auto& frame : frames) {
    const std::vector<Output> outputs = name_outputs(request, frame);
    check_partial_names(outputs, all);
    if (!request.keeps_existing) continue;
    for (const Output& output : outputs) {
      if (output.is_stdout) continue;
      check_absent(output.path);
      if (!output.is_film) check_absent(partial_name(output.path));
    }
  }
  if (request.earlier == nullptr || request.all_frames.empty()) return;
  for (const auto& frame : frames) {
    for (const Output& output : name_outputs(request, frame)) {
      request.earlier->add(output.is_stdout ? kStandardStream : output.path.string());
    }
  }
}

}  // namespace

bool are_written(const OutputRequest& request) {
  if (request.pictures.empty() && request.of_scene.empty() && request.input.empty()) return false;
  return std::ranges::all_of(name_outputs(request, request.frame), [](const Output& output) {
    std::error_code error;
    if (output.is_film) return film_state(output.path) == FilmState::Finished;
    if (output.is_stdout || !fs::is_regular_file(output.path, error)) return false;
    return fs::file_size(output.path, error) > 0 && !error;
  });
}

std::vector<Output> plan_outputs(const OutputRequest& request) {
  check_names(request);
  const std::vector<Output> outputs = name_outputs(request, request.frame);
  for (const Output& output : outputs) {
    if (!output.is_film) {
      render::check_picture_size(request.width, request.height, output.format, output.path);
    }
    if (output.is_stdout) continue;
    if (output.may_make_folders) {
      render::check_creatable(output.path);
    } else {
      render::check_writable(output.path);
    }
  }
  if (!request.stats.empty() && request.stats != kStandardStream) {
    render::check_writable(request.stats);
    if (request.keeps_existing) check_absent(request.stats);
  }
  return outputs;
}

fs::path partial_name(const fs::path& path) {
  constexpr std::size_t kLongestName = 255;  // bytes; the limit of every common file system
  const std::string ending = ".partial" + path.extension().string();
  std::string stem = path.stem().string();
  const std::size_t room = kLongestName - std::min(kLongestName, ending.size());
  stem.resize(std::min(stem.size(), room));
  return path.parent_path() / (stem + ending);
}

}  // namespace sdlc::cli
