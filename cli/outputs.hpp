#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "lang/source/sandbox.hpp"
#include "render/image/image.hpp"

namespace sdlc::cli {

/// Standard output, where the command line names it.
inline constexpr const char* kStandardStream = "-";

/// A picture file to be written.
struct Output {
  std::filesystem::path path;
  render::ImageFormat format = render::ImageFormat::Png;
  bool is_stdout = false;         ///< the picture goes to standard output instead, as PNG
  bool may_make_folders = false;  ///< the scene names the file: its folder is made with it
};

/// What the command line and the scene say about where things go.
struct OutputRequest {
  std::vector<std::string> pictures;  ///< of the command line
  std::string of_scene;               ///< the scene's own; used when the command line names none
  std::string input;                  ///< else its stem names the picture; empty for standard input
  std::string stats;                  ///< of --stats; empty: none
  bool keeps_existing = false;        ///< --no-clobber
  int width = 0, height = 0;          ///< of the picture
  std::optional<int> frame = {};      ///< its number takes the place of #### in names
  /// All that will be rendered, where this is the first of several.
  std::vector<std::optional<int>> all_frames = {};
  std::vector<std::string> inputs = {};  ///< files that are read, and not to be replaced
  /// Where the picture has to be unless the command line names it.
  const lang::Sandbox* sandbox = nullptr;
};

/// The format that the extension names. Throws IoError, which begins "cannot ACTION", with the
/// extension that was probably meant.
render::ImageFormat picture_format(const std::filesystem::path& path, const std::string& action);

/// The picture's file when the command line names none: the scene's own, else the stem of the
/// input's with .png; nothing where neither has a name. A frame's number is put in.
std::optional<std::string> default_picture(const std::string& of_scene, const std::string& input,
                                           std::optional<int> frame);

/// Files that are written, each once, whatever it is called: other spellings, links, hard links.
class OutputSet {
 public:
  /// Throws UsageError where the file is in it already. `name`: perhaps standard output.
  void add(const std::string& name);
  /// Throws UsageError where the file is in it; does not add it.
  void check_not_in(const std::string& name) const;

 private:
  std::set<std::string> places_;  // the folder and the name in it, links followed
  std::set<std::pair<dev_t, ino_t>> files_;
};

/// Files that are read.
class InputSet {
 public:
  InputSet() = default;
  explicit InputSet(const std::vector<std::string>& names) {
    for (const std::string& name : names) add(name);
  }

  /// `name`: perhaps standard input. What is no regular file cannot be replaced, and is ignored.
  void add(const std::string& name);
  /// Whether `name`, perhaps standard output, is one of them, or a link to one.
  bool contains(const std::string& name) const;
  /// Throws UsageError if so.
  void check_not_in(const std::string& name) const;

 private:
  std::set<std::pair<dev_t, ino_t>> files_;
};

/// Decides which files are written, and refuses what is known to fail before anything is rendered.
/// It changes nothing. Throws UsageError and render::IoError.
std::vector<Output> plan_outputs(const OutputRequest& request);

/// Where an unfinished picture goes: NAME.partial.EXT, with a NAME as long as a file system takes.
std::filesystem::path partial_name(const std::filesystem::path& path);

}  // namespace sdlc::cli
