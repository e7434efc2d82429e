#include "lang/resolve/global_order.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::lang {
namespace {

/// The globals and functions of a file as the nodes of one graph: the globals first.
class Graph {
 public:
  Graph(Module& module, const std::vector<Uses>& of_globals, const std::vector<Uses>& of_functions)
      : module_(module), globals_(of_globals), functions_(of_functions) {}

  std::size_t size() const { return globals_.size() + functions_.size(); }
  bool is_global(std::size_t node) const { return node < globals_.size(); }
  const Uses& uses(std::size_t node) const {
    return is_global(node) ? globals_[node] : functions_[node - globals_.size()];
  }
  std::size_t degree(std::size_t node) const {
    return uses(node).globals.size() + uses(node).functions.size();
  }
  /// The i-th node that this one uses.
  std::size_t used(std::size_t node, std::size_t i) const {
    const Uses& u = uses(node);
    return i < u.globals.size() ? u.globals[i]
                                : globals_.size() + u.functions[i - u.globals.size()];
  }
  std::string_view name(std::size_t node) const {
    return is_global(node) ? module_.globals[node].name
                           : module_.functions[node - globals_.size()].name;
  }
  bool& uses_time(std::size_t node) {
    return is_global(node) ? module_.globals[node].uses_time
                           : module_.functions[node - globals_.size()].uses_time;
  }

 private:
  Module& module_;
  const std::vector<Uses>&globals_, &functions_;
};

/// Tarjan's strongly connected components: each comes after those that it uses. The stack is
/// explicit, since a file may chain a million values.
class Sorter {
 public:
  Sorter(Module& module, Graph& graph, DiagnosticSink& sink)
      : module_(module), graph_(graph), sink_(sink), marks_(graph.size()) {}

  void run() {
    for (std::size_t root = 0; root < graph_.size(); ++root) {
      if (marks_[root].number == kNew) walk_from(root);
    }
  }

 private:
  static constexpr std::size_t kNew = static_cast<std::size_t>(-1);

  struct Mark {
    std::size_t number = kNew;  ///< in the order of discovery
    std::size_t lowest = kNew;  ///< the lowest number that can be reached
    bool is_open = false;       ///< its component is not complete
    std::size_t component = kNew;
  };
  struct Visit {
    std::size_t node;
    std::size_t next_use = 0;
  };

  void enter(std::size_t node) {
    marks_[node] = {.number = count_, .lowest = count_, .is_open = true, .component = kNew};
    ++count_;
    open_.push_back(node);
    path_.push_back({.node = node});
  }

  void walk_from(std::size_t root) {
    enter(root);
    while (!path_.empty()) {
      sink_.stop_if_requested();
      const std::size_t current = path_.back().node;
      if (path_.back().next_use < graph_.degree(current)) {
        const std::size_t used = graph_.used(current, path_.back().next_use++);
        if (marks_[used].number == kNew) {
          enter(used);
        } else if (marks_[used].is_open) {
          marks_[current].lowest = std::min(marks_[current].lowest, marks_[used].number);
        }
        continue;
      }
      path_.pop_back();
      if (!path_.empty()) {
        Mark& user = marks_[path_.back().node];
        user.lowest = std::min(user.lowest, marks_[current].lowest);
      }
      if (marks_[current].lowest == marks_[current].number) close_component(current);
    }
  }

  void close_component(std::size_t first) {
    const auto begin = std::find(open_.rbegin(), open_.rend(), first).base() - 1;
    std::vector<std::size_t> component(begin, open_.end());
    open_.erase(begin, open_.end());
    for (const std::size_t node : component) {
      marks_[node].is_open = false;
      marks_[node].component = first;
    }
    const auto global = std::find_if(component.begin(), component.end(),
                                     [&](std::size_t node) { return graph_.is_global(node); });
    // Functions may call each other in a cycle; values may not depend on themselves.
    if (global == component.end()) return;
    if (component.size() > 1 || uses_itself(first)) return report_cycle(*global);
    module_.order.push_back(static_cast<std::uint32_t>(first));
  }

  bool uses_itself(std::size_t node) const {
    for (std::size_t i = 0; i < graph_.degree(node); ++i) {
      if (graph_.used(node, i) == node) return true;
    }
    return false;
  }

  /// The shortest path from the node back to itself inside its component.
  std::vector<std::size_t> cycle_of(std::size_t start) const {
    std::unordered_map<std::size_t, std::size_t> comes_from;
    std::vector<std::size_t> found{start};
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t use = 0; use < graph_.degree(found[i]); ++use) {
        const std::size_t used = graph_.used(found[i], use);
        const bool is_inside = marks_[used].component == marks_[start].component;
        if (!is_inside || !comes_from.try_emplace(used, found[i]).second) continue;
        if (used != start) {
          found.push_back(used);
          continue;
        }
        std::vector<std::size_t> cycle{start};
        for (std::size_t node = found[i]; node != start; node = comes_from.at(node)) {
          cycle.push_back(node);
        }
        std::reverse(cycle.begin() + 1, cycle.end());
        return cycle;
      }
    }
    return {start};
  }

  void report_cycle(std::size_t global) {
    std::vector<std::string> names;
    for (const std::size_t node : cycle_of(global)) {
      names.push_back(fmt::format("`{}`", graph_.name(node)));
    }
    names.push_back(names.front());
    const ast::Node statement(module_.tree, module_.globals[global].node);
    sink_
        .report(diag::depends_on_itself, statement.first(SyntaxKind::Name)->location(),
                graph_.name(global))
        .help(fmt::format("the cycle is {}", fmt::join(names, " → ")));
  }

  Module& module_;
  Graph& graph_;
  DiagnosticSink& sink_;
  std::vector<Mark> marks_;
  std::size_t count_ = 0;
  std::vector<std::size_t> open_;
  std::vector<Visit> path_;
};

}  // namespace

void order_globals(Module& module, const std::vector<Uses>& of_globals,
                   const std::vector<Uses>& of_functions, DiagnosticSink& sink) {
  Graph graph(module, of_globals, of_functions);
  Sorter(module, graph, sink).run();

  // Backwards along the uses, from what reads `time` itself; each node is visited once.
  std::vector<std::vector<std::size_t>> users(graph.size());
  std::vector<std::size_t> found;
  for (std::size_t node = 0; node < graph.size(); ++node) {
    sink.stop_if_requested();
    for (std::size_t i = 0; i < graph.degree(node); ++i) users[graph.used(node, i)].push_back(node);
    graph.uses_time(node) = graph.uses(node).time;
    if (graph.uses(node).time) found.push_back(node);
  }
  while (!found.empty()) {
    sink.stop_if_requested();
    const std::size_t node = found.back();
    found.pop_back();
    for (const std::size_t user : users[node]) {
      if (graph.uses_time(user)) continue;
      graph.uses_time(user) = true;
      found.push_back(user);
    }
  }
}

}  // namespace sdlc::lang
