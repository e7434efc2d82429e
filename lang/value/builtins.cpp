#include "lang/value/builtins.hpp"

#include <unordered_map>
#include <vector>

#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {

std::span<const Builtin> all_builtins() noexcept {
  static const std::vector<Builtin> builtins = [] {
    std::vector<Builtin> all;
    for (const auto table : {number_functions(), angle_functions(), vector_functions(),
                             list_functions(), text_functions(), random_functions()}) {
      all.insert(all.end(), table.begin(), table.end());
    }
    return all;
  }();
  return builtins;
}

std::size_t Builtin::index() const noexcept {
  return static_cast<std::size_t>(this - all_builtins().data());
}

const Builtin* find_builtin(std::string_view name) noexcept {
  static const std::unordered_map<std::string_view, const Builtin*> by_name = [] {
    std::unordered_map<std::string_view, const Builtin*> map;
    for (const Builtin& builtin : all_builtins()) map.emplace(builtin.name, &builtin);
    return map;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

}  // namespace sdlc::lang
