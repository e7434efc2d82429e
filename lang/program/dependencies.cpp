#include "lang/program/dependencies.hpp"

#include <algorithm>
#include <string>

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

/// A depth-first walk with a stack of its own: a file may chain a million values.
class Sorter {
 public:
  Sorter(Module& module, Graph& graph, DiagnosticSink& sink)
      : module_(module),
        graph_(graph),
        sink_(sink),
        states_(graph.size(), State::New),
        is_circular_(graph.size(), false) {}

  void run() {
    for (std::size_t root = 0; root < graph_.size(); ++root) {
      if (states_[root] == State::New) walk_from(root);
    }
  }

 private:
  enum class State : std::uint8_t { New, OnTheWay, Done };
  struct Visit {
    std::size_t node;
    std::size_t next_use = 0;
  };

  void enter(std::size_t node) {
    states_[node] = State::OnTheWay;
    way_.push_back({.node = node});
  }

  void walk_from(std::size_t root) {
    enter(root);
    while (!way_.empty()) {
      const std::size_t current = way_.back().node;
      if (way_.back().next_use < graph_.degree(current)) {
        const std::size_t used = graph_.used(current, way_.back().next_use++);
        if (states_[used] == State::OnTheWay) report_circle(used);
        if (states_[used] == State::New) enter(used);
        continue;
      }
      states_[current] = State::Done;
      if (graph_.is_global(current) && !is_circular_[current]) {
        module_.order.push_back(static_cast<std::uint32_t>(current));
      }
      way_.pop_back();
    }
  }

  void report_circle(std::size_t start) {
    const auto first = std::find_if(way_.begin(), way_.end(),
                                    [&](const Visit& visit) { return visit.node == start; });
    // Functions may call each other in a circle; it is a value that cannot wait for itself.
    const bool has_value = std::any_of(
        first, way_.end(), [&](const Visit& visit) { return graph_.is_global(visit.node); });
    if (!has_value) return;
    std::vector<std::string> names;
    std::size_t value = start;
    for (auto visit = first; visit != way_.end(); ++visit) {
      is_circular_[visit->node] = true;
      if (!graph_.is_global(value)) value = visit->node;
      names.push_back(fmt::format("`{}`", graph_.name(visit->node)));
    }
    names.push_back(names.front());
    const ast::Node statement(module_.tree, module_.globals[value].node);
    sink_
        .report(diag::depends_on_itself, statement.first(SyntaxKind::Name)->location(),
                graph_.name(value))
        .help(fmt::format("the circle is {}", fmt::join(names, " → ")));
  }

  Module& module_;
  Graph& graph_;
  DiagnosticSink& sink_;
  std::vector<State> states_;
  std::vector<bool> is_circular_;
  std::vector<Visit> way_;
};

}  // namespace

void order_globals(Module& module, const std::vector<Uses>& of_globals,
                   const std::vector<Uses>& of_functions, DiagnosticSink& sink) {
  Graph graph(module, of_globals, of_functions);
  Sorter(module, graph, sink).run();

  // Backwards along the uses from what reads `time` itself: each node is reached once.
  std::vector<std::vector<std::size_t>> users(graph.size());
  std::vector<std::size_t> found;
  for (std::size_t node = 0; node < graph.size(); ++node) {
    for (std::size_t i = 0; i < graph.degree(node); ++i) users[graph.used(node, i)].push_back(node);
    graph.uses_time(node) = graph.uses(node).time;
    if (graph.uses(node).time) found.push_back(node);
  }
  while (!found.empty()) {
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
