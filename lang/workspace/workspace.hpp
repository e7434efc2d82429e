#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::lang {

/// The texts that programs read: those open in an editor, and the files of a file system. An open
/// text wins over the file of its path. Used by one thread at a time.
class Workspace final : public FileSystem {
 public:
  explicit Workspace(const FileSystem& disk) : disk_(disk) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  // Open texts

  /// Opens a text, or replaces it.
  void open(const std::filesystem::path& path, std::string text, int version = 0);
  /// The file on disk counts again.
  void close(const std::filesystem::path& path);
  bool is_open(const std::filesystem::path& path) const;

  // Documents

  /// The text at `path`, as it is now, called `name` in messages; null with `error` set if it
  /// cannot be read. A document that is in use is returned again as long as its name, content and
  /// version stay the same, so that it is not parsed again. An open text and the files that it
  /// depends on count as in use; and so do those that depend on it, until they are too large. Of a
  /// file of more than `max_bytes` bytes the first `max_bytes` + 1 are read.
  std::shared_ptr<const Document> load(const std::filesystem::path& path, const std::string& name,
                                       std::uint64_t max_bytes, std::error_code& error);
  std::shared_ptr<const Document> load(const std::filesystem::path& path, std::uint64_t max_bytes,
                                       std::error_code& error) {
    return load(path, path.string(), max_bytes, error);
  }

  // Imports and includes

  /// Replaces what `file` imports and includes.
  void set_dependencies(const std::filesystem::path& file,
                        const std::vector<std::filesystem::path>& dependencies);
  /// The files that depend on `path`, directly or through others, by name.
  std::vector<std::filesystem::path> dependents(const std::filesystem::path& path) const;
  /// The dependents that no other file imports or includes, except files that they import
  /// themselves: the scenes to check when an imported file changes.
  std::vector<std::filesystem::path> roots(const std::filesystem::path& path) const;

  // FileSystem, with open texts in place of their files

  std::optional<std::string> read(const std::filesystem::path& path, std::uint64_t most,
                                  std::error_code& error) const override;
  std::vector<FolderEntry> list(const std::filesystem::path& folder) const override;
  bool is_special(const std::filesystem::path& path) const override;
  std::optional<std::filesystem::path> link_target(
      const std::filesystem::path& path) const override {
    return disk_.link_target(path);
  }
  std::filesystem::path identity(const std::filesystem::path& path) const override {
    return disk_.identity(path);
  }

 private:
  struct OpenText {
    std::string text;
    int version = 0;
  };

  struct KeptDocument {
    std::filesystem::path identity;
    std::shared_ptr<const Document> document;
  };

  const OpenText* find_open(const std::filesystem::path& path) const;
  std::vector<std::filesystem::path> dependents_of(const std::filesystem::path& start) const;
  std::set<std::filesystem::path> read_by_open_texts() const;
  /// Releases documents that no open text has to do with; if the others are too large, those that
  /// no open text reads.
  void drop_unused();
  std::size_t kept_bytes() const;

  /// A document takes about 30 times the memory of its text.
  static constexpr std::size_t kMaxKeptBytes = std::size_t{4} << 20;

  const FileSystem& disk_;
  std::map<std::filesystem::path, OpenText> open_;               // by identity
  std::map<std::string, std::weak_ptr<const Document>> in_use_;  // by name
  std::map<std::string, KeptDocument> kept_;                     // by name
  std::size_t loaded_bytes_ = 0;  // of kept documents, since drop_unused()
  std::map<std::filesystem::path, std::set<std::filesystem::path>> dependents_;       // by identity
  std::map<std::filesystem::path, std::vector<std::filesystem::path>> dependencies_;  // by identity
};

}  // namespace sdlc::lang
