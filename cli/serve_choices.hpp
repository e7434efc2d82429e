#pragma once

#include <map>
#include <optional>
#include <string>

#include "cli/json_values.hpp"
#include "lang/lower/overrides.hpp"

namespace sdlc::cli {

/// What the viewers of a scene choose beside its text.
struct ServeChoices {
  std::map<std::string, std::string> params = {};  ///< values as of --set, by name
  std::optional<std::string> camera = {};          ///< nullopt: the scene's choice
  std::optional<int> frame = {};                   ///< of an animation; nullopt: the first
  std::optional<lang::CameraPose> pose = {};       ///< nullopt: that of the camera

  friend bool operator==(const ServeChoices&, const ServeChoices&) = default;
};

/// Adds a `choose` message to those before it, as one message: the newest choices count, and what
/// it does not name stays. Starts with an empty object. Throws Json::exception for values of other
/// types than a page sends.
void add_choices(const Json& message, Json& all);

/// The choices after a `choose` message. Throws Json::exception as add_choices() does.
ServeChoices choose(ServeChoices choices, const Json& message);

/// -1 for what is no integer from 0 to 10^9.
int int_of(const Json& json);

}  // namespace sdlc::cli
