#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "cli/serve_messages.hpp"
#include "cli/serve_render.hpp"
#include "cli/web/web_server.hpp"

namespace sdlc::cli {

/// The pages of `sdlc serve` that are connected: what each shows, and has been sent. Used by the
/// thread of the server only.
class ServePages {
 public:
  using Viewer = WebServer::Viewer;
  using Send = std::function<void(Viewer viewer, std::string message, WebServer::MessageType type)>;

  explicit ServePages(Send send) : send_(std::move(send)) {}

  void open(Viewer viewer);
  void close(Viewer viewer) { pages_.erase(viewer); }
  bool is_open(Viewer viewer) const { return pages_.contains(viewer); }

  // What a page says. Precondition: it is open.

  /// It has shown the last picture: the next one may come.
  void note_shown(Viewer viewer);
  void set_view(Viewer viewer, const PictureView& view);
  void set_visible(Viewer viewer, bool is_visible);

  // What all pages show, also those that are opened later

  void show_scene(std::string message);
  void show_progress(std::string message);
  void show_outline(std::string message);
  void show_failure(std::string message);
  void show_picture(std::shared_ptr<const ServedPicture> picture);

  void send(Viewer viewer, const std::string& message);

  bool has_visible() const;
  /// Whether a page shows another channel than the colour.
  bool wants_channels() const;
  /// Null before the first.
  const ServedPicture* picture() const noexcept { return picture_.get(); }

 private:
  struct Page {
    PictureView view;
    bool is_visible = true;
    bool is_busy = false;    ///< it has a picture that it has not shown yet
    std::uint64_t sent = 0;  ///< the number of the picture; 0: none
    PictureView sent_view;
  };

  void send_to_all(const std::string& message);
  /// Sends the picture to a page that lacks it and is ready for it: a slow one skips some.
  void offer(Viewer viewer, Page& page);

  Send send_;
  std::map<Viewer, Page> pages_;
  std::string scene_, progress_, outline_, failure_;  // the last messages
  std::shared_ptr<const ServedPicture> picture_;
  std::uint64_t picture_number_ = 0;
};

}  // namespace sdlc::cli
