#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/json_values.hpp"
#include "cli/serve_outline.hpp"
#include "cli/web/web_server.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

/// What other threads ask of a session.
struct ServeMail {
  struct Pixel {
    int x = 0, y = 0;
  };
  /// Of an editor; nullopt: the file counts again.
  using Text = std::pair<std::filesystem::path, std::optional<std::string>>;

  bool has_changed = false;                  ///< a file has, or a text
  Json choices = Json::object();             ///< one `choose` message; empty: none
  std::map<WebServer::Viewer, Pixel> picks;  ///< the newest of each viewer
  std::vector<Text> texts;
  std::optional<TextPlace> cursor;  ///< of an editor; the newest
  std::vector<Json> places;         ///< to be opened in the editor
  std::optional<bool> is_watched;   ///< whether anybody looks now

  bool is_empty() const noexcept {
    return !has_changed && choices.empty() && picks.empty() && texts.empty() && !cursor &&
           places.empty() && !is_watched;
  }
};

/// The mail that waits for the session. May be used by any thread.
class ServeMailbox {
 public:
  /// Calls `put_in(mail)`. If a file or a text has changed then, the compilation under way ends.
  template <typename PutIn>
  void put(const PutIn& put_in) {
    {
      const std::lock_guard lock(mutex_);
      put_in(mail_);
      const bool is_outdated = mail_.has_changed || !mail_.texts.empty();
      if (is_outdated && compilation_) compilation_->make();
    }
    arrived_.notify_all();
  }

  /// All mail, for which it waits at most this long. From now on `compilation` is under way: what
  /// arrives later may end it.
  ServeMail take(std::chrono::milliseconds time, std::shared_ptr<lang::StopRequest> compilation) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, time, [this] { return !mail_.is_empty(); });
    compilation_ = std::move(compilation);
    return std::exchange(mail_, {});
  }
  /// What arrives from now on does not end it.
  void end_compilation() {
    const std::lock_guard lock(mutex_);
    compilation_.reset();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  ServeMail mail_;
  std::shared_ptr<lang::StopRequest> compilation_;
};

}  // namespace sdlc::cli
