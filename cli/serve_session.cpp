#include "cli/serve_session.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/diagnostics_output.hpp"
#include "cli/file_watch.hpp"
#include "cli/interrupt.hpp"
#include "cli/outputs.hpp"
#include "cli/serve_choices.hpp"
#include "cli/serve_editor.hpp"
#include "cli/serve_mailbox.hpp"
#include "cli/serve_messages.hpp"
#include "cli/serve_outline.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_picture.hpp"
#include "cli/serve_render.hpp"
#include "cli/serve_requests.hpp"
#include "cli/serve_scene.hpp"
#include "cli/usage_error.hpp"
#include "cli/web/web_server.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/math/clock.hpp"
#include "render/scene/digest.hpp"

namespace sdlc::cli {
namespace {

using Viewer = WebServer::Viewer;

/// What decides about a picture: equal ones give equal pictures.
struct LookOfScene {
  render::SceneDigest scene;
  render::RenderSettings settings;
  render::ToneMapping mapping;
  std::optional<render::Precision> precision;

  friend bool operator==(const LookOfScene&, const LookOfScene&) = default;
};

LookOfScene look_of(const lang::LoweredScene& lowered) {
  return {.scene = render::digest_of_parts(lowered.scene),
          .settings = lowered.settings,
          .mapping = lowered.output.mapping,
          .precision = lowered.precision};
}

class ServeSession {
 public:
  ServeSession(const ServeOptions& options, Environment& env)
      : options_(options), env_(env), files_(watch_), workspace_(files_) {}

  ExitCode run();

 private:
  void listen(std::optional<WebServer>& server);
  std::optional<ServeEditor> listen_to_editor(std::atomic<bool>& interrupted);
  void take_mail();
  void take_texts(std::vector<ServeMail::Text> texts);
  void take_choices(const Json& message);
  void rebuild(std::shared_ptr<const lang::StopRequest> compilation);
  void start_render(render::Clock::time_point start);
  void print_findings_of(const ServedScene& scene);
  void publish_scene();
  void publish_outline();
  void publish_progress();
  void answer_pick(Viewer viewer, ServeMail::Pixel pixel);
  void open_in_editor(const Json& place);

  // On the thread of the render
  void show_picture(std::shared_ptr<const ServedPicture> picture);
  void show_failure(std::uint64_t scene, const std::string& failure);

  const ServeOptions& options_;
  Environment& env_;
  FileWatch watch_;
  WatchedFiles files_;
  lang::Workspace workspace_;
  ServeMailbox mailbox_;

  ServeChoices choices_;
  std::uint64_t number_ = 0;             // of the pictures
  std::unique_ptr<ServedScene> latest_;  // null if it is shown_
  std::unique_ptr<ServedScene> shown_;   // the last correct one; may be null
  std::optional<LookOfScene> look_;      // of shown_
  bool is_outdated_ = false;             // the text or the choices have changed since
  bool is_cancelled_ = false;            // the render of shown_ is, before it has finished
  bool is_watched_ = false;              // by a window
  std::optional<TextPlace> cursor_;
  std::string progress_;

  WebServer* server_ = nullptr;
  std::atomic<std::shared_ptr<const ServedPicture>> newest_;  // that no page has seen
  ServeRender render_{
      {.shown = [this](auto picture) { show_picture(std::move(picture)); },
       .failed = [this](std::uint64_t scene, auto failure) { show_failure(scene, failure); }}};
  ServePages pages_{[this](Viewer viewer, std::string message, WebServer::MessageType type) {
    server_->send(viewer, std::move(message), type);
  }};
  ServeRequests requests_{options_.has_editor, pages_, render_, mailbox_};
};

void ServeSession::listen(std::optional<WebServer>& server) {
  try {
    server.emplace(static_cast<std::uint16_t>(options_.port), requests_.handlers());
  } catch (const std::system_error& error) {
    throw UsageError(fmt::format("--port: cannot listen: {}", error.what()));
  }
  server_ = &*server;
  env_.out << (options_.has_editor ? to_line({{"type", "url"}, {"url", server->url()}})
                                   : server->url())
           << std::endl;
}

std::optional<ServeEditor> ServeSession::listen_to_editor(std::atomic<bool>& interrupted) {
  if (!options_.has_editor) return std::nullopt;
  return std::optional<ServeEditor>(
      std::in_place,
      ServeEditor::Handlers{
          .changed =
              [this](std::filesystem::path path, std::optional<std::string> text) {
                mailbox_.put([&](ServeMail& mail) {
                  mail.texts.emplace_back(std::move(path), std::move(text));
                });
              },
          .moved =
              [this](TextPlace cursor) {
                mailbox_.put([&](ServeMail& mail) { mail.cursor = std::move(cursor); });
              },
          .ended = [&interrupted] { interrupted = true; }});
}

ExitCode ServeSession::run() {
  std::atomic<bool> interrupted{false};
  const InterruptGuard guard(interrupted);
  std::optional<WebServer> server;
  listen(server);
  // Also after an exception: the render talks to the server.
  const std::unique_ptr<ServeRender, void (*)(ServeRender*)> cancelled(
      &render_, [](ServeRender* render) { render->cancel(); });
  {
    const std::optional<ServeEditor> editor = listen_to_editor(interrupted);
    const std::jthread watcher([this](const std::stop_token& token) {
      constexpr std::chrono::milliseconds kWait(200);
      while (!token.stop_requested()) {
        if (watch_.wait(kWait).empty()) continue;
        mailbox_.put([](ServeMail& mail) { mail.has_changed = true; });
      }
    });
    // An editor sends its texts first.
    if (!options_.has_editor) mailbox_.put([](ServeMail& mail) { mail.has_changed = true; });
    while (!interrupted) {
      take_mail();
      publish_progress();
    }
  }
  return ExitCode::Interrupted;
}

void ServeSession::take_mail() {
  constexpr std::chrono::milliseconds kTick(100);
  auto compilation = std::make_shared<lang::StopRequest>();
  ServeMail mail = mailbox_.take(kTick, compilation);
  if (mail.has_changed) is_outdated_ = true;
  if (mail.is_watched) is_watched_ = *mail.is_watched;
  if (mail.cursor) cursor_ = std::move(mail.cursor);
  take_texts(std::move(mail.texts));
  take_choices(mail.choices);
  // An editor shows findings itself.
  const bool is_rebuilt = is_outdated_ && (is_watched_ || !options_.has_editor || !shown_);
  if (is_rebuilt) {
    try {
      rebuild(std::move(compilation));
      is_outdated_ = false;
    } catch (const lang::StopRequested&) {  // there is mail
      return mailbox_.put([&](ServeMail& later) {
        later.picks.merge(mail.picks);
        later.places.insert(later.places.begin(), mail.places.begin(), mail.places.end());
      });
    }
  } else if (!mail.choices.empty()) {
    publish_scene();  // an answer
  }
  for (const auto& [viewer, pixel] : mail.picks) answer_pick(viewer, pixel);
  for (const Json& place : mail.places) open_in_editor(place);
  if (cursor_ && (is_rebuilt || mail.cursor)) publish_outline();
}

void ServeSession::take_texts(std::vector<ServeMail::Text> texts) {
  for (auto& [path, text] : texts) {
    if (text) {
      workspace_.open(path, *std::move(text));
    } else {
      workspace_.close(path);
    }
    // A scene with errors may lack this file.
    const bool is_correct = shown_ && !latest_;
    if (!is_correct || reads(*shown_, path)) is_outdated_ = true;
  }
}

void ServeSession::take_choices(const Json& message) {
  ServeChoices choices = choose(choices_, message);
  if (choices != choices_) is_outdated_ = true;
  choices_ = std::move(choices);
}

void ServeSession::rebuild(std::shared_ptr<const lang::StopRequest> compilation) {
  const auto start = render::Clock::now();
  Environment env = env_.with_workspace(workspace_);
  std::optional<LookOfScene> look;
  const auto on_correct = [&](const lang::LoweredScene& lowered) {
    look = look_of(lowered);
    // A change of comments leaves the picture as it is.
    if (shown_ && !is_cancelled_ && look == look_) return shown_->prepared;
    render_.cancel();
    is_cancelled_ = true;
    return std::shared_ptr<const render::PreparedScene>();
  };
  auto scene = serve_scene(options_, choices_, compilation, on_correct, env);
  mailbox_.end_compilation();
  lang::stop_if_requested(compilation.get());  // it could not find origins any more
  latest_ = std::move(scene);
  print_findings_of(*latest_);
  if (!latest_->prepared) {
    publish_scene();
    if (shown_ && is_cancelled_) start_render(start);
    return;
  }
  shown_ = std::move(latest_);
  look_ = look;
  if (!is_cancelled_) return publish_scene();
  ++number_;
  publish_scene();
  start_render(start);
}

void ServeSession::start_render(render::Clock::time_point start) {
  is_cancelled_ = false;
  render_.start({.scene = number_,
                 .prepared = shown_->prepared,
                 .settings = shown_->lowered.settings,
                 .mapping = shown_->lowered.output.mapping,
                 .start = start},
                env_);
}

void ServeSession::print_findings_of(const ServedScene& scene) {
  if (options_.has_editor || scene.prepared) return;
  print_findings(lang::select_unallowed(scene.sink), options_.scene.diagnostics, env_.err,
                 env_.err_is_terminal, env_);
  env_.err << scene.failure << std::flush;
}

void ServeSession::publish_scene() {
  const ServedScene* const latest = latest_ ? latest_.get() : shown_.get();
  if (latest == nullptr) return;
  ServeChoices of_command = choices_;
  if (latest->animation && !of_command.frame) of_command.frame = latest->animation->first;
  std::string message =
      to_line(scene_json(number_, *latest, shown_.get(), choices_,
                         render_command(env_.arguments, of_command), options_.has_editor));
  server_->post([this, message = std::move(message)] { pages_.show_scene(message); });
}

void ServeSession::publish_outline() {
  if (!shown_ || latest_) return;  // the cursor is in the latest text
  const Outline outline = outline_at(*shown_, *cursor_);
  Json rows = Json::array();
  for (const PixelRow& row : outline.rows) rows.push_back({row.x, row.y, row.width});
  std::string message =
      to_line({{"type", "outline"}, {"step", outline.step}, {"rows", std::move(rows)}});
  server_->post([this, message = std::move(message)] { pages_.show_outline(message); });
}

void ServeSession::publish_progress() {
  std::string message = to_line(progress_json(render_.progress()));
  if (message == progress_) return;
  progress_ = message;
  server_->post([this, message = std::move(message)] { pages_.send_to_all(message); });
}

void ServeSession::answer_pick(Viewer viewer, ServeMail::Pixel pixel) {
  if (!shown_) return;
  Json answer{
      {"type", "picked"}, {"scene", number_}, {"x", pixel.x}, {"y", pixel.y}, {"sphere", nullptr}};
  const render::RenderSettings& settings = shown_->lowered.settings;
  std::optional<render::PickedSphere> picked;
  if (pixel.x >= 0 && pixel.y >= 0 && pixel.x < settings.width && pixel.y < settings.height) {
    const auto row =
        static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(settings.width);
    picked = shown_->prepared->pick(settings, row + static_cast<std::uint64_t>(pixel.x));
  }
  if (picked) {
    std::vector<lang::Origin> origins;
    if (!picked->instance) origins = shown_->compiler->trace_again(std::span(&picked->sphere, 1));
    answer["sphere"] =
        sphere_json(shown_->lowered.scene, *picked, origins.empty() ? nullptr : &origins.front());
  }
  server_->send(viewer, to_line(answer));
}

void ServeSession::open_in_editor(const Json& place) {
  try {
    const std::string path = place.at("path").get<std::string>();
    const auto is_read = [&](const auto& scene) { return scene && reads(*scene, path); };
    if (!is_read(shown_) && !is_read(latest_)) return;
    env_.out << to_line({{"type", "open"},
                         {"path", path},
                         {"line", place.at("line").get<std::uint32_t>()},
                         {"column", place.at("column").get<std::uint32_t>()}})
             << std::endl;
  } catch (const Json::exception&) {
    // A value of another type than the page sends.
  }
}

void ServeSession::show_picture(std::shared_ptr<const ServedPicture> picture) {
  // Only the newest waits for the server.
  if (newest_.exchange(std::move(picture)) != nullptr) return;
  server_->post([this] { pages_.show_picture(newest_.exchange(nullptr)); });
}

void ServeSession::show_failure(std::uint64_t scene, const std::string& failure) {
  std::string message = to_line({{"type", "failure"}, {"scene", scene}, {"text", failure}});
  server_->post([this, message = std::move(message)] { pages_.show_failure(message); });
}

}  // namespace

ExitCode serve(const ServeOptions& options, Environment& env) {
  if (options.scene.file == kStandardStream) {
    throw UsageError("standard input does not change; name a file");
  }
  return ServeSession(options, env).run();
}

}  // namespace sdlc::cli
