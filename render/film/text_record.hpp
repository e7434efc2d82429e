#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include "render/scene/digest.hpp"
#include "render/scene/settings.hpp"

/// Structs as lines of name and value. `members(record, visit)` calls `visit(name, member)` with
/// each member.
namespace sdlc::render::text {

inline constexpr std::string_view kNone = "-";

template <typename T>
std::string word_of(const T& value) {
  if constexpr (std::same_as<T, std::string>) {
    return value;
  } else if constexpr (std::same_as<T, std::optional<int>>) {
    return value ? std::to_string(*value) : std::string(kNone);
  } else if constexpr (std::same_as<T, Digest>) {
    return std::to_string(static_cast<std::uint64_t>(value));
  } else if constexpr (Choice<T>) {
    return std::string(name_of(value));
  } else if constexpr (std::same_as<T, double>) {
    std::array<char, 32> digits;
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};  // as many digits as give the same number again
  } else {
    return std::to_string(value);
  }
}

template <typename T>
bool read_word(std::string_view text, T& value) {
  if constexpr (std::same_as<T, std::string>) {
    value = text;
    return true;
  } else if constexpr (std::same_as<T, std::optional<int>>) {
    value.reset();
    return text == kNone || read_word(text, value.emplace());
  } else if constexpr (std::same_as<T, Digest>) {
    std::uint64_t number = 0;
    const bool is_read = read_word(text, number);
    value = Digest{number};
    return is_read;
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

/// The members as lines of name and value. Strings must not have line breaks.
template <typename Record, typename Members>
std::string text_of(const Record& record, Members members) {
  std::string text;
  members(record, [&](std::string_view name, const auto& member) {
    (text += name) += ' ';
    (text += word_of(member)) += '\n';
  });
  return text;
}

/// Reads text_of(). Returns false if it is not such a text.
template <typename Record, typename Members>
bool read_text(std::string_view text, Record& record, Members members) {
  bool is_read = true;
  members(record, [&](std::string_view name, auto& member) {
    const std::string_view line = text.substr(0, text.find('\n'));
    is_read = is_read && line.size() < text.size() && line.starts_with(name) &&
              line.substr(name.size()).starts_with(' ') &&
              read_word(line.substr(name.size() + 1), member);
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  });
  return is_read && text.empty();
}

/// The first member that differs, such as "`depth` is 8, not 16" or "it differs in `camera`";
/// empty if none does.
template <typename Record, typename Members>
std::string difference(const Record& record, const Record& expected, Members members) {
  const std::string expected_text = text_of(expected, members);
  std::string_view left = expected_text;
  std::string difference;
  members(record, [&](std::string_view name, const auto& member) {
    const std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(line.size() + 1);
    const std::string_view value = line.substr(name.size() + 1);
    const std::string other = word_of(member);
    if (!difference.empty() || other == value) return;
    if constexpr (std::same_as<std::remove_cvref_t<decltype(member)>, Digest>) {
      ((difference += "it differs in `") += name) += "`";
    } else {
      ((difference += "`") += name) += "` is ";
      ((difference += other) += ", not ") += value;
    }
  });
  return difference;
}

}  // namespace sdlc::render::text
