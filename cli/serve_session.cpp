#include "cli/serve_session.hpp"

#include <algorithm>
#include <array>
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

#include "cli/accuracy_report.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/file_watch.hpp"
#include "cli/interrupt.hpp"
#include "cli/outputs.hpp"
#include "cli/serve_editor.hpp"
#include "cli/serve_mailbox.hpp"
#include "cli/serve_messages.hpp"
#include "cli/serve_outline.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_picture.hpp"
#include "cli/serve_render.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/web/page.hpp"
#include "cli/web/web_server.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/image/image.hpp"
#include "render/math/clock.hpp"
#include "render/scene/digest.hpp"

namespace sdlc::cli {
namespace {

using Viewer = WebServer::Viewer;

std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// -1 for what is no number of its type.
int int_of(const Json& json) {
  const bool is_int = json.is_number_integer() && json >= -1 && json <= 1'000'000'000;
  return is_int ? json.get<int>() : -1;
}

/// What decides about a picture: equal ones give equal pictures.
struct LookOfScene {
  render::SceneDigest scene;
  int width, height, samples, depth, threads;
  std::uint64_t seed;
  render::SamplerKind sampler;
  render::LightSampling light_sampling;
  std::optional<double> error;
  bool is_adaptive, is_denoised;
  render::ToneMapping mapping;
  std::optional<render::Precision> precision;

  friend bool operator==(const LookOfScene&, const LookOfScene&) = default;
};

LookOfScene look_of(const lang::LoweredScene& lowered) {
  const render::RenderSettings& settings = lowered.settings;
  return {.scene = render::digest_of_parts(lowered.scene),
          .width = settings.width,
          .height = settings.height,
          .samples = settings.samples,
          .depth = settings.depth,
          .threads = settings.threads,
          .seed = settings.seed,
          .sampler = settings.sampler,
          .light_sampling = settings.light_sampling,
          .error = settings.error,
          .is_adaptive = settings.is_adaptive,
          .is_denoised = settings.is_denoised,
          .mapping = lowered.output.mapping,
          .precision = lowered.precision};
}

class ServeSession {
 public:
  ServeSession(const ServeOptions& options, Environment& env)
      : options_(options), env_(env), files_(watch_), workspace_(files_) {}

  ExitCode run();

 private:
  // On the thread of the session
  void listen(std::optional<WebServer>& server);
  std::optional<ServeEditor> listen_to_editor(std::atomic<bool>& interrupted);
  void take_mail();
  void rebuild(std::shared_ptr<const lang::StopRequest> compilation);
  void start_render(render::Clock::time_point start);
  void print_findings_of(const ServedScene& scene);
  void publish_scene();
  void publish_outline();
  void publish_progress();
  void answer_pick(Viewer viewer, ServeMail::Pixel pixel);
  void open_in_editor(const Json& place);
  bool reads(const ServedScene* scene, const std::filesystem::path& path) const;

  // On the thread of the server
  WebServer::Handlers handlers();
  std::optional<WebResource> resource(std::string_view name) const;
  void receive(Viewer viewer, std::string_view text);
  void choose(const Json& message);
  void look_at_pages();

  const ServeOptions& options_;
  Environment& env_;
  FileWatch watch_;
  WatchedFiles files_;
  lang::Workspace workspace_;
  ServeMailbox mailbox_;

  ServeChoices choices_;                 // of the scene
  ServeChoices asked_choices_;           // of the server's thread
  std::uint64_t number_ = 0;             // of the pictures
  std::unique_ptr<ServedScene> latest_;  // null if it is shown_
  std::unique_ptr<ServedScene> shown_;   // the last correct one; may be null
  std::optional<LookOfScene> look_;      // of shown_
  bool is_cancelled_ = false;            // the render of shown_ is, before it has finished
  std::optional<TextPlace> cursor_;
  std::string progress_;

  WebServer* server_ = nullptr;
  ServePages pages_{server_};
  ServeRender render_{
      {.shown =
           [this](std::shared_ptr<const ServedPicture> picture) {
             server_->post([this, picture = std::move(picture)] { pages_.show_picture(picture); });
           },
       .failed =
           [this](std::uint64_t scene, std::string failure) {
             server_->post([this, scene, failure = std::move(failure)] {
               pages_.show_failure(
                   dump({{"type", "failure"}, {"scene", scene}, {"text", failure}}));
             });
           }}};
};

// The thread of the session

void ServeSession::listen(std::optional<WebServer>& server) {
  try {
    server.emplace(static_cast<std::uint16_t>(options_.port), handlers());
  } catch (const std::system_error& error) {
    throw UsageError(fmt::format("--port: cannot listen: {}", error.what()));
  }
  server_ = &*server;
  env_.out << (options_.has_editor ? dump({{"type", "url"}, {"url", server->url()}})
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
                  mail.has_changed = true;
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
  for (auto& [path, text] : mail.texts) {
    if (text) {
      workspace_.open(path, *std::move(text));
    } else {
      workspace_.close(path);
    }
  }
  const bool is_outdated = mail.has_changed || (mail.choices && *mail.choices != choices_);
  if (mail.choices) choices_ = *std::move(mail.choices);
  if (mail.cursor) cursor_ = std::move(mail.cursor);
  if (is_outdated) {
    try {
      rebuild(std::move(compilation));
    } catch (const lang::StopRequested&) {  // there is mail
      return mailbox_.put([&](ServeMail& later) {
        later.picks.merge(mail.picks);
        later.places.insert(later.places.begin(), mail.places.begin(), mail.places.end());
      });
    }
  } else if (mail.choices) {
    publish_scene();  // an answer
  }
  for (const auto& [viewer, pixel] : mail.picks) answer_pick(viewer, pixel);
  for (const Json& place : mail.places) open_in_editor(place);
  if (cursor_ && (is_outdated || mail.cursor)) publish_outline();
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
      dump(scene_json(number_, *latest, shown_.get(), choices_,
                      render_command(env_.arguments, of_command), options_.has_editor));
  server_->post([this, message = std::move(message)] { pages_.show_scene(message); });
}

void ServeSession::publish_outline() {
  if (!shown_ || latest_) return;  // the cursor is in the latest text
  const Outline outline = outline_at(*shown_, *cursor_);
  Json rows = Json::array();
  for (const PixelRow& row : outline.rows) rows.push_back({row.x, row.y, row.width});
  std::string message =
      dump({{"type", "outline"}, {"step", outline.step}, {"rows", std::move(rows)}});
  server_->post([this, message = std::move(message)] { pages_.show_outline(message); });
}

void ServeSession::publish_progress() {
  std::string message = dump(progress_json(render_.progress()));
  if (message == progress_) return;
  progress_ = message;
  server_->post([this, message = std::move(message)] { pages_.send_to_all(message); });
}

void ServeSession::answer_pick(Viewer viewer, ServeMail::Pixel pixel) {
  if (!shown_) return;
  Json answer{{"type", "picked"}, {"x", pixel.x}, {"y", pixel.y}, {"sphere", nullptr}};
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
  server_->send(viewer, dump(answer));
}

bool ServeSession::reads(const ServedScene* scene, const std::filesystem::path& path) const {
  if (scene == nullptr || !scene->source) return false;
  const auto is_it = [&](const std::filesystem::path& file) {
    return workspace_.identity(file) == workspace_.identity(path);
  };
  return is_it(scene->source->name()) ||
         (scene->compiler && std::ranges::any_of(scene->compiler->dependencies(), is_it));
}

void ServeSession::open_in_editor(const Json& place) {
  try {
    const std::string path = place.at("path").get<std::string>();
    if (!reads(shown_.get(), path) && !reads(latest_.get(), path)) return;
    env_.out << dump({{"type", "open"},
                      {"path", path},
                      {"line", place.at("line").get<std::uint32_t>()},
                      {"column", place.at("column").get<std::uint32_t>()}})
             << std::endl;
  } catch (const Json::exception&) {
    // A value of another type than the page sends.
  }
}

// The thread of the server

WebServer::Handlers ServeSession::handlers() {
  return {.get = [this](std::string_view name) { return resource(name); },
          .opened =
              [this](Viewer viewer) {
                pages_.open(viewer);
                look_at_pages();
              },
          .closed =
              [this](Viewer viewer) {
                pages_.close(viewer);
                look_at_pages();
              },
          .received = [this](Viewer viewer, std::string_view text) { receive(viewer, text); }};
}

void ServeSession::look_at_pages() {
  render_.set_watched(pages_.has_visible());
  render_.set_wants_channels(pages_.wants_channels());
}

std::optional<WebResource> ServeSession::resource(std::string_view name) const {
  if (name.empty()) return page();
  const ServedPicture* const picture = pages_.picture();
  const bool is_exr = name == "picture.exr";
  if (picture == nullptr || !(is_exr || name == "picture.png")) return std::nullopt;
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

void ServeSession::receive(Viewer viewer, std::string_view text) {
  constexpr std::size_t kMaxPlaces = 10;  // before the first is opened
  const Json message = Json::parse(text, nullptr, false);
  if (!pages_.is_open(viewer) || !message.is_object()) return;
  try {
    const std::string type = message.value("type", "");
    const auto pixel = [&] {
      return ServeMail::Pixel{.x = int_of(message.at("x")), .y = int_of(message.at("y"))};
    };
    if (type == "shown") {
      pages_.note_shown(viewer);
    } else if (type == "view") {
      const auto channel = std::ranges::find(kServedChannels, message.value("channel", "color"));
      if (channel == kServedChannels.end()) return;
      pages_.set_view(viewer,
                      {.channel = static_cast<ServedChannel>(channel - kServedChannels.begin()),
                       .exposure = std::clamp(message.value("exposure", 0.0), -100.0, 100.0)});
      look_at_pages();
    } else if (type == "visible") {
      pages_.set_visible(viewer, message.value("value", true));
      look_at_pages();
    } else if (type == "choose") {
      choose(message);
    } else if (type == "pick") {
      mailbox_.put([&](ServeMail& mail) { mail.picks[viewer] = pixel(); });
    } else if (type == "open" && options_.has_editor) {
      mailbox_.put([&](ServeMail& mail) {
        if (mail.places.size() < kMaxPlaces) mail.places.push_back(message.at("place"));
      });
    } else if (type == "pixel" && pages_.picture() != nullptr) {
      const auto [x, y] = pixel();
      server_->send(viewer, dump(pixel_json(*pages_.picture(), x, y)));
    }
  } catch (const Json::exception&) {
    // A value of another type than the page sends.
  }
}

void ServeSession::choose(const Json& message) {
  constexpr std::size_t kMaxParams = 1000;
  ServeChoices choices = asked_choices_;
  if (const auto params = message.find("params"); params != message.end()) {
    for (const auto& [name, value] : params->items()) {
      if (value.is_null()) {
        choices.params.erase(name);
      } else if (choices.params.size() < kMaxParams) {
        choices.params[name] = value.get<std::string>();
      }
    }
  }
  if (const auto camera = message.find("camera"); camera != message.end()) {
    choices.camera.reset();
    choices.pose.reset();
    if (!camera->is_null()) choices.camera = camera->get<std::string>();
  }
  if (const auto frame = message.find("frame"); frame != message.end()) {
    choices.frame.reset();
    if (!frame->is_null()) choices.frame = int_of(*frame);
  }
  if (const auto pose = message.find("pose"); pose != message.end()) {
    choices.pose.reset();
    if (!pose->is_null()) {
      const auto point = [&](const char* name) {
        const auto numbers = pose->at(name).get<std::array<double, 3>>();
        return render::Vec3{numbers[0], numbers[1], numbers[2]};
      };
      choices.pose = lang::CameraPose{.from = point("from"), .at = point("at")};
    }
  }
  asked_choices_ = choices;
  mailbox_.put([&](ServeMail& mail) { mail.choices = std::move(choices); });
}

}  // namespace

ExitCode serve(const ServeOptions& options, Environment& env) {
  if (options.scene.file == kStandardStream) {
    throw UsageError("standard input does not change; name a file");
  }
  return ServeSession(options, env).run();
}

}  // namespace sdlc::cli
