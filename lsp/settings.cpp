#include "lsp/settings.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lang/text/nearest_name.hpp"

namespace sdlc::lsp {
namespace {

constexpr std::int64_t kMaxThreads = 10'000;

/// Sets a setting. Returns false for a wrong value.
using Setter = bool (*)(Settings&, const Json&);

template <auto member>
bool set_flag(Settings& settings, const Json& value) {
  if (!value.is_boolean()) return false;
  settings.*member = value.get<bool>();
  return true;
}

bool set_threads(Settings& settings, const Json& value) {
  if (!value.is_number_integer()) return false;
  const auto threads = value.get<std::int64_t>();
  if (threads < 0 || threads > kMaxThreads) return false;
  settings.threads = static_cast<int>(threads);
  return true;
}

bool set_trace_level(Settings& settings, const Json& value) {
  constexpr std::array<std::string_view, 3> kLevels{"off", "messages", "verbose"};  // as in Trace
  for (std::size_t i = 0; i < kLevels.size(); ++i) {
    if (value != kLevels[i]) continue;
    settings.trace = static_cast<Trace>(i);
    return true;
  }
  return false;
}

struct Row {
  std::string_view key;
  std::string_view allowed;
  Setter set;
};

constexpr std::array<Row, 4> kRows{{
    {"threads", "an integer from 0 to 10000", set_threads},
    {"sandbox", "true or false", set_flag<&Settings::is_sandboxed>},
    {"inlayHints", "true or false", set_flag<&Settings::inlay_hints>},
    {"trace.server", "\"off\", \"messages\" or \"verbose\"", set_trace_level},
}};
/// Settings of an editor's extension, which may send all that it has.
constexpr std::array<std::string_view, 2> kKeysOfClients{"path", "configs"};

std::string unknown_key(std::string_view key) {
  std::vector<std::string_view> keys;
  for (const Row& row : kRows) keys.push_back(row.key);
  return fmt::format("sdlc: there is no setting `{}`{}", key, lang::did_you_mean(key, keys));
}

/// The settings of an object; those of an object in it have its key before theirs.
void read(const Json& json, const std::string& prefix, Settings& settings,
          std::vector<std::string>& mistakes) {
  for (const auto& [name, value] : json.items()) {
    const std::string key = prefix + name;
    const auto row = std::ranges::find(kRows, key, &Row::key);
    if (row != kRows.end()) {
      if (value.is_null() || row->set(settings, value)) continue;
      mistakes.push_back(fmt::format("sdlc: the setting `{}` must be {}, not {}", key, row->allowed,
                                     text_of_message(value)));
    } else if (value.is_object() && prefix.empty()) {
      read(value, key + '.', settings, mistakes);
    } else if (std::ranges::find(kKeysOfClients, key) == kKeysOfClients.end()) {
      mistakes.push_back(unknown_key(key));
    }
  }
}

}  // namespace

Settings Settings::of(const Json& json, std::vector<std::string>& mistakes) {
  Settings settings;
  if (json.is_object()) {
    read(json, "", settings, mistakes);
  } else if (!json.is_null()) {
    mistakes.emplace_back("sdlc: the settings must be an object");
  }
  return settings;
}

}  // namespace sdlc::lsp
