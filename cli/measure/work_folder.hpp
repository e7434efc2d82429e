#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/measure/details.hpp"
#include "cli/measure/json.hpp"
#include "render/measure/reference_error.hpp"
#include "render/measure/study.hpp"

namespace sdlc::cli {

/// Holds a file lock during its lifetime; the system also releases it when the process ends.
class FileLock {
 public:
  /// Creates the file if necessary. Throws render::IoError; `folder` is named as in use if another
  /// process holds the lock.
  FileLock(const std::filesystem::path& file, const std::filesystem::path& folder);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// The folder of a measurement, which stores each result immediately, so that the same command can
/// resume. Locked against other processes during its lifetime. Functions throw render::IoError.
class WorkFolder {
 public:
  /// The index of the other files; it is written last.
  static constexpr const char* kStudyName = "study.json";

  /// `identity`: values that must be unchanged to resume the measurement, as JSON with names that
  /// users know. Creates the folder if necessary, and rejects one with other files.
  WorkFolder(std::filesystem::path folder, Json identity);

  /// Loads the results of an earlier run, if any. Throws IoError if they are of another
  /// measurement, damaged or changed, with the reason. Files that study.json does not list belong
  /// to a run that ended before it was written, and are ignored.
  void load(render::StudyLedger& ledger, std::optional<render::ReferencePicture>& reference,
            Details& details);

  void save(const render::StudyLedger& ledger, const Details& details);
  void save(const render::ReferencePicture& reference);

 private:
  void check_identity(const Json& kept) const;
  void check_only_ours() const;
  /// The content of study.json.
  struct State {
    render::StudyLedger ledger{};
    DetailLayout layout{};
    std::vector<std::string> keys{};  ///< of the pictures
  };
  /// Throws std::invalid_argument if the text is not what save() wrote.
  State read_study(const std::string& text);
  /// Reads a file listed in study.json and verifies its digest.
  std::string read_whole(const std::string& name);
  /// Writes a file unless it is unchanged, and records its digest for study.json.
  void write(const std::string& name, std::string_view bytes);

  std::filesystem::path folder_;
  Json identity_;
  std::optional<FileLock> lock_;
  std::map<std::string, std::string> digests_;  ///< of all files except study.json, by name
};

}  // namespace sdlc::cli
