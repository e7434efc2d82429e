#include "lang/eval/declarations.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace sdlc::lang {

std::string_view first_name(std::string_view path) noexcept {
  return path.substr(0, path.find_first_of(". \t\r\n/"));
}

std::string_view name_behind_dot(std::string_view member) noexcept {
  member.remove_prefix(std::min(member.find_first_not_of(". \t\r\n"), member.size()));
  return first_name(member);
}

std::string_view declared_name(ast::Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

Declarations::Declarations(ast::Node file, DiagnosticSink& sink) {
  collect(file, sink);
  sort(sink);
}

std::optional<ast::Node> Declarations::function(std::string_view name) const {
  const auto found = functions_.find(name);
  if (found == functions_.end()) return std::nullopt;
  return declarations_[found->second].statement;
}

void Declarations::collect(ast::Node file, DiagnosticSink& sink) {
  for (const ast::Node statement : file.children()) {
    const bool is_function = statement.is(SyntaxKind::Fn);
    if (!is_function && !statement.is(SyntaxKind::Let) && !statement.is(SyntaxKind::Param))
      continue;
    const auto name = statement.first(SyntaxKind::Name);
    if (!name) continue;
    auto& names = is_function ? functions_ : values_;
    const auto [first, is_new] = names.try_emplace(name->text(), declarations_.size());
    if (!is_new) {
      const ast::Node earlier = declarations_[first->second].statement;
      sink.report(diag::duplicate, name->location(), is_function ? "function" : "value",
                  name->text())
          .label(earlier.first(SyntaxKind::Name)->location(), "first declared here");
      continue;
    }
    if (is_function) function_names_.push_back(name->text());
    declarations_.push_back({.statement = statement, .uses = {}});
  }

  for (Declaration& declaration : declarations_) {
    const ast::Node statement = declaration.statement;
    std::vector<std::string_view> parameters;  // a parameter hides a value of its name
    for (const ast::Node child : statement.children()) {
      if (child.is(SyntaxKind::Parameter)) parameters.push_back(child.head());
    }
    const SyntaxTree& tree = statement.tree();
    for (NodeIndex i = statement.index(); i < statement.index() + tree[statement.index()].extent;
         ++i) {
      const ast::Node node(tree, i);
      const bool is_call = node.is(SyntaxKind::Call);
      if (!is_call && !node.is(SyntaxKind::Reference)) continue;
      const std::string_view name = first_name(is_call ? node.head() : node.text());
      const auto& names = is_call ? functions_ : values_;
      const bool is_hidden =
          !is_call && std::find(parameters.begin(), parameters.end(), name) != parameters.end();
      const auto used = names.find(name);
      if (used != names.end() && !is_hidden) declaration.uses.push_back(used->second);
    }
  }
}

void Declarations::sort(DiagnosticSink& sink) {
  enum class State : std::uint8_t { New, OnTheWay, Done };
  struct Visit {
    std::size_t declaration;
    std::size_t next_use = 0;
  };
  std::vector<State> states(declarations_.size(), State::New);
  std::vector<bool> is_circular(declarations_.size(), false);
  // An explicit stack: a file may chain a million values.
  std::vector<Visit> way;
  const auto is_function = [&](std::size_t i) {
    return declarations_[i].statement.is(SyntaxKind::Fn);
  };
  const auto report_cycle = [&](std::size_t start) {
    const auto first = std::find_if(way.begin(), way.end(),
                                    [&](const Visit& visit) { return visit.declaration == start; });
    // Functions may call each other in a circle; it is a value that cannot wait for itself.
    const bool has_value = std::any_of(
        first, way.end(), [&](const Visit& visit) { return !is_function(visit.declaration); });
    if (!has_value) return;
    std::vector<std::string> names;
    for (auto visit = first; visit != way.end(); ++visit) {
      is_circular[visit->declaration] = true;
      names.push_back(
          fmt::format("`{}`", declared_name(declarations_[visit->declaration].statement)));
    }
    names.push_back(names.front());
    const ast::Node statement = declarations_[start].statement;
    sink.report(diag::depends_on_itself, statement.first(SyntaxKind::Name)->location(),
                declared_name(statement))
        .help(fmt::format("the circle is {}", fmt::join(names, " → ")));
  };

  for (std::size_t root = 0; root < declarations_.size(); ++root) {
    if (states[root] != State::New) continue;
    way.push_back({.declaration = root});
    states[root] = State::OnTheWay;
    while (!way.empty()) {
      const std::size_t current = way.back().declaration;
      const auto& uses = declarations_[current].uses;
      if (way.back().next_use < uses.size()) {
        const std::size_t used = uses[way.back().next_use++];
        if (states[used] == State::OnTheWay) report_cycle(used);
        if (states[used] != State::New) continue;
        states[used] = State::OnTheWay;
        way.push_back({.declaration = used});
        continue;
      }
      states[current] = State::Done;
      if (!is_function(current) && !is_circular[current]) {
        order_.push_back(declarations_[current].statement);
      }
      way.pop_back();
    }
  }
}

}  // namespace sdlc::lang
