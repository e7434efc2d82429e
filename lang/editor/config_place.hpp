#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A bracket of a JSON config that is open at the cursor.
struct ConfigBracket {
  char open = '{';
  std::string_view owner = {};              ///< the key whose value it is; of an element empty
  std::vector<std::string_view> keys = {};  ///< before the cursor
  std::string_view key = {};                ///< whose value is at the cursor, if has_colon
  bool has_colon = false;
  std::string_view type = {};  ///< the value of the key `type`, without quotes
  std::uint32_t commas = 0;    ///< since the bracket
};

/// What the cursor in a JSON config is in, by the tokens before it.
struct ConfigPlace {
  std::vector<ConfigBracket> brackets = {};  ///< outermost first
  bool is_comment = false;
  std::uint32_t offset = 0;
  Span token = {};  ///< the string, word or number that the cursor is in or after; or empty
  /// Whether the value at the cursor is complete: a comma or bracket must follow.
  bool is_after_value = false;

  bool is_key() const noexcept {
    return !brackets.empty() && brackets.back().open == '{' && !brackets.back().has_colon;
  }
};

ConfigPlace find_config_place(std::string_view text, std::uint32_t offset);

/// The keys that the object at the cursor has after it.
std::vector<std::string_view> keys_after(const ConfigPlace& place, std::string_view text);

/// What the tables say about the object that the innermost bracket is or is in.
struct ConfigObject {
  const JsonObject* table = nullptr;       ///< null: a material, or unknown
  const MaterialInfo* material = nullptr;  ///< by its `type`, which may be missing
  bool is_material = false;
  bool is_list_of_spheres = false;  ///< the bracket is the `[` of the spheres

  std::vector<JsonKey> keys() const;  ///< `type` of a material is not one of them
  /// Null if there is no such key.
  const JsonKey* find(std::string_view key) const;
};
ConfigObject find_config_object(const ConfigPlace& place);

/// The material whose `type` in JSON is this, or null.
const MaterialInfo* find_json_material(std::string_view type) noexcept;

/// The text between the quotes of a token, if it has any.
std::string_view without_quotes(std::string_view token) noexcept;

}  // namespace sdlc::lang
