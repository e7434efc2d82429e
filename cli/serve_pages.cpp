#include "cli/serve_pages.hpp"

#include <algorithm>
#include <utility>

namespace sdlc::cli {

void ServePages::open(Viewer viewer) {
  Page& page = pages_[viewer];
  if (!scene_.empty()) send(viewer, scene_);
  if (!progress_.empty()) send(viewer, progress_);
  if (!outline_.empty()) send(viewer, outline_);
  if (!failure_.empty()) send(viewer, failure_);
  offer(viewer, page);
}

void ServePages::note_shown(Viewer viewer) {
  Page& page = pages_.at(viewer);
  page.is_busy = false;
  offer(viewer, page);
}

void ServePages::set_view(Viewer viewer, const PictureView& view) {
  Page& page = pages_.at(viewer);
  page.view = view;
  offer(viewer, page);
}

void ServePages::set_visible(Viewer viewer, bool is_visible) {
  Page& page = pages_.at(viewer);
  page.is_visible = is_visible;
  offer(viewer, page);
}

void ServePages::show_scene(std::string message) {
  scene_ = std::move(message);
  send_to_all(scene_);
}

void ServePages::show_progress(std::string message) {
  progress_ = std::move(message);
  send_to_all(progress_);
}

void ServePages::show_outline(std::string message) {
  outline_ = std::move(message);
  send_to_all(outline_);
}

void ServePages::show_failure(std::string message) {
  failure_ = std::move(message);
  send_to_all(failure_);
}

void ServePages::show_picture(std::shared_ptr<const ServedPicture> picture) {
  if (picture_ && picture_->scene != picture->scene) failure_.clear();
  picture_ = std::move(picture);
  ++picture_number_;
  for (auto& [viewer, page] : pages_) offer(viewer, page);
}

void ServePages::send_to_all(const std::string& message) {
  for (const auto& [viewer, page] : pages_) send(viewer, message);
}

void ServePages::send(Viewer viewer, const std::string& message) {
  send_(viewer, message, WebServer::MessageType::Text);
}

bool ServePages::has_visible() const {
  return std::ranges::any_of(pages_, [](const auto& page) { return page.second.is_visible; });
}

bool ServePages::wants_channels() const {
  return std::ranges::any_of(
      pages_, [](const auto& page) { return page.second.view.channel != ServedChannel::Color; });
}

void ServePages::offer(Viewer viewer, Page& page) {
  const bool is_shown = page.sent == picture_number_ && page.sent_view == page.view;
  if (!picture_ || page.is_busy || is_shown || !page.is_visible) return;
  send_(viewer, picture_message(*picture_, page.view), WebServer::MessageType::Binary);
  page.is_busy = true;
  page.sent = picture_number_;
  page.sent_view = page.view;
}

}  // namespace sdlc::cli
