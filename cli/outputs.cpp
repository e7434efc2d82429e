#include "cli/outputs.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/frames.hpp"
#include "cli/usage_error.hpp"
#include "cli/words.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

std::string numbered(const std::string& name, std::optional<int> frame) {
  return frame ? name_of_frame(name, *frame) : name;
}

std::vector<Output> name_outputs(const OutputRequest& request) {
  std::vector<Output> outputs;
  for (const std::string& name : request.pictures) {
    if (name == kStandardStream) {
      outputs.push_back({.path = "standard output", .is_stdout = true});
    } else {
      outputs.push_back(
          {.path = numbered(name, request.frame), .format = picture_format(name, "write")});
    }
  }
  if (!outputs.empty()) return outputs;
  const auto name = default_picture(request.of_scene, request.input, request.frame);
  if (!name) throw UsageError("a scene from `-` needs -o OUT or --stdin-filename NAME");
  return {{.path = *name,
           .format = picture_format(*name, "write"),
           .may_make_folders = !request.of_scene.empty()}};
}

void check_absent(const fs::path& path) {
  std::error_code error;
  // A link that leads nowhere is there too.
  if (fs::exists(fs::symlink_status(path, error))) {
    throw render::IoError("write", path, "the file exists and --no-clobber was given");
  }
}

}  // namespace

render::ImageFormat picture_format(const fs::path& path, const std::string& action) {
  if (const auto format = render::image_format_of(path)) return *format;
  const std::string extension = path.extension().string();
  const auto known = render::image_extensions();
  const std::string cause = extension.empty() ? "the name has no extension"
                                              : fmt::format("unknown extension `{}`", extension);
  const std::string_view written = std::string_view(extension).substr(extension.empty() ? 0 : 1);
  throw render::IoError(action, path,
                        fmt::format("{}; known are {}{}", cause, fmt::join(known, " "),
                                    did_you_mean(written, known)));
}

std::optional<std::string> default_picture(const std::string& of_scene, const std::string& input,
                                           std::optional<int> frame) {
  if (!of_scene.empty()) return numbered(of_scene, frame);
  if (input.empty()) return std::nullopt;
  const std::string mark = frame ? fmt::format(".{}", kFrameMark) : "";
  return numbered(fs::path(input).stem().string() + mark + ".png", frame);
}

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal();
}

void check_distinct(const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_known = std::any_of(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                      [&](const std::string& other) {
                                        if (names[i] == kStandardStream || other == kStandardStream)
                                          return names[i] == other;
                                        return is_same_file(names[i], other);
                                      });
    if (is_known)
      throw UsageError(fmt::format("two outputs go to `{}`", lang::printable(names[i])));
  }
}

std::vector<Output> plan_outputs(const OutputRequest& request) {
  const std::vector<Output> outputs = name_outputs(request);
  std::vector<std::string> names;
  for (const Output& output : outputs) {
    names.push_back(output.is_stdout ? kStandardStream : output.path.string());
  }
  if (!request.stats.empty()) names.push_back(request.stats);
  check_distinct(names);
  for (const Output& output : outputs) {
    render::check_picture_size(request.width, request.height, output.format, output.path);
    if (output.is_stdout) continue;
    if (output.may_make_folders) {
      render::check_creatable(output.path);
    } else {
      render::check_writable(output.path);
    }
    if (!request.keeps_existing) continue;
    check_absent(output.path);
    check_absent(partial_name(output.path));
  }
  if (!request.stats.empty() && request.stats != kStandardStream) {
    render::check_writable(request.stats);
    if (request.keeps_existing) check_absent(request.stats);
  }
  return outputs;
}

fs::path partial_name(const fs::path& path) {
  constexpr std::size_t kLongestName = 255;  // bytes, of every file system in common use
  const std::string ending = ".partial" + path.extension().string();
  std::string stem = path.stem().string();
  const std::size_t room = kLongestName - std::min(kLongestName, ending.size());
  stem.resize(std::min(stem.size(), room));
  return path.parent_path() / (stem + ending);
}

}  // namespace sdlc::cli
