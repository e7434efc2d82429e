#include "lang/program/resolver.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/program/path.hpp"
#include "lang/text/nearest_name.hpp"

// Names, declarations and the building of code; resolve_statements.cpp, resolve_objects.cpp and
// resolve_expressions.cpp have the rest.
namespace sdlc::lang {

Resolver::Resolver(Program& program, std::uint32_t module, DiagnosticSink& sink)
    : program_(program),
      index_(module),
      module_(*program.modules_[module]),
      sink_(sink),
      code_(&module_.code) {}

const Resolver::Local* Resolver::find_local(std::string_view name) const {
  if (locals_.size() > kFewLocals) {
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) return &locals_[found->second];
  }
  for (std::size_t i = std::min(locals_.size(), kFewLocals); i > 0; --i) {
    if (locals_[i - 1].name == name) return &locals_[i - 1];
  }
  return nullptr;
}

std::uint32_t Resolver::declare(std::string_view name) {
  const auto slot = static_cast<std::uint32_t>(locals_.size());
  locals_.push_back({.name = name, .slot = slot});
  if (slot >= kFewLocals) {
    const auto [known, is_new] = by_name_.try_emplace(name, slot);
    if (!is_new) locals_.back().hidden = std::exchange(known->second, slot);
  }
  frame_size_ = std::max(frame_size_, slot + 1);
  return slot;
}

void Resolver::forget_locals(std::size_t from) {
  for (; locals_.size() > from; locals_.pop_back()) {
    if (locals_.size() <= kFewLocals) continue;
    const Local& last = locals_.back();
    if (last.hidden == kNothing) {
      by_name_.erase(last.name);
    } else {
      by_name_[last.name] = last.hidden;
    }
  }
}

std::optional<std::uint32_t> Resolver::find_import(std::string_view name) const {
  const auto found = module_.imports.find(name);
  return found == module_.imports.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string_view> meant_name(const std::optional<Habit>& habit, std::string_view name,
                                           std::span<const std::string_view> known) {
  if (!habit) return nearest_name(name, known);
  const bool is_known = std::ranges::find(known, habit->meant) != known.end();
  return is_known ? std::optional(habit->meant) : std::nullopt;
}

bool Resolver::may_suggest(std::size_t names) {
  constexpr std::uint64_t kMaxCompared = 2'000'000;
  module_.compared_names += names;
  return module_.compared_names <= kMaxCompared;
}

std::optional<std::string> Resolver::nearest_import(std::span<const std::string_view> names) const {
  std::vector<std::string_view> known;
  for (const auto& [name, module] : module_.imports) known.push_back(name);
  const auto nearest = nearest_name(names[0], known);
  if (!nearest) return std::nullopt;
  return fmt::format("{}.{}", *nearest, fmt::join(names.subspan(1), "."));
}

bool Resolver::is_excused(std::uint32_t module, std::string_view name, std::uint32_t use) {
  Module& declaring = *program_.modules_[module];
  if (!declaring.lost_names) declaring.lost_names = std::make_unique<LostNames>(declaring.tree);
  if (declaring.lost_names->contains(name)) return true;
  if (module != index_) return false;
  const Misspelling* misspelling = find_misspelling(use);
  if (misspelling == nullptr || !misspelling->is_certain) return false;
  sink_
      .report(diag::misspelt_declaration, misspelling->declared, misspelling->name,
              misspelling->meant)
      .unsafe_fix(misspelling->declared, std::string(misspelling->meant))
      .label(misspelling->used, fmt::format("`{}` is used here", misspelling->meant));
  return true;
}

const Misspelling* Resolver::find_misspelling(std::uint32_t use) {
  if (!module_.misspellings) {
    module_.misspellings = std::make_unique<Misspellings>(module_.tree);
  }
  return module_.misspellings->find(use);
}

void Resolver::label_unused(DiagnosticBuilder& report, std::uint32_t use,
                            std::optional<std::string_view> meant) {
  const Misspelling* misspelling = meant ? find_misspelling(use) : nullptr;
  if (misspelling == nullptr || misspelling->name != *meant) return;
  report.label(misspelling->declared,
               fmt::format("nothing uses `{}`, which is declared here", misspelling->name));
}

void Resolver::label_declared(DiagnosticBuilder& report, ast::Node statement) {
  if (const auto name = statement.first(SyntaxKind::Name)) {
    report.label(name->location(), fmt::format("`{}` is declared here", name->text()));
  }
}

// Declarations

void Resolver::resolve_declarations() {
  for (const ast::Node statement : ast::Node(module_.tree, 0).children()) collect(statement);

  std::vector<Uses> of_globals, of_functions;
  for (Global& global : module_.globals) {
    resolve_global(global);
    of_globals.push_back(std::move(uses_));
  }
  for (Definition& function : module_.functions) {
    resolve_definition(function);
    of_functions.push_back(std::move(uses_));
  }
  for (Definition& def : module_.defs) resolve_definition(def);
  order_globals(module_, of_globals, of_functions, sink_);
}

bool Resolver::add_name(std::unordered_map<std::string_view, std::uint32_t>& names,
                        std::string_view what, ast::Node name, std::uint32_t index) {
  if (names.try_emplace(name.text(), index).second) return true;
  report_duplicate(what, name);
  return false;
}

void Resolver::report_duplicate(std::string_view what, ast::Node name) {
  // Where the first one stands: one of the statements before this one.
  std::optional<Location> first;
  for (const ast::Node statement : ast::Node(module_.tree, 0).children()) {
    const auto other = statement.first(SyntaxKind::Name);
    const bool is_declaration = !ast::statement_word(statement.kind()).empty();
    if (!is_declaration || !other || other->text() != name.text()) continue;
    first = other->location();
    break;
  }
  auto report = sink_.report(diag::duplicate, name.location(), what, name.text());
  if (first) report.label(*first, "first declared here");
}

void Resolver::collect(ast::Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  if (!name || name->span().size() == 0) return;
  const auto next = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
  switch (statement.kind()) {
    case SyntaxKind::Import: return import_file(statement);
    case SyntaxKind::Let:
    case SyntaxKind::Param:
      if (module_.imports.contains(name->text())) {
        report_duplicate("value", *name);
      } else if (add_name(module_.global_names, "value", *name, next(module_.globals))) {
        module_.globals.push_back({.name = name->text(),
                                   .node = statement.index(),
                                   .is_param = statement.is(SyntaxKind::Param)});
      }
      return;
    case SyntaxKind::Fn:
      if (add_name(module_.function_names, "function", *name, next(module_.functions))) {
        collect_definition(statement, module_.functions.emplace_back());
      }
      return;
    case SyntaxKind::Def:
      if (add_name(module_.def_names, "kind", *name, next(module_.defs))) {
        collect_definition(statement, module_.defs.emplace_back());
      }
      return;
    default: return;
  }
}

namespace {

/// Whether something is wrong between the name and the end of the parameters.
bool has_broken_parameters(ast::Node statement) {
  std::uint32_t end = statement.span().begin;
  std::optional<Span> error;
  for (const ast::Node child : statement.children()) {
    if (child.is(SyntaxKind::Name) || child.is(SyntaxKind::Parameter)) {
      if (child.is_broken()) return true;
      end = child.span().end;
    } else if (error) {
      return true;  // behind it is what the parameters are for
    } else if (child.is(SyntaxKind::Error)) {
      error = child.span();
    }
  }
  if (!error) return false;
  return statement.tree().text({end, error->begin}).find(')') == std::string_view::npos;
}

}  // namespace

void Resolver::collect_definition(ast::Node statement, Definition& definition) {
  definition.name = ast::declared_name(statement);
  definition.node = statement.index();
  definition.is_broken = has_broken_parameters(statement);
  std::unordered_map<std::string_view, Location> declared;
  for (const ast::Node child : statement.children()) {
    if (!child.is(SyntaxKind::Parameter)) continue;
    const auto [same, is_new] = declared.try_emplace(child.head(), child.head_location());
    if (!is_new) {
      sink_.report(diag::duplicate, child.head_location(), "parameter", child.head())
          .label(same->second, "first declared here");
      continue;
    }
    const bool is_placement =
        child.head() == "translate" || child.head() == "rotate" || child.head() == "scale";
    if (statement.is(SyntaxKind::Def) && is_placement) {
      sink_.report(diag::placement_parameter, child.head_location(), child.head());
    }
    definition.parameters.push_back({.name = child.head(),
                                     .node = child.index(),
                                     .has_default = ast::expression_of(child).has_value()});
  }
}

void Resolver::import_file(ast::Node statement) {
  const auto file = statement.first(SyntaxKind::String);
  const auto name = statement.first(SyntaxKind::Name);
  if (!file || !name) return;
  if (module_.imports.contains(name->text()) || module_.global_names.contains(name->text())) {
    report_duplicate("value", *name);
    return;
  }
  module_.imports.emplace(name->text(), program_.load(index_, *file, false, sink_));
}

void Resolver::resolve_global(Global& global) {
  const ast::Node statement(module_.tree, global.node);
  uses_ = {};
  frame_size_ = 0;
  if (const auto type = statement.first(SyntaxKind::TypeName)) global.type = resolve_type(*type);
  declaring_ = global.name;
  if (const auto value = ast::expression_of(statement)) global.value = expression(*value);
  declaring_ = {};
}

void Resolver::resolve_definition(Definition& definition) {
  const ast::Node statement(module_.tree, definition.node);
  uses_ = {};
  frame_size_ = 0;
  const Scope scope(*this);
  for (Parameter& parameter : definition.parameters) {
    const ast::Node node(module_.tree, parameter.node);
    if (const auto type = node.first(SyntaxKind::TypeName)) parameter.type = resolve_type(*type);
    if (const auto value = ast::expression_of(node)) parameter.default_value = expression(*value);
    declare(parameter.name);
  }
  if (statement.is(SyntaxKind::Fn)) {
    if (const auto body = ast::expression_of(statement)) definition.body = expression(*body);
  } else if (const auto body = statement.first(SyntaxKind::Block)) {
    const std::size_t mark = pending_.size();
    block(*body);
    definition.block.assign(pending_.begin() + static_cast<std::ptrdiff_t>(mark) + 1,
                            pending_.end());
    pending_.resize(mark);
  }
  definition.frame_size = frame_size_;
}

const TypeInfo* Resolver::resolve_type(ast::Node node) {
  const TypeInfo* type = find_type(node.text());
  if (type != nullptr) return type;
  std::vector<std::string_view> names;
  for (const TypeInfo& known : all_types()) names.push_back(known.name);
  sink_.report(diag::unknown_type, node.location(), node.text())
      .suggest(meant_name(find_habit(HabitPlace::Type, node.text()), node.text(), names))
      .help(fmt::format("types are {}", fmt::join(names, ", ")));
  return nullptr;
}

// Code

std::uint32_t Resolver::add(Op op, ast::Node node, std::uint32_t first, std::uint32_t count,
                            std::uint8_t detail) {
  code_->expressions.push_back({.op = op,
                                .before = Operator::None,
                                .detail = detail,
                                .node = node.index(),
                                .first = first,
                                .count = count});
  return static_cast<std::uint32_t>(code_->expressions.size() - 1);
}

std::uint32_t Resolver::add_with(Op op, ast::Node node, std::size_t mark, std::uint8_t detail) {
  const auto first = static_cast<std::uint32_t>(code_->operands.size());
  const auto begin = pending_.begin() + static_cast<std::ptrdiff_t>(mark);
  code_->operands.insert(code_->operands.end(), begin, pending_.end());
  const auto count = static_cast<std::uint32_t>(pending_.size() - mark);
  pending_.resize(mark);
  return add(op, node, first, count, detail);
}

std::uint32_t Resolver::add_statement(Action action, ast::Node node, std::size_t mark,
                                      ObjectKind kind) {
  const auto first = static_cast<std::uint32_t>(code_->operands.size());
  const auto begin = pending_.begin() + static_cast<std::ptrdiff_t>(mark);
  code_->operands.insert(code_->operands.end(), begin, pending_.end());
  code_->statements.push_back({.action = action,
                               .kind = kind,
                               .node = node.index(),
                               .first = first,
                               .count = static_cast<std::uint32_t>(pending_.size() - mark)});
  pending_.resize(mark);
  return static_cast<std::uint32_t>(code_->statements.size() - 1);
}

}  // namespace sdlc::lang
