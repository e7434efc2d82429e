#include "render/scene/settings.hpp"

#include <algorithm>

namespace sdlc::render {

std::string flag_of(std::string_view setting) {
  std::string flag = "--" + std::string(setting);
  std::ranges::replace(flag, '_', '-');
  return flag;
}

}  // namespace sdlc::render
