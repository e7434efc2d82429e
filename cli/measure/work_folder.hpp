#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/measure/details.hpp"
#include "render/measure/reference_error.hpp"
#include "render/measure/study.hpp"

namespace sdlc::cli {

/// Holds a file's lock for as long as it lives; the system lets go of it too when the process ends,
/// however it does.
class FileLock {
 public:
  /// Makes the file where there is none. Throws render::IoError; `folder`: what is in use where
  /// another process holds it.
  FileLock(const std::filesystem::path& file, const std::filesystem::path& folder);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int descriptor_;
};

/// A folder in which a measurement keeps all that it has done, each thing as soon as it is there,
/// so that the same command goes on where it was stopped. Nobody else can as long as this lives.
/// Functions throw render::IoError.
class WorkFolder {
 public:
  /// What says what the others are; it is written last.
  static constexpr const char* kStudyName = "study.json";

  /// `identity`: what has to be the same for the measurement to be gone on with, as JSON with names
  /// that users know. Makes the folder where there is none, and refuses one with other files.
  WorkFolder(std::filesystem::path folder, Json identity);

  /// What is there of an earlier run; false if that is nothing. Throws IoError too where it is of
  /// something else, damaged or not readable, and says what. Pictures and a reference that
  /// study.json does not name are of a run that ended before it was written, and count for nothing.
  bool load(render::StudyLedger& ledger, std::optional<render::ReferencePicture>& reference,
            Details& details);

  void save(const render::StudyLedger& ledger, const Details& details);
  void save(const render::ReferencePicture& reference);
  /// The pictures under this key.
  void save(const std::string& key, const PictureDetails& pictures);

 private:
  void check_identity(const Json& kept) const;
  void check_only_ours() const;
  void read_study(const std::string& text, render::StudyLedger& ledger, Details& details,
                  std::vector<std::string>& keys);
  /// A file that study.json names, just as it was written.
  std::string read_whole(const std::string& name) const;
  /// Writes it and remembers its digest for study.json.
  void write(const std::string& name, std::string_view bytes);

  std::filesystem::path folder_;
  Json identity_;
  std::optional<FileLock> lock_;
  std::map<std::string, std::string> digests_;  ///< of all files but study.json, by name
};

}  // namespace sdlc::cli
