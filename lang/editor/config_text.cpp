#include "lang/editor/config_text.hpp"

#include <fmt/format.h>

#include "lang/schema/property_text.hpp"

namespace sdlc::lang {

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
