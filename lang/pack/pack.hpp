#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "lang/pack/zip.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A scene with everything that it reads. Names are relative, with `/` between folders, and such
/// that the paths in imports and includes lead from one file to the other.
struct Pack {
  std::string scene;                         ///< the name of the scene
  std::map<std::string, std::string> files;  ///< the texts by name, with that of the scene
};

/// The entry of the archive that names the scene: {"format": 1, "scene": "rooms/ball.scene"}.
inline constexpr const char* kPackIndex = "sdlc-pack.json";

/// Throws ZipError for what is no pack, is damaged, or exceeds the limits.
Pack read_pack(std::string_view archive, const Limits& limits);

/// The same bytes for the same pack. Throws ZipError for names that an archive must not have.
std::string write_pack(const Pack& pack);

/// The files of a pack as if the archive were a folder, `ball.sdlc.zip/rooms/ball.scene`. Nothing
/// else can be read, whatever a path says: the disk is not known here.
class PackFiles final : public FileSystem {
 public:
  /// `archive`: the path of the pack, as the user named it.
  PackFiles(const std::filesystem::path& archive, Pack pack)
      : archive_(archive), root_(archive.lexically_normal()), pack_(std::move(pack)) {}

  std::filesystem::path scene() const { return archive_ / pack_.scene; }
  /// Frees the texts: from then on the pack is empty.
  void release() { pack_.files.clear(); }

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t max,
                                  std::error_code& error) const override;
  std::vector<FolderEntry> list(const std::filesystem::path& folder) const override;

 private:
  /// Empty for the root; nullopt for a path outside.
  std::optional<std::string> name_of(const std::filesystem::path& path) const;

  std::filesystem::path archive_, root_;
  Pack pack_;
};

}  // namespace sdlc::lang
