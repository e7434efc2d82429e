#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/environment.hpp"
#include "cli/serve_mailbox.hpp"
#include "cli/serve_outline.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_picture.hpp"
#include "cli/serve_render.hpp"
#include "cli/serve_requests.hpp"
#include "cli/serve_scene.hpp"
#include "cli/web/web_server.hpp"
#include "lang/compile/compile.hpp"
#include "render/scene/digest.hpp"

namespace sdlc::cli {

/// What decides about a picture: equal ones give equal pictures.
struct LookOfScene {
  render::SceneDigest scene;
  render::RenderSettings settings;
  render::ToneMapping mapping;
  std::optional<render::Precision> precision;

  friend bool operator==(const LookOfScene&, const LookOfScene&) = default;
};

/// How messages reach the pages.
struct ServeTransport {
  /// Calls the function on the thread of the pages.
  std::function<void(std::function<void()> function)> post;
  ServePages::Send send;
};

/// A scene that is shown in pages, and again whenever it changes. It takes mail, compiles, orders
/// renders, and answers. docs/serve.md describes the messages.
class ServeSession {
 public:
  /// Keeps references. Findings are printed to `env`; so are places to open if there is an editor.
  ServeSession(const ServeOptions& options, const Environment& env, ServeRender& render,
               ServeTransport transport);
  ServeSession(const ServeSession&) = delete;
  ServeSession& operator=(const ServeSession&) = delete;

  /// Takes the mail, for which it waits at most this long, and does what it asks.
  void turn(std::chrono::milliseconds patience);

  /// For any thread.
  ServeMailbox& mailbox() noexcept { return mailbox_; }
  // For the thread of the pages
  const ServePages& pages() const noexcept { return pages_; }
  ServeRequests& requests() noexcept { return requests_; }

 private:
  void take(ServeMail mail, std::shared_ptr<lang::StopRequest> compilation);
  void take_texts(std::vector<ServeMail::Text> texts);
  void take_choices(const Json& message);
  void rebuild(std::shared_ptr<const lang::StopRequest> compilation);
  void start_render(render::Clock::time_point start);
  void print_findings_of(const ServedScene& scene);
  void publish_scene();
  void publish_outline();
  void publish_progress();
  void answer_pick(WebServer::Viewer viewer, ServeMail::Pixel pixel);
  void open_in_editor(const Json& place);

  // On the thread of the render
  void show_picture(std::shared_ptr<const ServedPicture> picture);
  void show_failure(std::uint64_t scene, const std::string& failure);
  std::shared_ptr<const ServedPicture> exchange_newest(
      std::shared_ptr<const ServedPicture> picture);

  const ServeOptions& options_;
  Environment env_;
  ServeRender& render_;
  ServeTransport transport_;
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

  std::mutex newest_mutex_;
  std::shared_ptr<const ServedPicture> newest_;  // that no page has seen
  ServePages pages_{transport_.send};
  ServeRequests requests_{options_.has_editor, pages_, render_, mailbox_};
};

}  // namespace sdlc::cli
