#include "render/measure/configuration.hpp"

#include <algorithm>
#include <iterator>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::render {

std::vector<std::string> parts_of(const Configuration& configuration) {
  std::vector<std::string> parts;
  for_each_configuration_setting([&](const auto& setting) {
    if constexpr (std::is_same_v<decltype(configuration.*setting.member), const bool&>) {
      parts.emplace_back(configuration.*setting.member ? "denoised" : "");
      return;
    }
    const std::string_view space = setting.label.empty() ? "" : " ";
    parts.push_back(
        fmt::format("{}{}{}", setting.label, space, shown(configuration.*setting.member)));
  });
  return parts;
}

std::string join_parts(std::span<const std::string> parts, std::string_view separator) {
  std::vector<std::string> words;
  std::ranges::copy_if(parts, std::back_inserter(words),
                       [](const std::string& part) { return !part.empty(); });
  return fmt::format("{}", fmt::join(words, separator));
}

std::string describe(const Configuration& configuration) {
  return join_parts(parts_of(configuration));
}

}  // namespace sdlc::render
