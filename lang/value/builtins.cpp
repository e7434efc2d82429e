#include "lang/value/builtins.hpp"

#include <unordered_map>
#include <vector>

#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {

std::span<const Builtin> all_builtins() noexcept {
  static const std::vector<Builtin> builtins = [] {
    std::vector<Builtin> all;
    // Completion shows the usual ones first.
    for (const auto table :
         {number_functions(), angle_functions(), list_functions(), text_functions(),
          vector_functions(), random_functions(), motion_functions()}) {
      all.insert(all.end(), table.begin(), table.end());
    }
    return all;
  }();
  return builtins;
}

std::optional<ast::Node> BuiltinCall::option_node(std::size_t option) const {
  std::size_t positional = 0;
  for (const ast::Node written : node.children()) {
    if (written.is(SyntaxKind::Argument)) {
      if (written.head() == function.options[option].name) return ast::Labeled{written}.value();
    } else if (positional++ == function.max_arguments + option) {
      return written;
    }
  }
  return std::nullopt;
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
