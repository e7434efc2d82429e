#include <algorithm>
#include <charconv>

#include "lang/editor/color_places.hpp"
#include "lang/schema/schema.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

void add_color_keys(std::vector<std::string_view>& names, std::span<const JsonKey> keys) {
  for (const JsonKey& key : keys) {
    if (key.type == JsonType::Color) names.push_back(key.key);
    if (key.object != nullptr) add_color_keys(names, key.object->keys);
  }
}

/// The names of all keys whose value is a colour.
const std::vector<std::string_view>& color_keys() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    add_color_keys(all, json_config().keys);
    for (const MaterialInfo& material : all_materials()) {
      add_color_keys(all, json_material_keys(material.id));
    }
    return all;
  }();
  return names;
}

bool is_color_key(std::string_view quoted) {
  if (quoted.size() < 2) return false;
  return std::ranges::count(color_keys(), quoted.substr(1, quoted.size() - 2)) > 0;
}

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_good = error == std::errc() && end == text.data() + text.size() && number >= 0;
  return is_good ? std::optional(number) : std::nullopt;
}

/// Reads `: [r, g, b]` after a key.
std::optional<ColorPlace> read_color(TokenReader tokens) {
  if (tokens.text(tokens.next_solid()) != ":") return std::nullopt;
  const Token open = tokens.next_solid();
  if (tokens.text(open) != "[") return std::nullopt;
  ColorPlace place{.where = open.span, .spelling = ColorSpelling::Linear255, .color = {}};
  std::array<double, 3> components{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Token number = tokens.next_solid();
    const auto value = number_of(tokens.text(number));
    if (number.kind != TokenKind::Number || !value) return std::nullopt;
    components[i] = *value / 255;
    place.numbers[i] = number.span;
    const Token after = tokens.next_solid();
    if (tokens.text(after) != (i < 2 ? "," : "]")) return std::nullopt;
    place.where.end = after.span.end;
  }
  place.color = {components[0], components[1], components[2]};
  return place;
}

}  // namespace

std::vector<ColorPlace> colors_of_config(std::string_view text) {
  std::vector<ColorPlace> places;
  TokenReader tokens(text, 0, SourceFormat::Json);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (token.kind != TokenKind::String || !is_color_key(tokens.text(token))) continue;
    if (const auto place = read_color(tokens)) places.push_back(*place);
  }
  return places;
}

}  // namespace sdlc::lang
