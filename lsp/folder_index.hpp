#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/position_encoding.hpp"
#include "lang/source/source.hpp"
#include "lsp/file_facts.hpp"
#include "lsp/folder_walk.hpp"

namespace sdlc::lsp {

/// What the scenes in the folders of a workspace import and include, and the names that they
/// declare: read in the background, on a thread of its own if it has one, and kept without their
/// texts. Open texts win over their files. Paths in answers are identities (lang::FileSystem). All
/// functions may be called by every thread.
class FolderIndex {
 public:
  struct Progress {
    std::size_t read = 0;     ///< scenes
    bool is_limited = false;  ///< there are more files than the index reads
  };
  /// Called on the thread of the index. They must not wait for it.
  struct Events {
    /// A walk of the folders that takes more than a moment has begun, goes on, has ended. Begin and
    /// end are called in pairs.
    std::function<void()> begin = {};
    std::function<void(const Progress&)> report = {};
    std::function<void(const Progress&)> end = {};
    /// The answer of roots_of() may have changed: at the end of a walk, and after it whenever the
    /// imports of a file change.
    std::function<void()> changed = {};
  };

  static constexpr std::size_t kMaxScenes = 10'000;

  /// `files` must outlive the index, and may be used by several threads. Without a thread,
  /// run_due() does the work.
  FolderIndex(const lang::FileSystem& files, Events events, std::size_t max_scenes = kMaxScenes,
              bool has_thread = true);
  /// Stops at once, in the middle of a file if need be.
  ~FolderIndex();
  FolderIndex(const FolderIndex&) = delete;
  FolderIndex& operator=(const FolderIndex&) = delete;

  /// Of the columns of symbols; call it before set_folders().
  void set_encoding(lang::PositionEncoding encoding);
  /// Does all work that is due, on the calling thread.
  void run_due();
  /// Replaces the folders and walks all of them.
  void set_folders(const std::vector<std::filesystem::path>& folders);

  /// A file or folder was created, changed or removed on disk.
  void update(const std::filesystem::path& path);
  /// A text is open, or was changed; it is read as soon as nobody types.
  void open(const std::filesystem::path& path, std::shared_ptr<const std::string> text);
  /// The file counts again.
  void close(const std::filesystem::path& path);

  /// The scenes that read the file, directly or through others: first those that no other scene
  /// reads, except in a cycle; both parts by name. Empty if there is none.
  std::vector<std::filesystem::path> roots_of(const std::filesystem::path& path) const;
  /// All known scenes, by name.
  std::vector<std::filesystem::path> files() const;
  /// The facts of all known scenes, by name.
  std::vector<std::shared_ptr<const FileFacts>> facts() const;
  /// Whether all folders have been walked, and all changes on disk have been read.
  bool is_complete() const;
  /// Waits until nothing is left to do, open texts included: for tests.
  void wait() const;

 private:
  using Path = std::filesystem::path;
  /// By the text: std::filesystem::path compares part by part, ten times slower.
  struct ByText {
    bool operator()(const Path& a, const Path& b) const noexcept { return a.native() < b.native(); }
  };
  using Paths = std::set<Path, ByText>;
  using Clock = std::chrono::steady_clock;

  void run();
  bool has_work() const;
  /// Does the next piece of work; called and left with the lock.
  void step(std::unique_lock<std::mutex>& lock);
  void begin_walk();
  void walk(std::unique_lock<std::mutex>& lock);
  void end_walk(std::unique_lock<std::mutex>& lock);
  void report_walk(std::unique_lock<std::mutex>& lock);
  void read_updated(std::unique_lock<std::mutex>& lock, const Path& path);
  /// Reads a file without the lock. Returns whether its dependencies have changed.
  bool read(std::unique_lock<std::mutex>& lock, const Path& path);
  std::optional<std::string> text_of(std::unique_lock<std::mutex>& lock, const Path& path);
  bool replace(const Path& path, std::shared_ptr<const FileFacts> facts);
  bool remove_below(const Path& folder);
  bool is_in_folders(const Path& path) const;
  Paths dependents_of(const Path& path) const;
  void call(std::unique_lock<std::mutex>& lock, const std::function<void()>& event);

  const lang::FileSystem& files_;
  const Events events_;
  const std::size_t max_scenes_;
  const bool has_thread_;
  lang::StopRequest stop_;

  mutable std::mutex mutex_;  // for everything below
  mutable std::condition_variable wake_, idle_;
  lang::PositionEncoding encoding_ = lang::PositionEncoding::Utf16;
  std::vector<Path> folders_;
  bool has_new_folders_ = false;
  std::map<Path, std::shared_ptr<const std::string>, ByText> open_;
  std::map<Path, Clock::time_point, ByText> updates_;  // when they are due
  std::map<Path, std::shared_ptr<const FileFacts>, ByText> facts_;
  std::map<Path, Paths, ByText> dependents_;
  mutable std::map<Path, std::vector<Path>, ByText> roots_;  // answers of roots_of()
  bool is_busy_ = false;

  // The walk that goes on, or the last one
  std::optional<FolderWalk> walk_;  // its content belongs to the thread
  std::vector<Path> found_;         // to be read, the next one last
  Paths walked_;                    // has been found; through links also outside of the folders
  Progress progress_;
  Clock::time_point walk_begin_, last_report_;
  bool has_begun_ = false;  // and that was reported

  std::thread thread_;
};

}  // namespace sdlc::lsp
