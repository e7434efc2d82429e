#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/measure/details.hpp"
#include "render/measure/reference_error.hpp"
#include "render/measure/study.hpp"

namespace sdlc::cli {

/// A folder in which a measurement keeps all that it has done, each thing as soon as it is there,
/// so that the same command goes on where it was stopped. Functions throw render::IoError.
class WorkFolder {
 public:
  /// `identity`: what has to be the same for the measurement to be gone on with, as JSON with names
  /// that users know. Makes the folder where there is none.
  WorkFolder(std::filesystem::path folder, Json identity);

  /// What is there of an earlier run; false if that is nothing. Throws IoError too where it is of
  /// something else, or not readable, and says what differs.
  bool load(render::StudyLedger& ledger, std::optional<render::ReferencePicture>& reference,
            Details& details) const;

  void save(const render::StudyLedger& ledger, const Details& details) const;
  void save(const render::ReferencePicture& reference) const;
  /// The pictures under this key.
  void save(const std::string& key, const PictureDetails& pictures) const;

 private:
  void check_identity(const Json& kept) const;
  std::filesystem::path folder_;
  Json identity_;
};

}  // namespace sdlc::cli
