#include "lsp/checks.hpp"

#include <algorithm>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace sdlc::lsp {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

Checks::Checks(const lang::FileSystem& disk, const lang::ProgramOptions& options, Log& log,
               OnChecked on_checked, bool has_thread)
    : on_checked_(std::move(on_checked)), log_(log), workspace_(disk), options_(options) {
  options_.workspace = &workspace_;
  if (has_thread) thread_ = std::thread([this] { run(); });
}

Checks::~Checks() {
  {
    const std::scoped_lock lock(mutex_);
    is_ending_ = true;
    if (stop_) stop_->make();
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Checks::change(const OpenFile& file) {
  const auto apply = [path = file.path, text = file.text, version = file.version](
                         lang::Workspace& workspace) { workspace.open(path, *text, version); };
  add({.apply = apply, .path = file.identity}, true);
}

void Checks::close(const fs::path& path) {
  add({.apply = [path](lang::Workspace& workspace) { workspace.close(path); },
       .path = workspace_.identity(path)},
      false);
}

void Checks::check_all() {
  add({.apply = [](lang::Workspace&) {}, .path = std::nullopt}, false);
}

void Checks::set_sandboxed(bool is_sandboxed) {
  {
    const std::scoped_lock lock(mutex_);
    if (options_.is_sandboxed == is_sandboxed) return;
    options_.is_sandboxed = is_sandboxed;
  }
  check_all();
}

void Checks::set_scenes(std::set<fs::path> scenes) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(scenes_, [&](const auto& scene) { return !scenes.contains(scene.first); });
  for (const fs::path& scene : scenes) scenes_.try_emplace(scene);
  if (stop_ && !scenes_.contains(running_)) stop_->make();
  wake_.notify_all();
}

void Checks::set_paused(bool is_paused) {
  {
    const std::scoped_lock lock(mutex_);
    is_paused_ = is_paused;
  }
  wake_.notify_all();
}

void Checks::add(Change change, bool waits_for_keys) {
  const std::scoped_lock lock(mutex_);
  const auto running = scenes_.find(running_);
  const bool is_affected = !change.path || running == scenes_.end() || *change.path == running_ ||
                           running->second.reads.empty() ||
                           running->second.reads.contains(*change.path);
  if (stop_ && is_affected) stop_->make();
  if (change.path) changed_last_ = *change.path;
  // The last change of a file is enough, and the texts of the others take memory.
  std::erase_if(changes_, [&](const Change& older) { return older.path == change.path; });
  changes_.push_back(std::move(change));
  // Wait for the next key for half the time of a check: a check that is stopped was for nothing.
  const auto quiet = std::clamp<Clock::duration>(last_duration_ / 2, 1ms, 150ms);
  quiet_until_ = Clock::now() + (waits_for_keys ? quiet : 0ms);
  wake_.notify_all();
}

void Checks::run() {
  std::unique_lock lock(mutex_);
  while (!is_ending_) {
    if (is_paused_) {
      wake_.wait(lock);
    } else if (Clock::now() < quiet_until_) {
      wake_.wait_until(lock, quiet_until_);
    } else if (!step(lock)) {
      wake_.wait(lock);
    }
  }
}

void Checks::run_due() {
  std::unique_lock lock(mutex_);
  while (step(lock)) {
  }
}

bool Checks::step(std::unique_lock<std::mutex>& lock) {
  if (!changes_.empty()) {
    apply_changes(lock);
    return true;
  }
  const fs::path* const scene = next_due();
  if (scene != nullptr) check(lock, fs::path(*scene));
  return scene != nullptr;
}

void Checks::apply_changes(std::unique_lock<std::mutex>& lock) {
  lock.unlock();
  const std::unique_lock work(work_);
  lock.lock();
  for (const Change& change : std::exchange(changes_, {})) {
    change.apply(workspace_);
    std::vector<fs::path> dependents;
    if (change.path) dependents = workspace_.dependents(*change.path);
    for (auto& [path, scene] : scenes_) {
      scene.is_due = scene.is_due || !change.path || path == *change.path ||
                     std::ranges::binary_search(dependents, path);
    }
  }
}

const fs::path* Checks::next_due() const {
  const fs::path* first = nullptr;
  for (const auto& [path, scene] : scenes_) {
    if (!scene.is_due) continue;
    if (path == changed_last_ || scene.reads.contains(changed_last_)) return &path;
    if (first == nullptr) first = &path;
  }
  return first;
}

std::shared_ptr<const CheckedScene> Checks::checked(const fs::path& scene,
                                                    const lang::ProgramOptions& options,
                                                    const lang::StopRequest& stop,
                                                    std::string& error) {
  std::error_code failure;
  auto document = workspace_.load(scene, options.limits.any_file(), failure);
  if (!document) {
    error = fmt::format("cannot read `{}`: {}", scene.string(), failure.message());
    return nullptr;
  }
  try {
    return std::make_shared<const CheckedScene>(std::move(document), options, &stop);
  } catch (const std::exception& defect) {
    error = fmt::format("cannot check `{}`: {}", scene.string(), defect.what());
    return nullptr;
  }
}

void Checks::check(std::unique_lock<std::mutex>& lock, const fs::path& scene) {
  const lang::ProgramOptions options = options_;
  stop_ = std::make_unique<lang::StopRequest>();
  running_ = scene;
  const lang::StopRequest& stop = *stop_;
  lock.unlock();

  const std::unique_lock work(work_);
  const auto begin = Clock::now();
  Result result{.scene = scene};
  std::shared_ptr<const CheckedScene> checked_scene;
  bool is_stopped = false;
  try {
    checked_scene = checked(scene, options, stop, result.error);
  } catch (const lang::StopRequested&) {
    is_stopped = true;
  }
  const auto duration = Clock::now() - begin;
  log_.write(fmt::format("{} {} in {:.1f} ms", is_stopped ? "stopped the check of" : "checked",
                         scene.string(),
                         std::chrono::duration<double, std::milli>(duration).count()));
  std::set<fs::path> reads;
  if (checked_scene) {
    for (const fs::path& path : checked_scene->dependencies())
      reads.insert(workspace_.identity(path));
  }
  result.checked = checked_scene;

  lock.lock();
  stop_.reset();
  running_.clear();
  const auto found = scenes_.find(scene);
  if (is_stopped || found == scenes_.end()) return;
  last_duration_ = duration;
  found->second.is_due = false;
  found->second.reads = std::move(reads);
  std::swap(found->second.checked, checked_scene);
  lock.unlock();
  on_checked_(result);
  lock.lock();
  wake_.notify_all();
}

std::optional<bool> Checks::reads(const fs::path& scene, const fs::path& file) {
  const std::scoped_lock lock(mutex_);
  const auto found = scenes_.find(scene);
  if (found == scenes_.end() || found->second.is_due) return std::nullopt;
  return found->second.reads.contains(file);
}

bool Checks::use_findings(const fs::path& scene, std::chrono::milliseconds patience,
                          const lang::StopRequest& stop,
                          const std::function<void(const CheckedScene&)>& use) {
  const auto deadline = Clock::now() + patience;
  // The checked scene, or null as long as its findings are not there.
  const auto present = [&]() -> std::shared_ptr<const CheckedScene> {
    const auto found = scenes_.find(scene);
    const bool is_there = changes_.empty() && found != scenes_.end() && !found->second.is_due;
    return is_there ? found->second.checked : nullptr;
  };
  const auto will_come = [&] {
    const auto found = scenes_.find(scene);
    return !changes_.empty() || (found != scenes_.end() && found->second.is_due);
  };
  while (true) {
    // A check that has ended still holds `work_` while its result is published.
    if (const std::unique_lock work(work_, 5ms); work.owns_lock()) {
      std::unique_lock lock(mutex_);
      const auto found = present();
      if (found == nullptr && !will_come()) return false;
      lock.unlock();
      if (found != nullptr) {
        use(*found);
        return true;
      }
    }
    if (stop.is_made() || Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
}

}  // namespace sdlc::lsp
