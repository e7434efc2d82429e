#pragma once

#include <cstdint>
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

/// The name of standard output (and input) on the command line.
inline constexpr const char* kStandardStream = "-";

/// A picture or film to write.
struct Output {
  std::filesystem::path path;
  render::ImageFormat format = render::ImageFormat::Png;
  bool is_film = false;           ///< has no format
  bool is_stdout = false;         ///< write to standard output instead, as PNG
  bool may_make_folders = false;  ///< named by the scene, so its folder may be created
};

class OutputSet;

/// The output settings of the command line and the scene.
struct OutputRequest {
  std::vector<std::string> pictures;  ///< from the command line
  bool has_videos = false;            ///< so that it need not have pictures
  std::string of_scene;               ///< from the scene; used if the command line has none
  std::string input;            ///< otherwise its stem names the picture; empty for standard input
  std::string stats{};          ///< from --stats; empty for none
  bool keeps_existing = false;  ///< --no-clobber
  int width = 0, height = 0;    ///< of the picture
  std::optional<int> frame = {};  ///< replaces #### in names
  /// All frames that will be rendered, if this is the first of several.
  std::vector<std::optional<int>> all_frames = {};
  std::vector<std::string> inputs = {};  ///< input files, which must not be replaced
  /// Those of the scenes before; those of all_frames are added. May be null.
  OutputSet* earlier = nullptr;
  /// The folder that must contain the picture unless the command line names it.
  const lang::Sandbox* sandbox = nullptr;
};

bool is_film_name(const std::filesystem::path& path);

enum class FilmState : std::uint8_t {
  None,        ///< no film that can be read
  Unfinished,  ///< a checkpoint
  Finished,
};
/// Reads only the beginning of the file. Throws IoError.
FilmState film_state(const std::filesystem::path& path);

/// The format that the extension names. Throws IoError, whose message begins "cannot ACTION", with
/// a suggested extension.
render::ImageFormat picture_format(const std::filesystem::path& path, const std::string& action);

/// The same for a picture to write. Throws IoError if this installation cannot write it.
render::ImageFormat output_format(const std::filesystem::path& path);

/// Checks the extensions of outputs before the work for them begins; those of videos are known only
/// with the scene. Throws IoError.
void check_formats(const std::vector<std::string>& outputs);

/// The picture's file if the command line has none: that of the scene, otherwise the stem of the
/// input with .png; nullopt if neither has a name. The frame number is inserted.
std::optional<std::string> default_picture(const std::string& of_scene, const std::string& input,
                                           std::optional<int> frame);

/// A set of output files, independent of spelling, links and hard links.
class OutputSet {
 public:
  /// Throws UsageError if the file is already in the set. `name` may be standard output.
  void add(const std::string& name);
  /// Throws UsageError if the file is in the set; does not add it.
  void check_not_in(const std::string& name) const;

 private:
  std::set<std::string> places_;  // folder and name, with links resolved
  std::set<std::pair<dev_t, ino_t>> files_;
};

/// A set of input files.
class InputSet {
 public:
  InputSet() = default;
  explicit InputSet(const std::vector<std::string>& names) {
    for (const std::string& name : names) add(name);
  }

  /// `name` may be standard input. Files that are not regular cannot be replaced, and are ignored.
  void add(const std::string& name);
  /// Whether `name`, possibly standard output, is one of them, or a link to one.
  bool contains(const std::string& name) const;
  /// Throws UsageError if it is.
  void check_not_in(const std::string& name) const;

 private:
  std::set<std::pair<dev_t, ino_t>> files_;
};

/// The placeholder for the name of the scene, without folder and extension, in file names.
inline constexpr const char* kNameMark = "{name}";

bool has_name_mark(const std::string& name);

/// The name with each kNameMark replaced by the stem of the scene's name. Throws UsageError if the
/// scene has none.
std::string name_of_scene(std::string name, const std::string& scene);

/// Throws IoError if the file exists: --no-clobber.
void check_absent(const std::filesystem::path& path);

/// Whether all files of the request are there, and not empty. Does not look at names that only the
/// scene knows.
bool are_written(const OutputRequest& request);

/// Decides which files are written, and reports foreseeable failures before anything is rendered.
/// Changes nothing. Throws UsageError and render::IoError.
std::vector<Output> plan_outputs(const OutputRequest& request);

/// The path of an unfinished picture: NAME.partial.EXT, with NAME shortened to the limit of file
/// systems.
std::filesystem::path partial_name(const std::filesystem::path& path);

}  // namespace sdlc::cli
