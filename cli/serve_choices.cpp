#include "cli/serve_choices.hpp"

#include <array>
#include <cstddef>

namespace sdlc::cli {

void add_choices(const Json& message, Json& all) {
  constexpr std::size_t kMaxParams = 1000;
  Json params = all.value("params", Json::object());
  Json added = params;
  added.update(message.value("params", Json::object()));
  if (added.size() <= kMaxParams) params = std::move(added);
  all.update(message);
  // Another camera is at its own place.
  if (message.contains("camera") && !message.contains("pose")) all["pose"] = nullptr;
  all["params"] = std::move(params);
}

ServeChoices choose(ServeChoices choices, const Json& message) {
  if (const auto params = message.find("params"); params != message.end()) {
    for (const auto& [name, value] : params->items()) {
      if (value.is_null()) {
        choices.params.erase(name);
      } else {
        choices.params[name] = value.get<std::string>();
      }
    }
  }
  if (const auto camera = message.find("camera"); camera != message.end()) {
    choices.camera.reset();
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
  return choices;
}

int int_of(const Json& json) {
  const bool is_int = json.is_number_integer() && json >= 0 && json <= 1'000'000'000;
  return is_int ? json.get<int>() : -1;
}

}  // namespace sdlc::cli
