#include "lsp/previews.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "lsp/child_process.hpp"

namespace sdlc::lsp {

namespace fs = std::filesystem;

/// A child process, and a thread that reads what it says.
class Previews::Preview {
 public:
  Preview(fs::path scene, const std::vector<std::string>& command, OnOpen on_open)
      : scene_(std::move(scene)), on_open_(std::move(on_open)), child_(command) {
    thread_ = std::thread([this] { listen(); });
  }
  ~Preview() {
    child_.kill();
    thread_.join();
  }
  Preview(const Preview&) = delete;
  Preview& operator=(const Preview&) = delete;

  const fs::path& scene() const noexcept { return scene_; }
  bool has_ended() const noexcept { return has_ended_; }
  /// Empty if it has ended, or takes too long to start.
  std::string url() {
    constexpr std::chrono::seconds kMaxTime(10);
    if (url_.empty() && future_.wait_for(kMaxTime) == std::future_status::ready) {
      url_ = future_.get();
      future_ = {};
    }
    return url_;
  }
  bool send(std::string_view line) {
    constexpr int kMilliseconds = 2000;
    return child_.write(line, kMilliseconds);
  }

 private:
  void listen() {
    std::string line;
    for (std::string part = child_.read(); !part.empty(); part = child_.read()) {
      for (const char c : part) {
        if (c != '\n') {
          line += c;
          continue;
        }
        take(Json::parse(std::exchange(line, {}), nullptr, false));
      }
    }
    if (!has_url_) promise_.set_value({});
    has_ended_ = true;
  }

  void take(const Json& message) {
    if (!message.is_object()) return;
    try {
      const std::string type = message.value("type", std::string());
      if (type == "url" && !std::exchange(has_url_, true)) {
        promise_.set_value(message.value("url", std::string()));
      } else if (type == "open") {
        on_open_({.path = message.value("path", std::string()),
                  .position = {.line = message.value("line", std::uint32_t{1}),
                               .column = message.value("column", std::uint32_t{1})}});
      }
    } catch (const Json::exception&) {
      // A value of another type than `sdlc serve` says.
    }
  }

  fs::path scene_;
  OnOpen on_open_;
  ChildProcess child_;
  std::promise<std::string> promise_;
  std::future<std::string> future_ = promise_.get_future();
  std::string url_;
  bool has_url_ = false;  // of the thread
  std::atomic<bool> has_ended_{false};
  std::thread thread_;
};

namespace {

std::string line_of(const Json& message) {
  return message.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json text_message(const fs::path& path, const std::string* text) {
  return {
      {"type", "text"}, {"path", path.string()}, {"text", text != nullptr ? Json(*text) : Json()}};
}

}  // namespace

Previews::Previews(std::string program, OnOpen on_open)
    : program_(std::move(program)), on_open_(std::move(on_open)) {}

Previews::~Previews() = default;

std::string Previews::url_of(const fs::path& scene, const std::vector<PreviewText>& texts,
                             bool is_sandboxed, int threads) {
  std::erase_if(previews_, [](const auto& preview) { return preview->has_ended(); });
  const auto known = std::ranges::find(previews_, scene, &Preview::scene);
  if (known != previews_.end()) return (*known)->url();
  std::vector<std::string> command{program_, "serve", scene.string(), "--editor"};
  if (threads > 0) command.push_back(fmt::format("--threads={}", threads));
  if (is_sandboxed) command.emplace_back("--sandbox");
  try {
    auto preview = std::make_unique<Preview>(scene, command, on_open_);
    // The first message begins; the editor need not have the scene open.
    preview->send(line_of(text_message(scene, nullptr)));
    for (const PreviewText& text : texts) {
      preview->send(line_of(text_message(text.path, text.text.get())));
    }
    if (preview->url().empty()) {
      throw RequestError(ErrorCode::RequestFailed,
                         fmt::format("`{} serve` does not start", program_));
    }
    return previews_.emplace_back(std::move(preview))->url();
  } catch (const std::system_error& error) {
    throw RequestError(ErrorCode::RequestFailed, error.what());
  }
}

void Previews::end(const fs::path& scene) {
  std::erase_if(previews_, [&](const auto& preview) { return preview->scene() == scene; });
}

void Previews::change(const fs::path& path, const std::string* text) {
  if (!previews_.empty()) send(text_message(path, text));
}

void Previews::move(const Place& cursor) {
  if (previews_.empty()) return;
  send({{"type", "cursor"},
        {"path", cursor.path.string()},
        {"line", cursor.position.line},
        {"column", cursor.position.column}});
}

void Previews::send(const Json& message) {
  const std::string line = line_of(message);
  std::erase_if(previews_, [&](const auto& preview) { return !preview->send(line); });
}

}  // namespace sdlc::lsp
