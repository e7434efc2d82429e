#pragma once

#include <string_view>

#include "cli/serve_mailbox.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_render.hpp"
#include "cli/web/web_server.hpp"

namespace sdlc::cli {

/// What the pages of `sdlc serve` ask. It answers what is about the last picture, and leaves the
/// rest in the mailbox of the session. Used by the thread of the server only.
class ServeRequests {
 public:
  using Viewer = WebServer::Viewer;

  /// Keeps references to all. `has_editor`: places may be opened.
  ServeRequests(bool has_editor, ServePages& pages, ServeRender& render, ServeMailbox& mailbox)
      : has_editor_(has_editor), pages_(pages), render_(render), mailbox_(mailbox) {}

  void open(Viewer viewer);
  void close(Viewer viewer);
  void receive(Viewer viewer, std::string_view text);

 private:
  /// Throws Json::exception for values of other types than a page sends.
  void take(Viewer viewer, const Json& message);
  void look_at_pages();

  bool has_editor_;
  ServePages& pages_;
  ServeRender& render_;
  ServeMailbox& mailbox_;
};

}  // namespace sdlc::cli
