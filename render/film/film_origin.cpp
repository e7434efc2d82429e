#include "render/film/film_origin.hpp"

#include <algorithm>
#include <charconv>
#include <concepts>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "render/scene/settings.hpp"

namespace sdlc::render {
namespace {

/// Calls `visit(name, member)` with each member of an origin.
template <typename Origin, typename Visit>
void for_each_member(Origin& origin, Visit visit) {
  visit("scene", origin.scene);
  visit("width", origin.width);
  visit("height", origin.height);
  visit("depth", origin.depth);
  visit("seed", origin.seed);
  visit("sampler", origin.sampler);
  visit("centred", origin.is_centred);
  visit("replicates", origin.replicates);
  visit("first_hits", origin.has_first_hits);
  visit("precision", origin.precision);
  visit("lights_at_metal", origin.samples_at_metal);
  visit("arithmetic", origin.arithmetic);
  visit("program", origin.program);
}

template <typename T>
std::string word_of(const T& value) {
  if constexpr (std::same_as<T, std::string>) {
    return value;
  } else if constexpr (Choice<T>) {
    return std::string(name_of(value));
  } else {
    return std::to_string(value);
  }
}

template <typename T>
bool read_word(std::string_view text, T& value) {
  if constexpr (std::same_as<T, std::string>) {
    value = text;
    return true;
  } else if constexpr (Choice<T>) {
    const std::optional<T> choice = choice_named<T>(text);
    if (choice) value = *choice;
    return choice.has_value();
  } else if constexpr (std::same_as<T, bool>) {
    value = text == "1";
    return value || text == "0";
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  }
}

}  // namespace

std::string text_of(const FilmOrigin& origin) {
  std::string text;
  for_each_member(origin, [&](std::string_view name, const auto& member) {
    (text += name) += ' ';
    (text += word_of(member)) += '\n';
  });
  return text;
}

bool read_text(std::string_view text, FilmOrigin& origin) {
  bool is_read = true;
  for_each_member(origin, [&](std::string_view name, auto& member) {
    const std::string_view line = text.substr(0, text.find('\n'));
    is_read = is_read && line.size() < text.size() && line.starts_with(name) &&
              line.substr(name.size()).starts_with(' ') &&
              read_word(line.substr(name.size() + 1), member);
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  });
  return is_read && text.empty();
}

std::string difference(const FilmOrigin& origin, const FilmOrigin& expected) {
  std::vector<std::pair<std::string, std::string>> members;
  for_each_member(expected, [&](const char* name, const auto& member) {
    members.emplace_back(name, word_of(member));
  });
  std::string text;
  std::size_t i = 0;
  for_each_member(origin, [&](const char*, const auto& member) {
    const auto& [name, value] = members[i++];
    const std::string other = word_of(member);
    if (text.empty() && other != value) {
      text = "its " + name + " is " + other + ", not " + value;
    }
  });
  return text;
}

}  // namespace sdlc::render
