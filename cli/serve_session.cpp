#include "cli/serve_session.hpp"

#include <span>
#include <string_view>

#include "cli/diagnostics_output.hpp"
#include "cli/serve_choices.hpp"
#include "cli/serve_messages.hpp"
#include "lang/allowances/allowances.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::cli {
namespace {

using Viewer = WebServer::Viewer;

LookOfScene look_of(const lang::LoweredScene& lowered) {
  return {.scene = render::digest_of_parts(lowered.scene),
          .settings = lowered.settings,
          .mapping = lowered.output.mapping,
          .precision = lowered.precision};
}

}  // namespace

ServeSession::ServeSession(const ServeOptions& options, const Environment& env, ServeRender& render,
                           ServeTransport transport)
    : options_(options), env_(env), render_(render), transport_(std::move(transport)) {
  render_.set_handlers(
      {.shown = [this](auto picture) { show_picture(std::move(picture)); },
       .failed = [this](std::uint64_t scene, auto failure) { show_failure(scene, failure); }});
}

void ServeSession::turn(std::chrono::milliseconds patience) {
  auto compilation = std::make_shared<lang::StopRequest>();
  take(mailbox_.take(patience, compilation), compilation);
  publish_progress();
}

void ServeSession::take(ServeMail mail, std::shared_ptr<lang::StopRequest> compilation) {
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
      env_.workspace.open(path, *std::move(text));
    } else {
      env_.workspace.close(path);
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
  Environment env = env_;
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
  progress_.clear();  // the progress is sent after each scene, also if it is unchanged
  ServeChoices of_command = choices_;
  if (latest->animation && !of_command.frame) of_command.frame = latest->animation->first;
  std::string message =
      to_line(scene_json(number_, *latest, shown_.get(), choices_,
                         render_command(env_.arguments, of_command), options_.has_editor));
  transport_.post([this, message = std::move(message)] { pages_.show_scene(message); });
}

void ServeSession::publish_outline() {
  if (!shown_ || latest_) return;  // the cursor is in the latest text
  const Outline outline = outline_at(*shown_, *cursor_);
  Json rows = Json::array();
  for (const PixelRow& row : outline.rows) rows.push_back({row.x, row.y, row.width});
  std::string message =
      to_line({{"type", "outline"}, {"step", outline.step}, {"rows", std::move(rows)}});
  transport_.post([this, message = std::move(message)] { pages_.show_outline(message); });
}

void ServeSession::publish_progress() {
  std::string message = to_line(progress_json(render_.progress()));
  if (message == progress_) return;
  progress_ = message;
  transport_.post([this, message = std::move(message)] { pages_.show_progress(message); });
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
  transport_.send(viewer, to_line(answer), WebServer::MessageType::Text);
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
  // Only the newest waits for the pages.
  if (exchange_newest(std::move(picture)) != nullptr) return;
  transport_.post([this] { pages_.show_picture(exchange_newest(nullptr)); });
}

std::shared_ptr<const ServedPicture> ServeSession::exchange_newest(
    std::shared_ptr<const ServedPicture> picture) {
  const std::lock_guard lock(newest_mutex_);
  return std::exchange(newest_, std::move(picture));
}

void ServeSession::show_failure(std::uint64_t scene, const std::string& failure) {
  std::string message = to_line({{"type", "failure"}, {"scene", scene}, {"text", failure}});
  transport_.post([this, message = std::move(message)] { pages_.show_failure(message); });
}

}  // namespace sdlc::cli
