#include "lang/editor/config_hover.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lang/editor/config_place.hpp"
#include "lang/editor/config_text.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/schema/schema.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// The token at the offset, its ends included.
ConfigPlace place_at(std::string_view text, std::uint32_t offset) {
  ConfigPlace place = find_config_place(text, offset);
  if (place.token.size() == 0 && offset < text.size()) {
    place = find_config_place(text, offset + 1);
  }
  // A closed string ends before the offset.
  if (place.token.size() == 0 && offset > 0) place = find_config_place(text, offset - 1);
  return place;
}

std::string text_of(std::string_view word, const std::string& takes, std::string_view doc) {
  return fmt::format("`{}`: {}\n\n{}", word, takes, doc);
}

/// The type of the material around the key, which may follow it.
const MaterialInfo* material_around(const ConfigPlace& place, const ConfigObject& object,
                                    std::string_view text) {
  if (object.material != nullptr) return object.material;
  TokenReader tokens(text, place.token.end, SourceFormat::Json);
  std::string_view last;
  for (int i = 0; i < 64; ++i) {
    const Token token = tokens.next_solid();
    if (token.kind == TokenKind::End || tokens.text(token) == "}") break;
    if (last == "type" && is_string(token.kind)) {
      return find_json_material(without_quotes(tokens.text(token)));
    }
    if (tokens.text(token) != ":") last = without_quotes(tokens.text(token));
  }
  return nullptr;
}

std::string describe_word(const ConfigPlace& place, std::string_view text) {
  const std::string_view word = without_quotes(text.substr(place.token.begin, place.token.size()));
  ConfigObject object = find_config_object(place);
  if (place.is_key()) {
    if (object.is_material) object.material = material_around(place, object, text);
    if (object.is_material && word == "type") {
      return text_of(word, "the type of the material, required", "It determines the other keys.");
    }
    const JsonKey* key = object.find(word);
    return key == nullptr
               ? std::string()
               : text_of(word, describe_key(*key), documentation_of(*key, object.material));
  }
  const bool is_type = object.is_material && place.brackets.back().key == "type";
  const MaterialInfo* material = is_type ? find_json_material(word) : nullptr;
  return material == nullptr ? std::string() : fmt::format("`{}`\n\n{}", word, material->doc);
}

}  // namespace

std::optional<Hover> hover_config(const SourceFile& config, std::uint32_t offset) {
  const ConfigPlace place = place_at(config.text(), offset);
  const bool is_word = place.token.size() > 0 && !place.is_comment && !place.brackets.empty();
  if (!is_word) return std::nullopt;
  std::string markdown = describe_word(place, config.text());
  if (markdown.empty()) return std::nullopt;
  return Hover{.where = place.token, .markdown = std::move(markdown)};
}

}  // namespace sdlc::lang
