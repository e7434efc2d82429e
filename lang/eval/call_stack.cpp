#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/eval/evaluator.hpp"

// The call stack in diagnostics.
namespace sdlc::lang {

std::vector<ChainLink> Evaluator::chain() const {
  // Show only both ends of a deep recursion.
  constexpr std::ptrdiff_t kMaxLinksPerEnd = 5;
  std::vector<ChainLink> links;
  for (auto entry = stack_.rbegin(); entry != stack_.rend(); ++entry) {
    const bool is_in_last = stack_.rend() - entry <= kMaxLinksPerEnd;
    if (!is_in_last && entry - stack_.rbegin() >= kMaxLinksPerEnd) {
      const auto last = stack_.rend() - kMaxLinksPerEnd;
      links.push_back({.where = links.back().where,
                       .message = fmt::format("{} more steps like this", last - entry)});
      entry = last;
    }
    links.push_back(link_of(*entry));
  }
  return links;
}

ChainLink Evaluator::link_of(const StackEntry& entry) const {
  const ast::Node node(*entry.code->tree, entry.node);
  switch (entry.kind) {
    case StackEntry::Call:
    case StackEntry::Instance: return {node.head_location(), fmt::format("in `{}`", entry.name)};
    case StackEntry::Group:
      return {node.head_location(),
              entry.name.empty() ? "in a group" : fmt::format("in group `{}`", entry.name)};
    case StackEntry::Include: return {node.location(), "included"};
    case StackEntry::Iteration: break;
  }
  const auto names = ast::names_of_loop(node).all;
  const Location where = names.empty() ? node.location() : names[0].location();
  std::string numbers;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto* number = get_if<Scalar>(&locals_[entry.local + i].values[0]);
    if (number == nullptr) continue;
    numbers += fmt::format("{}{} = {}", numbers.empty() ? "" : ", ", names[i].text(),
                           to_text(number->value));
  }
  if (!numbers.empty()) return {where, fmt::format("with {}", numbers)};
  const std::string_view name = names.empty() ? std::string_view() : names[0].text();
  return {where, fmt::format("with {} in iteration {}", name, entry.iteration + 1)};
}

}  // namespace sdlc::lang
