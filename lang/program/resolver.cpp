#include "lang/program/resolver.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/program/path.hpp"
#include "lang/text/nearest_name.hpp"

// Declarations and statements; resolve_expressions.cpp has the expressions.
namespace sdlc::lang {
namespace {

/// The word that a statement other than a property or object begins with.
std::string_view statement_word(SyntaxKind kind) noexcept {
  switch (kind) {
    case SyntaxKind::Import: return "import";
    case SyntaxKind::Include: return "include";
    case SyntaxKind::Param: return "param";
    case SyntaxKind::Let: return "let";
    case SyntaxKind::Fn: return "fn";
    case SyntaxKind::Def: return "def";
    case SyntaxKind::Assert: return "assert";
    case SyntaxKind::For: return "for";
    case SyntaxKind::If: return "if";
    default: return "";
  }
}

Location word_location(ast::Node statement) {
  const auto size = static_cast<std::uint32_t>(statement_word(statement.kind()).size());
  return statement.tree().location({statement.span().begin, statement.span().begin + size});
}

std::string_view declared_name(ast::Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  return name ? name->text() : std::string_view();
}

/// The expression of a let, param, fn or parameter.
std::optional<ast::Node> expression_of(ast::Node node) {
  std::optional<ast::Node> found;
  for (const ast::Node child : node.children()) {
    const bool is_other = child.is(SyntaxKind::Name) || child.is(SyntaxKind::TypeName) ||
                          child.is(SyntaxKind::Parameter);
    if (!is_other) found = child;
  }
  return found;
}

const Kind* find_kind(std::string_view name) noexcept {
  const auto kinds = all_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

template <typename Map>
std::optional<std::uint32_t> find(const Map& map, std::string_view name) {
  if (map.empty()) return std::nullopt;
  const auto found = map.find(name);
  return found == map.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

/// Forgets at its end what was declared while it lived.
class Resolver::Scope {
 public:
  explicit Scope(Resolver& resolver)
      : resolver_(resolver),
        size_(resolver.locals_.size()),
        block_begin_(std::exchange(resolver.block_begin_, size_)) {}
  ~Scope() {
    resolver_.locals_.resize(size_);
    resolver_.block_begin_ = block_begin_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Resolver& resolver_;
  std::size_t size_, block_begin_;
};

Resolver::Resolver(Program& program, std::uint32_t module, DiagnosticSink& sink)
    : program_(program),
      index_(module),
      module_(*program.modules_[module]),
      sink_(sink),
      code_(&module_.code) {}

const Resolver::Local* Resolver::find_local(std::string_view name) const {
  for (std::size_t i = locals_.size(); i > 0; --i) {
    if (locals_[i - 1].name == name) return &locals_[i - 1];
  }
  return nullptr;
}

std::uint32_t Resolver::declare(std::string_view name) {
  const auto slot = static_cast<std::uint32_t>(locals_.size());
  locals_.push_back({name, slot});
  frame_size_ = std::max(frame_size_, slot + 1);
  return slot;
}

std::optional<std::uint32_t> Resolver::find_import(std::string_view name) const {
  return find(module_.imports, name);
}

std::optional<std::string> Resolver::nearest_import(
    std::span<const std::string_view> names) const {
  std::vector<std::string_view> known;
  for (const auto& [name, module] : module_.imports) known.push_back(name);
  const auto nearest = nearest_name(names[0], known);
  if (!nearest) return std::nullopt;
  return fmt::format("{}.{}", *nearest, fmt::join(names.subspan(1), "."));
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
    const bool is_declaration = !statement_word(statement.kind()).empty();
    if (!is_declaration || !other || other->text() != name.text()) continue;
    first = other->location();
    break;
  }
  auto report = sink_.report(diag::duplicate, name.location(), what, name.text());
  if (first) report.label(*first, "first declared here");
}

void Resolver::collect(ast::Node statement) {
  const auto name = statement.first(SyntaxKind::Name);
  if (!name) return;
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

void Resolver::collect_definition(ast::Node statement, Definition& definition) {
  definition.name = declared_name(statement);
  definition.node = statement.index();
  for (const ast::Node child : statement.children()) {
    if (!child.is(SyntaxKind::Parameter)) continue;
    const auto same = std::find_if(definition.parameters.begin(), definition.parameters.end(),
                                   [&](const Parameter& p) { return p.name == child.head(); });
    if (same != definition.parameters.end()) {
      sink_.report(diag::duplicate, child.head_location(), "parameter", child.head())
          .label(ast::Node(module_.tree, same->node).head_location(), "first declared here");
      continue;
    }
    const bool is_placement = child.head() == "translate" || child.head() == "rotate" ||
                              child.head() == "scale";
    if (statement.is(SyntaxKind::Def) && is_placement) {
      sink_.report(diag::placement_parameter, child.head_location(), child.head());
    }
    definition.parameters.push_back({.name = child.head(),
                                     .node = child.index(),
                                     .has_default = expression_of(child).has_value()});
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
  if (const auto value = expression_of(statement)) global.value = expression(*value);
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
    if (const auto value = expression_of(node)) parameter.default_value = expression(*value);
    declare(parameter.name);
  }
  if (statement.is(SyntaxKind::Fn)) {
    if (const auto body = expression_of(statement)) definition.body = expression(*body);
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
      .suggest(nearest_name(node.text(), names));
  return nullptr;
}

// Statements

std::uint32_t Resolver::resolve_statement(ast::Node node, Code& code, std::uint32_t& frame_size) {
  code_ = &code;
  frame_size_ = 0;
  const std::uint32_t index = statement(node, true);
  frame_size = frame_size_;
  code_ = &module_.code;
  return index;
}

std::uint32_t Resolver::resolve_expression() {
  const ast::Node file(module_.tree, 0);
  const auto value = file.child(0);
  return value ? expression(*value) : broken(file);
}

std::uint32_t Resolver::statement(ast::Node node, bool is_top) {
  switch (node.kind()) {
    case SyntaxKind::Object: return object({node}, is_top);
    case SyntaxKind::Let: return is_top ? kNothing : let_statement(node);
    case SyntaxKind::For: return for_statement(node);
    case SyntaxKind::If: return if_statement(node);
    case SyntaxKind::Assert: return assert_statement(node);
    case SyntaxKind::Include: return include_statement(node);
    case SyntaxKind::Property: {
      const ast::Labeled property{node};
      auto report =
          sink_.report(diag::property_outside, property.label_location(), property.label());
      if (!is_top) {
        report.help(fmt::format("it stands in its object itself: `{}: if … then … else …`",
                                property.label()));
      }
      return kNothing;
    }
    case SyntaxKind::Import:
    case SyntaxKind::Param:
    case SyntaxKind::Fn:
    case SyntaxKind::Def:
      if (!is_top) top_level_only(node);
      return kNothing;
    default: return kNothing;
  }
}

void Resolver::top_level_only(ast::Node statement) {
  sink_.report(diag::top_level_only, word_location(statement), statement_word(statement.kind()));
}

void Resolver::block(ast::Node node) {
  const Scope scope(*this);
  const std::size_t mark = pending_.size();
  pending_.push_back(0);
  for (const ast::Node child : node.children()) {
    const std::uint32_t index = statement(child, false);
    if (index != kNothing) pending_.push_back(index);
  }
  pending_[mark] = static_cast<std::uint32_t>(pending_.size() - mark - 1);
}

std::uint32_t Resolver::let_statement(ast::Node node) {
  const auto value = expression_of(node);
  declaring_ = declared_name(node);
  const std::uint32_t result = value ? expression(*value) : broken(node);
  declaring_ = {};
  const auto name = node.first(SyntaxKind::Name);
  const bool is_again = name && std::any_of(locals_.begin() + static_cast<std::ptrdiff_t>(block_begin_),
                                            locals_.end(), [&](const Local& local) {
                                              return local.name == name->text();
                                            });
  if (is_again) sink_.report(diag::duplicate, name->location(), "value", name->text());
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {declare(declared_name(node)), result});
  return add_statement(Action::Let, node, mark);
}

std::uint32_t Resolver::for_statement(ast::Node node) {
  const auto list = node.child(1), body = node.child(2);
  if (!list || !body || !body->is(SyntaxKind::Block)) return kNothing;
  const std::uint32_t values = expression(*list);
  const Scope scope(*this);
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {declare(declared_name(node)), values});
  block(*body);
  return add_statement(Action::For, node, mark);
}

std::uint32_t Resolver::if_statement(ast::Node node) {
  // Conditions and blocks take turns; a last block without a condition is the one behind `else`.
  const std::size_t mark = pending_.size();
  bool has_condition = false;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Block)) {
      if (!has_condition) pending_.push_back(kNothing);
      block(child);
      has_condition = false;
    } else {
      const std::uint32_t condition = expression(child);
      if (has_condition) pending_.push_back(0);  // the block before it could not be read
      pending_.push_back(condition);
      has_condition = true;
    }
  }
  if (has_condition) pending_.push_back(0);
  return add_statement(Action::If, node, mark);
}

std::uint32_t Resolver::assert_statement(ast::Node node) {
  const auto condition = node.child(0), message = node.child(1);
  if (!condition || !message) return kNothing;
  const std::uint32_t first = expression(*condition), second = expression(*message);
  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {first, second});
  return add_statement(Action::Assert, node, mark);
}

std::uint32_t Resolver::include_statement(ast::Node node) {
  const auto file = node.first(SyntaxKind::String);
  const std::uint32_t loaded =
      file ? program_.load(index_, *file, true, sink_) : kNothing;
  if (loaded == kNothing) return kNothing;
  const std::size_t mark = pending_.size();
  pending_.push_back(loaded);
  return add_statement(Action::Include, node, mark);
}

// Objects

std::uint32_t Resolver::object(ast::Object node, bool is_top) {
  const std::string_view path = node.kind();
  const bool is_path = path.find('.') != std::string_view::npos;
  if (!is_path) {
    if (const auto def = find(module_.def_names, path)) return instance_of(index_, *def, node);
    const Kind* kind = find_kind(path);
    if (kind == nullptr) return unknown_kind(node, index_);
    if (kind->is_setting && !is_top) {
      sink_.report(diag::top_level_only, node.kind_location(), kind->name);
      return kNothing;
    }
    return object_of(*kind, node);
  }

  const std::vector<std::string_view> names = split_path(path);
  const auto module = find_import(names[0]);
  if (!module) {
    sink_.report(diag::unknown_kind, node.kind_location(), path).suggest(nearest_import(names));
    return kNothing;
  }
  if (*module == kNothing) return kNothing;  // reported where it is imported
  const auto def = names.size() == 2 ? find(program_.module(*module).def_names, names[1])
                                     : std::nullopt;
  return def ? instance_of(*module, *def, node) : unknown_kind(node, *module);
}

std::uint32_t Resolver::unknown_kind(ast::Object node, std::uint32_t scope) {
  std::vector<std::string_view> names;
  const Module& module = program_.module(scope);
  for (const Definition& def : module.defs) names.push_back(def.name);
  std::string_view written = node.kind();
  if (scope == index_) {
    for (const Kind& known : all_kinds()) names.push_back(known.name);
  } else {
    written = split_path(written).back();
  }
  auto report = sink_.report(diag::unknown_kind, node.kind_location(), node.kind());
  const auto nearest = nearest_name(written, names);
  if (scope == index_) {
    report.suggest(nearest);
  } else if (nearest) {
    report.suggest(fmt::format("{}.{}", split_path(node.kind())[0], *nearest));
  }
  if (module_.function_names.contains(node.kind())) {
    report.help(fmt::format("`{}` is a function; `def` makes a kind of object", node.kind()));
  }
  // What stands inside may have mistakes of its own, but no one knows which names it may use.
  return kNothing;
}

void Resolver::check_name(const Kind& kind, ast::Object node) {
  const auto name = node.name();
  if (!name || kind.takes_name) return;
  sink_.report(diag::takes_no_name, name->location(), kind.name).fix(name->location(), "");
}

void Resolver::misplaced(std::string_view kind, ast::Node statement) {
  const bool is_object = statement.is(SyntaxKind::Object);
  const Location where = is_object ? statement.head_location() : word_location(statement);
  const std::string_view word = is_object ? statement.head() : statement_word(statement.kind());
  auto report = sink_.report(diag::properties_only, where, kind, word);
  if (!statement.is(SyntaxKind::If)) return;
  const auto block = statement.first(SyntaxKind::Block);
  const auto property = block ? block->first(SyntaxKind::Property) : std::nullopt;
  if (property) report.help(fmt::format("write `{}: if … then … else …`", property->head()));
}

void Resolver::Slots::reset(std::string_view kind_) {
  kind = kind_;
  names.clear();
  given.clear();
  others.clear();
}

void Resolver::Slots::add(std::string_view name, const Property* property) {
  names.push_back({name, property});
  given.emplace_back();
}

std::size_t Resolver::Slots::index_of(std::string_view name) const {
  std::size_t index = 0;
  while (index < names.size() && names[index].name != name) ++index;
  return index;
}

/// Where the value of an unknown property goes: to the one that was probably meant, unless that one
/// stands there too. What is missing only because of a slip of the pen is not missing.
std::size_t Resolver::guess_property(ast::Labeled node) {
  std::vector<std::string_view> names;
  for (const Slots::Name& known : slots_.names) names.push_back(known.name);
  const auto nearest = nearest_name(node.label(), names);
  sink_.report(diag::unknown_property, node.label_location(), node.label(), slots_.kind)
      .suggest(nearest);
  const std::size_t index = nearest ? slots_.index_of(*nearest) : names.size();
  return index < names.size() && !slots_.given[index].is_written ? index : names.size();
}

void Resolver::read_property(ast::Labeled node) {
  const std::size_t none = slots_.names.size();
  std::size_t index = slots_.index_of(node.label());
  const bool is_guess = index == none;
  if (is_guess) {
    index = guess_property(node);
  } else if (slots_.given[index].is_written && !slots_.given[index].is_guess) {
    sink_.report(diag::duplicate, node.label_location(), "property", node.label())
        .label(node.node.tree().location(slots_.given[index].span), "first given here");
    index = none;
  }

  const auto value = node.value();
  const Property* property = index == none ? nullptr : slots_.names[index].property;
  const std::uint32_t result = value ? expression(*value, property) : broken(node.node);
  if (index == none) {
    slots_.others.push_back(result);
  } else {
    slots_.given[index] = {.value = result,
                           .span = value ? value->span() : node.node.span(),
                           .is_written = true,
                           .is_guess = is_guess};
  }
}

void Resolver::read_properties(ast::Object node) {
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      read_property({child});
    } else if (!child.is(SyntaxKind::Name) && !child.is(SyntaxKind::Error)) {
      misplaced(slots_.kind, child);
    }
  }
}

void Resolver::push_properties(std::size_t first) {
  for (std::size_t i = first; i < slots_.given.size(); ++i) {
    if (!slots_.given[i].is_written) continue;
    pending_.push_back(static_cast<std::uint32_t>(i - first));
    pending_.push_back(slots_.given[i].value);
  }
  for (const std::uint32_t other : slots_.others) {
    pending_.push_back(kNothing);
    pending_.push_back(other);
  }
}

std::uint32_t Resolver::object_of(const Kind& kind, ast::Object node) {
  check_name(kind, node);
  if (kind.id == ObjectKind::Group) return group(kind, node);
  slots_.reset(kind.name);
  for (const Property& property : kind.properties) slots_.add(property.name, &property);
  read_properties(node);
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    const Property& property = kind.properties[i];
    const bool is_missing =
        property.presence == Presence::Required && !slots_.given[i].is_written;
    // A property that could not be read may be the one that is missing.
    if (is_missing && !node.is_broken()) {
      sink_.report(diag::missing, node.kind_location(), kind.name, property.name);
    }
  }
  const std::size_t mark = pending_.size();
  push_properties(0);
  return add_statement(Action::Object, node.node, mark, kind.id);
}

std::uint32_t Resolver::group(const Kind& kind, ast::Object node) {
  const Scope scope(*this);
  Slots own;
  own.reset(kind.name);
  for (const Property& property : kind.properties) own.add(property.name, &property);
  std::vector<std::uint32_t> lets, statements;
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Property)) {
      std::swap(slots_, own);
      read_property({child});
      std::swap(slots_, own);
      continue;
    }
    const std::uint32_t index = statement(child, false);
    if (index == kNothing) continue;
    statements.push_back(index);
    if (child.is(SyntaxKind::Let)) lets.push_back(index);
  }
  // The properties are needed before the statements, and may use the lets before them.
  std::swap(slots_, own);
  const std::size_t mark = pending_.size();
  const auto push = [&](const std::vector<std::uint32_t>& list) {
    pending_.push_back(static_cast<std::uint32_t>(list.size()));
    pending_.insert(pending_.end(), list.begin(), list.end());
  };
  push(lets);
  const std::size_t size_at = pending_.size();
  pending_.push_back(0);
  push_properties(0);
  pending_[size_at] = static_cast<std::uint32_t>((pending_.size() - size_at - 1) / 2);
  push(statements);
  return add_statement(Action::Group, node.node, mark, kind.id);
}

std::uint32_t Resolver::instance_of(std::uint32_t module, std::uint32_t def, ast::Object node) {
  const Module& owner = program_.module(module);
  const std::vector<Parameter>& parameters = owner.defs[def].parameters;
  slots_.reset(node.kind());
  for (const Parameter& parameter : parameters) slots_.add(parameter.name, nullptr);
  for (const Property& property : kind_info(ObjectKind::Group).properties) {
    // A parameter named `material` takes the place of the group's.
    const bool is_taken = slots_.index_of(property.name) < parameters.size();
    slots_.add(is_taken ? std::string_view() : property.name, &property);
  }
  read_properties(node);
  bool is_complete = true;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (slots_.given[i].is_written || parameters[i].has_default) continue;
    is_complete = false;
    if (node.is_broken()) continue;
    sink_.report(diag::missing, node.kind_location(), node.kind(), parameters[i].name)
        .label(ast::Node(owner.tree, parameters[i].node).head_location(), "declared here");
  }
  if (!is_complete) return kNothing;

  const std::size_t mark = pending_.size();
  pending_.insert(pending_.end(), {module, def, 0});
  push_properties(parameters.size());
  pending_[mark + 2] = static_cast<std::uint32_t>((pending_.size() - mark - 3) / 2);
  for (std::size_t i = 0; i < parameters.size(); ++i) pending_.push_back(slots_.given[i].value);
  return add_statement(Action::Instance, node.node, mark, ObjectKind::Group);
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
