#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
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
#include "lang/program/program.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"
#include "lsp/checked_scene.hpp"
#include "lsp/log.hpp"
#include "lsp/open_files.hpp"

namespace sdlc::lsp {

/// Checks scenes on a thread of its own, if it has one: each that is affected by a change, whole. A
/// change stops the check that runs, unless it does not affect that scene. All functions may be
/// called by every thread.
class Checks {
 public:
  /// A check that has ended, or the reason why the scene could not be read. On the thread of the
  /// checks.
  struct Result {
    std::filesystem::path scene;
    std::shared_ptr<const CheckedScene> checked = nullptr;  ///< null: `error`
    std::string error = {};
  };
  using OnChecked = std::function<void(const Result&)>;
  /// While one exists, no check begins.
  class Pause {
   public:
    explicit Pause(Checks& checks) : checks_(checks) { checks_.set_paused(true); }
    ~Pause() { checks_.set_paused(false); }
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;

   private:
    Checks& checks_;
  };

  /// Without a thread, run_due() does the work.
  Checks(const lang::FileSystem& disk, const lang::ProgramOptions& options, Log& log,
         OnChecked on_checked, bool has_thread = true);
  /// Stops the check that runs.
  ~Checks();
  Checks(const Checks&) = delete;
  Checks& operator=(const Checks&) = delete;

  /// A text was opened or changed.
  void change(const OpenFile& file);
  void close(const std::filesystem::path& path);
  /// Files on disk may have changed: all scenes are checked again.
  void check_all();
  void set_sandboxed(bool is_sandboxed);
  /// Makes all checks that are due, on the calling thread.
  void run_due();
  /// Replaces the scenes to check, by identity; checks the new ones.
  void set_scenes(std::set<std::filesystem::path> scenes);

  /// Whether the scene, as it was checked last, reads the file, both by identity; a scene that
  /// cannot be read reads none. Nullopt if its check is due.
  std::optional<bool> reads(const std::filesystem::path& scene, const std::filesystem::path& file);

  /// Calls `use` with the findings of a scene in its present state, once they are there; waits at
  /// most `patience`, and until `stop` is made. Returns whether they were there. `use` must be
  /// quick: checks wait for it.
  bool use_findings(const std::filesystem::path& scene, std::chrono::milliseconds patience,
                    const lang::StopRequest& stop,
                    const std::function<void(const CheckedScene&)>& use);

 private:
  using Clock = std::chrono::steady_clock;
  /// A change of the workspace and the file that it changes; without a path: any file.
  struct Change {
    std::function<void(lang::Workspace&)> apply;
    std::optional<std::filesystem::path> path;
  };
  struct Scene {
    bool is_due = true;
    std::shared_ptr<const CheckedScene> checked = nullptr;  ///< of the present state unless is_due
    std::set<std::filesystem::path> reads = {};             ///< by identity, as of the last check
  };

  void set_paused(bool is_paused);
  void add(Change change, bool waits_for_keys);
  void run();
  /// Does the next piece of work. False if there is none.
  bool step(std::unique_lock<std::mutex>& lock);
  void apply_changes(std::unique_lock<std::mutex>& lock);
  /// The scene to check next; null if none is due. The file changed last comes first.
  const std::filesystem::path* next_due() const;
  void check(std::unique_lock<std::mutex>& lock, const std::filesystem::path& scene);
  std::shared_ptr<const CheckedScene> checked(const std::filesystem::path& scene,
                                              const lang::ProgramOptions& options,
                                              const lang::StopRequest& stop, std::string& error);

  const OnChecked on_checked_;
  Log& log_;
  lang::Workspace workspace_;  // of the thread alone
  /// Held during a check, and while its result is in use: texts have one user at a time. Locked
  /// before `mutex_`.
  std::timed_mutex work_;
  std::mutex mutex_;  // for everything below
  std::condition_variable wake_;
  lang::ProgramOptions options_;
  std::map<std::filesystem::path, Scene> scenes_;  // by identity
  std::filesystem::path changed_last_;
  std::vector<Change> changes_;              // not applied yet
  std::unique_ptr<lang::StopRequest> stop_;  // of the check that runs
  std::filesystem::path running_;
  Clock::time_point quiet_until_ = {};
  Clock::duration last_duration_ = {};
  bool is_paused_ = false;
  bool is_ending_ = false;
  std::thread thread_;
};

}  // namespace sdlc::lsp
