#include "lang/schema/property_text.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace sdlc::lang {
namespace {

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

/// "`a`, `b` or `c`"
std::string one_of(std::span<const std::string_view> words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += i == 0 ? "" : i + 1 == words.size() ? " or " : ", ";
    text += code(words[i]);
  }
  return text;
}

}  // namespace

std::string describe_values(const Property& property) {
  std::string text(describe(property.type));
  if (property.type == Type::Word) {
    text = property.words.empty() ? "a name" : one_of(property.words);
  }
  if (property.range != Range::Any) {
    const bool is_color = property.type == Type::Color;
    text += fmt::format(", {}{}", is_color ? "each component " : "", describe(property.range));
  }
  return property.reads_none ? text + ", or `none`" : text;
}

std::string describe_default(const Property& property) {
  if (property.presence == Presence::Required) return "required";
  return property.default_text.empty() ? "" : code(property.default_text);
}

std::string_view doc_of(const JsonKey& key) noexcept {
  const bool is_own = !key.doc.empty() || key.target == nullptr;
  return is_own ? key.doc : key.target->properties[key.property].doc;
}

}  // namespace sdlc::lang
