#include "lang/lint/context.hpp"

namespace sdlc::lang {

std::vector<std::uint32_t> LintContext::spheres_of_materials() const {
  std::vector<bool> is_seen(scene().materials.size());
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < spheres().size(); ++i) {
    if (is_seen[spheres()[i].material]) continue;
    is_seen[spheres()[i].material] = true;
    first.push_back(i);
  }
  return first;
}

}  // namespace sdlc::lang
