#include "lang/editor/config_place.hpp"

#include <algorithm>

#include "lang/editor/cursor_place.hpp"
#include "lang/text/brackets.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kMaterialKey = "material", kTypeKey = "type", kSpheresKey = "spheres";

class ConfigReader {
 public:
  ConfigReader(std::string_view text, ConfigPlace& place) : text_(text), place_(place) {}

  void read(const Token& token) {
    const char c = text_[token.span.begin];
    place_.is_after_value = false;
    if (token.kind == TokenKind::Open) return open(c);
    if (token.kind == TokenKind::Close) return close(c);
    if (place_.brackets.empty()) return;
    ConfigBracket& inner = place_.brackets.back();
    if (token.kind == TokenKind::Mark) return read_mark(inner, c);
    const std::string_view word = without_quotes(text_.substr(token.span.begin, token.span.size()));
    if (inner.open == '{' && !inner.has_colon) {
      inner.key = word;
      inner.keys.push_back(word);
      return;
    }
    if (inner.key == kTypeKey) inner.type = word;
    place_.is_after_value = true;
  }

 private:
  void open(char c) {
    // No config nests deeper than spheres, sphere, material, color.
    constexpr std::size_t kMaxDepth = 64;
    if (place_.brackets.size() == kMaxDepth) {
      ++deeper_;
      return;
    }
    ConfigBracket bracket{.open = c};
    if (!place_.brackets.empty()) bracket.owner = place_.brackets.back().key;
    place_.brackets.push_back(bracket);
  }

  void close(char c) {
    if (deeper_ > 0) {
      --deeper_;
      return;
    }
    auto& open = place_.brackets;
    const auto found = std::find_if(open.rbegin(), open.rend(), [&](const ConfigBracket& b) {
      return is_bracket_pair(b.open, c);
    });
    if (found != open.rend()) open.erase(found.base() - 1, open.end());
    place_.is_after_value = true;
  }

  static void read_mark(ConfigBracket& inner, char c) {
    if (c == ',') {
      inner.has_colon = false;
      ++inner.commas;
      if (inner.open == '{') inner.key = {};
    } else {
      inner.has_colon = true;
    }
  }

  std::string_view text_;
  ConfigPlace& place_;
  std::size_t deeper_ = 0;  ///< brackets that are open inside the innermost
};

/// The object around the `level`th bracket, or that it is.
const JsonObject* table_of(const ConfigPlace& place, std::size_t level) {
  const ConfigBracket& bracket = place.brackets[level];
  if (level == 0) return &json_config();
  if (level == 2 && place.brackets[1].owner == kSpheresKey) return &json_sphere();
  if (level != 1) return nullptr;
  for (const JsonKey& key : json_config().keys) {
    if (key.key == bracket.owner) return key.object;
  }
  return nullptr;
}

}  // namespace

std::string_view without_quotes(std::string_view token) noexcept {
  if (token.empty() || (token.front() != '"' && token.front() != '\'')) return token;
  const char quote = token.front();
  token.remove_prefix(1);
  if (token.ends_with(quote)) token.remove_suffix(1);
  return token;
}

ConfigPlace find_config_place(std::string_view text, std::uint32_t offset) {
  ConfigPlace place;
  place.offset = std::min(offset, static_cast<std::uint32_t>(text.size()));
  place.token = {place.offset, place.offset};
  ConfigReader reader(text, place);
  TokenReader tokens(text, 0, SourceFormat::Json);
  for (;;) {
    const Token token = tokens.next();
    if (token.kind == TokenKind::End || token.span.begin >= place.offset) return place;
    if (is_cursor_in(token, place.offset)) {
      place.is_comment = is_comment(token.kind);
      if (!is_trivia(token.kind)) place.token = token.span;
      return place;
    }
    if (!is_trivia(token.kind)) reader.read(token);
  }
}

std::vector<std::string_view> keys_after(const ConfigPlace& place, std::string_view text) {
  constexpr int kMaxTokens = 4096;
  std::vector<std::string_view> keys;
  TokenReader tokens(text, std::max(place.offset, place.token.end), SourceFormat::Json);
  std::uint32_t depth = 0;
  Token last;
  for (int i = 0; i < kMaxTokens; ++i) {
    const Token token = tokens.next_solid();
    if (token.kind == TokenKind::End) break;
    if (token.kind == TokenKind::Open) ++depth;
    if (token.kind == TokenKind::Close && depth-- == 0) break;
    if (depth == 0 && tokens.text(token) == ":" && last.span.size() > 0) {
      keys.push_back(without_quotes(tokens.text(last)));
    }
    last = token;
  }
  return keys;
}

const MaterialInfo* find_json_material(std::string_view type) noexcept {
  const auto materials = all_materials();
  const auto found = std::ranges::find(materials, type, &MaterialInfo::json_name);
  return found == materials.end() ? nullptr : &*found;
}

std::vector<JsonKey> ConfigObject::keys() const {
  if (table != nullptr) return {table->keys.begin(), table->keys.end()};
  if (material == nullptr) return {};
  const auto keys = json_material_keys(material->id);
  return {keys.begin(), keys.end()};
}

const JsonKey* ConfigObject::find(std::string_view key) const {
  std::span<const JsonKey> rows;
  if (table != nullptr) {
    rows = table->keys;
  } else if (material != nullptr) {
    rows = json_material_keys(material->id);
  }
  const auto found = std::ranges::find(rows, key, &JsonKey::key);
  return found == rows.end() ? nullptr : &*found;
}

ConfigObject find_config_object(const ConfigPlace& place) {
  if (place.brackets.empty()) return {};
  const std::size_t level = place.brackets.size() - 1;
  const ConfigBracket& inner = place.brackets.back();
  if (inner.open == '[') {
    return {.is_list_of_spheres = level == 1 && inner.owner == kSpheresKey};
  }
  ConfigObject object{.table = table_of(place, level)};
  const bool is_in_sphere = level > 0 && table_of(place, level - 1) == &json_sphere();
  object.is_material = is_in_sphere && inner.owner == kMaterialKey;
  if (object.is_material) object.material = find_json_material(inner.type);
  return object;
}

}  // namespace sdlc::lang
