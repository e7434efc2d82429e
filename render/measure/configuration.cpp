#include "render/measure/configuration.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::render {

std::vector<std::string> parts_of(const Configuration& configuration) {
  std::vector<std::string> parts;
  for_each_configuration_setting([&](const auto& setting) {
    const std::string_view space = setting.label.empty() ? "" : " ";
    parts.push_back(
        fmt::format("{}{}{}", setting.label, space, shown(configuration.*setting.member)));
  });
  return parts;
}

std::string describe(const Configuration& configuration) {
  return fmt::format("{}", fmt::join(parts_of(configuration), ", "));
}

}  // namespace sdlc::render
