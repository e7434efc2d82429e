#include "lang/editor/config_completion.hpp"

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/editor/config_place.hpp"
#include "lang/editor/config_text.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/text/ascii.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

std::string in_quotes(std::string_view text) { return fmt::format("\"{}\"", text); }

/// A value with placeholders, numbered from `next` on.
std::string placeholder_of(JsonType type, int& next) {
  const auto take = [&](std::string_view format) {
    std::string text;
    for (const char c : format) text += c == '@' ? std::to_string(next++) : std::string(1, c);
    return text;
  };
  switch (type) {
    case JsonType::Triple: return take("[${@:0}, ${@:0}, ${@:0}]");
    case JsonType::Color: return take("[${@:255}, ${@:255}, ${@:255}]");
    case JsonType::Degrees: return take("${@:40}");
    case JsonType::Interval: return take("[${@:0}, ${@:1}]");
    case JsonType::Movement: return take("[[${@:0}, ${@:0}, ${@:0}], ${@:0}, ${@:1}]");
    case JsonType::Object: return "{\n  $0\n}";
    case JsonType::Spheres: return "[\n  $0\n]";
    case JsonType::Bool: return take("${@|true,false|}");
    case JsonType::String: return take("\"${@}\"");
    case JsonType::Material:
      return take("{ \"type\": \"${@:diffuse}\", \"color\": [${@:255}, ${@:255}, ${@:255}] }");
    case JsonType::Number:
    case JsonType::WholeNumber: break;
  }
  return take("${@:1}");
}

/// The snippet with the values of its placeholders.
std::string plain_text(std::string_view snippet) {
  std::string text;
  for (std::size_t i = 0; i < snippet.size(); ++i) {
    if (snippet[i] != '$') {
      text += snippet[i];
    } else if (snippet[i + 1] == '{') {
      const std::size_t colon = snippet.find_first_of(":|}", i), end = snippet.find('}', i);
      const std::string_view usual = snippet.substr(colon + 1, colon < end ? end - colon - 1 : 0);
      text += usual.substr(0, usual.find(','));
      i = end;
    } else {
      ++i;
    }
  }
  return text;
}

class ConfigCompletion {
 public:
  ConfigCompletion(const SourceFile& config, std::uint32_t offset)
      : config_(config),
        place_(find_config_place(config.text(), offset)),
        object_(find_config_object(place_)) {
    const std::string_view before =
        config.text().substr(place_.token.begin, place_.offset - place_.token.begin);
    prefix_ = before.starts_with('"') ? before.substr(1) : before;
  }

  CompletionList take() {
    if (place_.is_comment) return {};
    if (place_.brackets.empty()) {
      if (!place_.is_after_value && is_blank()) add_config();
    } else if (place_.is_key()) {
      add_keys();
    } else if (!place_.is_after_value) {
      add_values();
    }
    return std::move(list_);
  }

 private:
  bool is_blank() const {
    TokenReader tokens(config_.text(), 0, SourceFormat::Json);
    return tokens.next_solid().span.begin >= place_.token.begin;
  }

  bool accepts(std::string_view label) const {
    const std::string lower = lower_case(label), typed = lower_case(prefix_);
    return lower.find(typed) != std::string::npos;
  }

  /// `text`: what replaces the token, quotes included.
  void add(CompletionItem item) {
    if (!accepts(item.label)) return;
    item.replaced = place_.token;
    const bool has_quote = place_.token.size() > 0 && config_.text()[place_.token.begin] == '"';
    if (has_quote) item.filter = in_quotes(item.label);
    list_.items.push_back(std::move(item));
  }

  void add_snippet(std::string label, CompletionKind kind, std::string snippet,
                   std::string detail = {}, std::string_view documentation = {}) {
    add({.label = std::move(label),
         .kind = kind,
         .detail = std::move(detail),
         .documentation = std::string(documentation),
         .text = plain_text(snippet),
         .snippet = snippet});
  }

  void add_config() {
    add_snippet("config", CompletionKind::Snippet, "{\n  $0\n}", "a JSON config");
  }

  bool is_given(std::string_view key) const {
    const auto& before = place_.brackets.back().keys;
    return std::ranges::find(before, key) != before.end() ||
           std::ranges::find(after_, key) != after_.end();
  }

  bool has_colon() const {
    TokenReader tokens(config_.text(), std::max(place_.offset, place_.token.end),
                       SourceFormat::Json);
    return tokens.text(tokens.next_solid()) == ":";
  }

  void add_keys() {
    if (!place_.brackets.back().key.empty()) return;  // a colon is missing
    after_ = keys_after(place_, config_.text());
    if (object_.is_material && !is_given("type")) {
      std::string words;
      for (const MaterialInfo& m : all_materials()) {
        words += fmt::format("{}{}", words.empty() ? "" : ",", m.json_name);
      }
      add_key("type", fmt::format("\"${{1|{}|}}\"", words), "the type of the material, required",
              "It determines the other keys.");
    }
    std::vector<JsonKey> keys = object_.keys();
    std::ranges::stable_sort(
        keys, {}, [](const JsonKey& key) { return key.presence == Presence::Required ? 0 : 1; });
    for (const JsonKey& key : keys) {
      if (is_given(key.key)) continue;
      int next = 1;
      add_key(key.key, placeholder_of(key.type, next), describe_key(key),
              documentation_of(key, object_.material));
    }
  }

  void add_key(std::string_view key, const std::string& value, std::string detail,
               std::string_view documentation) {
    if (has_colon()) {
      return add({.label = std::string(key),
                  .kind = CompletionKind::Property,
                  .detail = std::move(detail),
                  .documentation = std::string(documentation),
                  .text = in_quotes(key)});
    }
    add({.label = std::string(key),
         .kind = CompletionKind::Property,
         .detail = std::move(detail),
         .documentation = std::string(documentation),
         .text = fmt::format("\"{}\": ", key),
         .snippet = fmt::format("\"{}\": {}", key, value)});
  }

  void add_values() {
    const ConfigBracket& inner = place_.brackets.back();
    if (object_.is_list_of_spheres) return add_sphere();
    if (inner.open != '{') return;
    if (object_.is_material && inner.key == "type") return add_types();
    const JsonKey* key = object_.find(inner.key);
    if (key != nullptr) add_value(*key);
  }

  void add_value(const JsonKey& key) {
    int next = 1;
    switch (key.type) {
      case JsonType::Bool:
        for (const std::string_view word : {"true", "false"}) {
          add({.label = std::string(word),
               .kind = CompletionKind::Word,
               .text = std::string(word)});
        }
        return;
      case JsonType::Material: return add_materials();
      case JsonType::String: {
        const std::filesystem::path path(config_.name());
        const std::string picture = path.stem().string() + ".png";
        return add({.label = picture, .kind = CompletionKind::Literal, .text = in_quotes(picture)});
      }
      case JsonType::Number:
      case JsonType::WholeNumber:
      case JsonType::Degrees: return;
      default: break;
    }
    const std::string snippet = placeholder_of(key.type, next);
    std::string label = key.type == JsonType::Object    ? "{ }"
                        : key.type == JsonType::Spheres ? "[ ]"
                                                        : plain_text(snippet);
    add_snippet(std::move(label), CompletionKind::Literal, snippet, describe_key(key), doc_of(key));
  }

  void add_types() {
    for (const MaterialInfo& material : all_materials()) {
      add({.label = std::string(material.json_name),
           .kind = CompletionKind::Word,
           .documentation = std::string(material.doc),
           .text = in_quotes(material.json_name)});
    }
  }

  void add_materials() {
    for (const MaterialInfo& material : all_materials()) {
      int next = 1;
      std::string snippet = fmt::format("{{ \"type\": \"{}\"", material.json_name);
      for (const JsonKey& key : json_material_keys(material.id)) {
        snippet += fmt::format(", \"{}\": {}", key.key, placeholder_of(key.type, next));
      }
      add_snippet(std::string(material.json_name), CompletionKind::Constructor, snippet + " }", {},
                  material.doc);
    }
  }

  void add_sphere() {
    int next = 1;
    std::string inside;
    for (const JsonKey& key : json_sphere().keys) {
      if (key.presence != Presence::Required) continue;
      inside += fmt::format("{}\n  \"{}\": {}", inside.empty() ? "" : ",", key.key,
                            placeholder_of(key.type, next));
    }
    add_snippet("sphere", CompletionKind::ObjectKind, "{" + inside + "\n}", "a sphere");
  }

  const SourceFile& config_;
  const ConfigPlace place_;
  const ConfigObject object_;
  std::string_view prefix_;
  std::vector<std::string_view> after_;
  CompletionList list_;
};

}  // namespace

CompletionList complete_config(const SourceFile& config, std::uint32_t offset) {
  return ConfigCompletion(config, offset).take();
}

}  // namespace sdlc::lang
