#include "lsp/settings.hpp"

#include <string>

namespace sdlc::lsp {
namespace {

template <typename T>
T value_at(const Json& json, const std::string& pointer, T fallback) {
  const Json::json_pointer path(pointer);
  if (!json.contains(path)) return fallback;
  try {
    return json.at(path).get<T>();
  } catch (const Json::exception&) {
    return fallback;
  }
}

}  // namespace

Settings Settings::of(const Json& json) {
  if (!json.is_object()) return {};
  const auto trace = value_at<std::string>(json, "/trace/server", "off");
  const auto threads = value_at<std::int64_t>(json, "/threads", 0);
  return {.threads = threads > 0 && threads < 10'000 ? static_cast<int>(threads) : 0,
          .is_sandboxed = value_at(json, "/sandbox", false),
          .inlay_hints = value_at(json, "/inlayHints", false),
          .trace = trace == "verbose"    ? Trace::Verbose
                   : trace == "messages" ? Trace::Messages
                                         : Trace::Off};
}

}  // namespace sdlc::lsp
