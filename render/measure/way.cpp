#include "render/measure/way.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::render {

std::vector<std::string> parts_of(const Way& way) {
  std::vector<std::string> parts;
  for_each_way_setting([&](const auto& setting) {
    const std::string_view space = setting.label.empty() ? "" : " ";
    parts.push_back(fmt::format("{}{}{}", setting.label, space, shown(way.*setting.member)));
  });
  return parts;
}

std::string describe(const Way& way) { return fmt::format("{}", fmt::join(parts_of(way), ", ")); }

}  // namespace sdlc::render
