#include "lang/editor/config_text.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "lang/schema/property_text.hpp"

namespace sdlc::lang {

bool looks_like_config(std::string_view text) {
  constexpr std::ptrdiff_t kEnough = 2;
  return std::ranges::count_if(json_config().keys, [&](const JsonKey& key) {
           return text.find(fmt::format("\"{}\"", key.key)) != std::string_view::npos;
         }) >= kEnough;
}

std::string describe_key(const JsonKey& key) {
  std::string text(describe(key.type));
  if (key.range != Range::Any) {
    const bool is_color = key.type == JsonType::Color;
    text += fmt::format(", {}{}", is_color ? "each " : "", describe(key.range));
  }
  return key.presence == Presence::Required ? text + ", required" : text;
}

std::string_view documentation_of(const JsonKey& key, const MaterialInfo* material) noexcept {
  return material != nullptr ? material->arguments[key.property].doc : doc_of(key);
}

}  // namespace sdlc::lang
