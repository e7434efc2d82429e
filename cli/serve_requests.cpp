#include "cli/serve_requests.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "cli/serve_choices.hpp"
#include "cli/serve_messages.hpp"

namespace sdlc::cli {

void ServeRequests::open(Viewer viewer) {
  pages_.open(viewer);
  look_at_pages();
}

void ServeRequests::close(Viewer viewer) {
  pages_.close(viewer);
  look_at_pages();
}

void ServeRequests::look_at_pages() {
  const bool is_watched = pages_.has_visible();
  render_.set_watched(is_watched);
  render_.set_wants_channels(pages_.wants_channels());
  mailbox_.put([&](ServeMail& mail) { mail.is_watched = is_watched; });
}

void ServeRequests::receive(Viewer viewer, std::string_view text) {
  const Json message = Json::parse(text, nullptr, false);
  if (!pages_.is_open(viewer) || !message.is_object()) return;
  try {
    take(viewer, message);
  } catch (const Json::exception&) {
    // A value of another type than the page sends.
  }
}

void ServeRequests::take(Viewer viewer, const Json& message) {
  constexpr std::size_t kMaxPlaces = 10;  // before the first is opened
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
    choose({}, message);  // of the right types
    mailbox_.put([&](ServeMail& mail) { add_choices(message, mail.choices); });
  } else if (type == "pick") {
    mailbox_.put([&](ServeMail& mail) { mail.picks[viewer] = pixel(); });
  } else if (type == "open" && has_editor_) {
    mailbox_.put([&](ServeMail& mail) {
      if (mail.places.size() < kMaxPlaces) mail.places.push_back(message.at("place"));
    });
  } else if (type == "pixel" && pages_.picture() != nullptr) {
    const auto [x, y] = pixel();
    pages_.send(viewer, to_line(pixel_json(*pages_.picture(), x, y)));
  }
}

}  // namespace sdlc::cli
