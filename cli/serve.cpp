#include "cli/serve.hpp"

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/accuracy_report.hpp"
#include "cli/file_watch.hpp"
#include "cli/interrupt.hpp"
#include "cli/json_values.hpp"
#include "cli/outputs.hpp"
#include "cli/serve_editor.hpp"
#include "cli/serve_mailbox.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_render_thread.hpp"
#include "cli/serve_session.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/web/page.hpp"
#include "cli/web/web_server.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/image/image.hpp"

namespace sdlc::cli {
namespace {

using Viewer = WebServer::Viewer;

/// The page, or the picture as it is now.
std::optional<WebResource> resource(const WebRequest& request, const ServePages& pages) {
  if (request.name.empty()) return page(request.host);
  const ServedPicture* const picture = pages.picture();
  const bool is_exr = request.name == "picture.exr";
  if (picture == nullptr || !(is_exr || request.name == "picture.png")) return std::nullopt;
  const auto mapping = is_exr ? std::nullopt : std::optional(picture->mapping);
  const std::vector<std::byte> bytes = render::encode_picture(
      picture->result.picture,
      {.format = is_exr ? render::ImageFormat::Exr : render::ImageFormat::Png,
       .mapping = picture->mapping,
       .metadata = {.software = fmt::format("sdlc {}", kVersion),
                    .entries = picture_metadata(picture->settings, picture->result, mapping)}});
  return WebResource{
      .type = is_exr ? "image/x-exr" : "image/png",
      .body = std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
}

/// What an editor says goes to the mailbox.
ServeEditor::Handlers editor_handlers(ServeMailbox& mailbox, std::atomic<bool>& interrupted) {
  return {.changed =
              [&mailbox](std::filesystem::path path, std::optional<std::string> text) {
                mailbox.put([&](ServeMail& mail) {
                  mail.texts.emplace_back(std::move(path), std::move(text));
                });
              },
          .moved =
              [&mailbox](TextPlace cursor) {
                mailbox.put([&](ServeMail& mail) { mail.cursor = std::move(cursor); });
              },
          .ended = [&interrupted] { interrupted = true; }};
}

/// Three threads: this one has the session, one renders, one knows the pages.
class ServeProgram {
 public:
  ServeProgram(const ServeOptions& options, Environment& env)
      : options_(options), env_(env), files_(watch_), workspace_(files_) {}

  ExitCode run() {
    const InterruptGuard guard(interrupted_);
    listen();
    // Also after an exception: the render talks to the server.
    const std::unique_ptr<ServeRender, void (*)(ServeRender*)> cancelled(
        &render_, [](ServeRender* render) { render->cancel(); });
    std::optional<ServeEditor> editor;
    if (options_.has_editor) editor.emplace(editor_handlers(session_.mailbox(), interrupted_));
    const std::jthread watcher([this](const std::stop_token& token) { watch_files(token); });
    // An editor sends its texts first.
    if (!options_.has_editor) tell_of_change();
    constexpr std::chrono::milliseconds kTick(100);
    while (!interrupted_) session_.turn(kTick);
    return ExitCode::Interrupted;
  }

 private:
  WebServer::Handlers handlers() {
    ServeRequests& requests = session_.requests();
    return {
        .get = [this](const WebRequest& request) { return resource(request, session_.pages()); },
        .opened = [&requests](Viewer viewer) { requests.open(viewer); },
        .closed = [&requests](Viewer viewer) { requests.close(viewer); },
        .received = [&requests](Viewer viewer,
                                std::string_view text) { requests.receive(viewer, text); }};
  }

  void listen() {
    try {
      server_.emplace(static_cast<std::uint16_t>(options_.port), handlers());
    } catch (const std::system_error& error) {
      throw UsageError(fmt::format("--port: cannot listen: {}", error.what()));
    }
    env_.out << (options_.has_editor ? to_line({{"type", "url"}, {"url", server_->url()}})
                                     : server_->url())
             << std::endl;
  }

  void watch_files(const std::stop_token& token) {
    constexpr std::chrono::milliseconds kWait(200);
    while (!token.stop_requested()) {
      if (!watch_.wait(kWait).empty()) tell_of_change();
    }
  }

  void tell_of_change() {
    session_.mailbox().put([](ServeMail& mail) { mail.has_changed = true; });
  }

  const ServeOptions& options_;
  Environment& env_;
  FileWatch watch_;
  WatchedFiles files_;
  lang::Workspace workspace_;
  std::atomic<bool> interrupted_{false};
  ServeRenderThread render_;
  ServeSession session_{
      options_,
      env_.with_workspace(workspace_),
      render_,
      {.post = [this](std::function<void()> function) { server_->post(std::move(function)); },
       .send =
           [this](Viewer viewer, std::string message, WebServer::MessageType type) {
             server_->send(viewer, std::move(message), type);
           }}};
  std::optional<WebServer> server_;  // last: it ends before what it uses
};

}  // namespace

ExitCode serve(const ServeOptions& options, Environment& env) {
  if (options.scene.file == kStandardStream) {
    throw UsageError("standard input does not change; name a file");
  }
  return ServeProgram(options, env).run();
}

}  // namespace sdlc::cli
