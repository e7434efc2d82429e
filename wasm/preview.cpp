#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/serve_mailbox.hpp"
#include "cli/serve_session.hpp"
#include "wasm/calls.hpp"
#include "wasm/serve_render_steps.hpp"

namespace sdlc::wasm {
namespace {

/// What `sdlc serve --editor` is, with one page, which is in the same browser and opens places
/// itself.
class Preview {
 public:
  explicit Preview(const Json& parameters)
      : arguments_(parameters.value("arguments", std::vector<std::string>())),
        options_{.scene = {.file = parameters.at("file").get<std::string>(),
                           .reading = {.limits = kLimits,
                                       .is_sandboxed = parameters.value("sandbox", false)}},
                 .overrides = overrides_of(parameters),
                 .kernel = request_of(parameters),
                 .has_editor = true} {
    session_.requests().open(kViewer);
    change();
  }

  void change() {
    session_.mailbox().put([](cli::ServeMail& mail) { mail.has_changed = true; });
  }
  /// A message of docs/serve.md.
  void receive(const std::string& message) { session_.requests().receive(kViewer, message); }
  void move_cursor(cli::TextPlace cursor) {
    session_.mailbox().put([&](cli::ServeMail& mail) { mail.cursor = std::move(cursor); });
  }
  void stop() { render_.cancel(); }

  Json step(double seconds) {
    session_.turn(std::chrono::milliseconds(0));
    if (render_.has_work()) render_.step(seconds);
    last_picture_ = std::exchange(picture_, {});  // also one that an answer between steps has made
    Json answer{{"messages", std::exchange(messages_, Json::array())},
                {"picture_bytes", last_picture_.size()},
                {"has_work", render_.has_work()}};
    return answer;
  }
  /// The binary message of the last step; empty if there was none.
  std::span<const std::uint8_t> picture() const noexcept {
    return {reinterpret_cast<const std::uint8_t*>(last_picture_.data()), last_picture_.size()};
  }

 private:
  static constexpr cli::WebServer::Viewer kViewer = 1;

  void send(std::string message, cli::WebServer::MessageType type) {
    if (type == cli::WebServer::MessageType::Binary) {
      picture_ = std::move(message);
    } else {
      messages_.push_back(std::move(message));
    }
  }

  std::vector<std::string> arguments_;
  cli::ServeOptions options_;
  lang::DiskFileSystem disk_;
  lang::Workspace workspace_{disk_};
  std::ostringstream out_, err_;
  Json messages_ = Json::array();
  std::string picture_, last_picture_;
  ServeRenderSteps render_;
  cli::ServeSession session_{
      options_,
      {.workspace = workspace_, .out = out_, .err = err_, .arguments = arguments_},
      render_,
      {.post = [](const std::function<void()>& function) { function(); },
       .send = [this](auto, std::string message, auto type) { send(std::move(message), type); }}};
};

std::unique_ptr<Preview> preview;

Preview& running() {
  if (!preview) throw WrongParameter("no preview has been started");
  return *preview;
}

}  // namespace

Json start_preview(const Json& parameters) {
  preview.reset();  // before the next: both may not fit into memory
  preview = std::make_unique<Preview>(parameters);
  return Json::object();
}

Json change_preview(const Json& parameters) {
  if (parameters.value("stop", false)) running().stop();
  if (parameters.value("files", false)) running().change();
  if (const auto cursor = parameters.find("cursor"); cursor != parameters.end()) {
    running().move_cursor({.path = cursor->at("path").get<std::string>(),
                           .position = {.line = cursor->at("line").get<std::uint32_t>(),
                                        .column = cursor->at("column").get<std::uint32_t>()}});
  }
  return Json::object();
}

Json send_to_preview(const Json& parameters) {
  running().receive(parameters.at("message").get<std::string>());
  return Json::object();
}

Json step_preview(const Json& parameters) {
  return running().step(parameters.value("milliseconds", 30.0) / 1000);
}

std::span<const std::uint8_t> preview_picture() {
  return preview ? preview->picture() : std::span<const std::uint8_t>();
}

}  // namespace sdlc::wasm
