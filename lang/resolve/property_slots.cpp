#include "lang/resolve/property_slots.hpp"

namespace sdlc::lang {

void PropertySlots::reset(std::string_view kind_) {
  kind = kind_;
  def = {};
  is_broken = false;
  names.clear();
  given.clear();
  others.clear();
}

void PropertySlots::add(const Property& property, std::string_view name) {
  names.push_back({name, &property, nullptr, 0});
  given.emplace_back();
}

void PropertySlots::add_parameter(const Parameter& parameter) {
  names.push_back({parameter.name, nullptr, parameter.type, parameter.node});
  given.emplace_back();
}

std::size_t PropertySlots::index_of(std::string_view name) const {
  std::size_t index = 0;
  while (index < names.size() && names[index].name != name) ++index;
  return index;
}

void PropertySlots::push_to(CodeBuilder& code, std::size_t first) const {
  for (std::size_t i = first; i < given.size(); ++i) {
    if (!given[i].is_written) continue;
    code.push(static_cast<std::uint32_t>(i - first));
    code.push(given[i].value);
  }
  for (const std::uint32_t other : others) code.push({kNothing, other});
}

}  // namespace sdlc::lang
