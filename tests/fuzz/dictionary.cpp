#include <cstdio>
#include <string_view>

#include "lang/schema/schema.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/types.hpp"

// Prints libFuzzer's dictionary for one of the two formats: the words of the tables, and the
// punctuation of the grammar.
namespace sdlc::lang {
namespace {

void print(std::string_view word) {
  std::fputc('"', stdout);
  for (const char c : word) {
    if (c == '\n') {
      std::fputs("\\x0A", stdout);
      continue;
    }
    if (c == '"' || c == '\\') std::fputc('\\', stdout);
    std::fputc(c, stdout);
  }
  std::fputs("\"\n", stdout);
}

void print_scene_words() {
  for (const std::string_view word :
       {"scene 1\n", "import ", "include ", "param ", "let ",  "fn ",  "def ",     "assert ",
        "for ",      " in ",    "if ",      "else ",  "then ", " as ", " and ",    " or ",
        "not ",      "true",    "false",    "time",   "pi",    " .. ", "==",       "<=",
        "///",       "//",      "/*",       "*/",     "1turn", "2ms",  "30deg",    "#80b3ff",
        "50%",       "1e308",   "0.5e-300", "\"",     "\\u00", "- ",   "(0, 0, 1)"}) {
    print(word);
  }
  for (const Kind& kind : all_kinds()) {
    print(kind.name);
    for (const Property& property : kind.properties) print(property.name);
  }
  for (const Builtin& builtin : all_builtins()) {
    print(builtin.name);
    for (const Property& option : builtin.options) {
      print(option.name);
      for (const std::string_view word : option.words) print(word);
    }
  }
  for (const Constructor& constructor : all_constructors()) {
    print(constructor.name);
    for (const Property& parameter : constructor.parameters) print(parameter.name);
  }
  for (const TypeInfo& type : all_types()) print(type.name);
}

void print_keys(const JsonObject& object) {
  for (const JsonKey& key : object.keys) {
    print(key.key);
    if (key.object != nullptr) print_keys(*key.object);
  }
}

void print_json_words() {
  for (const std::string_view word :
       {"true", "false", "null", "NaN", "Infinity", "1e308", "-0", "[0, 0, 1]", "\": {", "\\u00",
        "//", "/*", "'", ",", "type", "color"}) {
    print(word);
  }
  print_keys(json_config());
  print_keys(json_sphere());
  for (const MaterialInfo& material : all_materials()) {
    print(material.json_name);
    for (const JsonKey& key : json_material_keys(material.id)) print(key.key);
  }
}

}  // namespace
}  // namespace sdlc::lang

int main(int argc, char** argv) {
  const bool is_json = argc > 1 && std::string_view(argv[1]) == "json";
  if (is_json) {
    sdlc::lang::print_json_words();
  } else {
    sdlc::lang::print_scene_words();
  }
  return 0;
}
