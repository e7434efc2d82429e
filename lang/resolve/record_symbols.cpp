#include "lang/resolve/record_symbols.hpp"

#include <optional>
#include <utility>

#include "lang/ast/statements.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/declarations.hpp"
#include "lang/resolve/lookup.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/resolve/symbol_recorder.hpp"

namespace sdlc::lang {

SymbolTable record_symbols(Modules& modules, std::uint32_t module, SymbolDetail detail,
                           const StopRequest* stop) {
  DiagnosticSink ignored(stop);
  ignored.set_muted(true);
  SymbolRecorder recorder(modules.module_at(module).tree, module, detail);
  Resolver(modules, module, ignored, &recorder).record_all();
  return recorder.finish();
}

void Resolver::record_all() {
  Code code(module_.tree);
  code_.write_to(code);
  for (const ast::Node node : ast::Node(module_.tree, 0).children()) {
    code.clear();
    uses_.clear();
    switch (node.kind()) {
      case SyntaxKind::Let:
      case SyntaxKind::Param: {
        record_declaration(node);
        Global global{.name = ast::declared_name(node), .node = node.index()};
        resolve_global(global);
        break;
      }
      case SyntaxKind::Fn:
      case SyntaxKind::Def: {
        record_declaration(node);
        Definition definition = read_definition(node, sink_);
        resolve_definition(definition);
        break;
      }
      case SyntaxKind::Import: record_declaration(node); break;
      default: statement(node, true);
    }
  }
  code_.write_to(module_.code);
}

namespace {

bool is_expression(SyntaxKind kind) {
  return kind >= SyntaxKind::Conditional && kind != SyntaxKind::Argument &&
         kind != SyntaxKind::Member && kind != SyntaxKind::Index;
}

}  // namespace

void Resolver::record_declaration(ast::Node statement) {
  const std::string_view name = ast::declared_name(statement);
  if (name.empty()) return;
  const bool is_visible = is_collected(module_, statement);
  const auto end = static_cast<std::uint32_t>(module_.file->text().size());
  recorder_->declare({.kind = *symbol_kind_of(statement.kind()),
                      .is_duplicate = !is_visible,
                      .node = statement.index(),
                      .name = name,
                      .scope = is_visible ? Span{0, end} : Span{}});
}

void Resolver::record_duplicate_parameters(const Definition& definition) {
  auto known = definition.parameters.begin();  // in the order of the text, as the children are
  for (const ast::Node child : ast::Node(module_.tree, definition.node).children()) {
    sink_.stop_if_requested();
    if (!child.is(SyntaxKind::Parameter)) continue;
    if (known != definition.parameters.end() && known->node == child.index()) {
      ++known;
      continue;
    }
    recorder_->declare({.kind = SymbolKind::Parameter,
                        .is_duplicate = true,
                        .node = child.index(),
                        .owner = definition.node,
                        .name = child.head()});
    record_skipped_children(child);
  }
}

void Resolver::record_misplaced_declaration(ast::Node node) {
  if (!is_recording()) return;
  if (node.is(SyntaxKind::Param)) {
    if (const auto type = node.first(SyntaxKind::TypeName)) resolve_type(*type);
    let_statement(node);
    return;
  }
  record_declaration(node);
}

void Resolver::record_error(ast::Node error, bool is_top) {
  if (!is_recording()) return;
  std::optional<Block> block;
  if (is_top) block.emplace(*this, error.span().end);
  record_skipped_children(error);
}

void Resolver::record_broken_for(ast::Node node) {
  if (!is_recording()) return;
  const Block scope(*this, node.span().end);
  bool is_declared = false;
  const auto declare = [&](std::uint32_t begin) {
    if (std::exchange(is_declared, true)) return;
    const std::size_t mark = code_.mark();
    pattern(node, {begin, scope_end_});
    code_.take(mark);
  };
  for (const ast::Node child : node.children()) {
    if (child.is(SyntaxKind::Block)) declare(child.span().begin);
    if (!child.is(SyntaxKind::Pattern)) record_skipped(child);
  }
  declare(node.span().end);
}

void Resolver::record_skipped(ast::Node node) {
  if (!is_recording()) return;
  if (is_expression(node.kind())) {
    expression(node);
    return;
  }
  if (ast::is_statement(node.kind())) {
    statement(node, false);
    return;
  }
  switch (node.kind()) {
    case SyntaxKind::Block: {
      const std::size_t mark = code_.mark();
      block(node);
      code_.take(mark);
      return;
    }
    case SyntaxKind::TypeName: resolve_type(node); return;
    case SyntaxKind::Name: recorder_->use_unknown(node.text(), NameSpace::Labels); return;
    case SyntaxKind::Parameter:
    case SyntaxKind::Argument: recorder_->use_unknown(node.head(), NameSpace::Labels); break;
    default: break;
  }
  record_skipped_children(node);
}

void Resolver::record_rest(ast::Node node, std::optional<ast::Node> value) {
  if (!is_recording()) return;
  for (const ast::Node child : node.children()) {
    const bool is_value = value && value->index() == child.index();
    const bool is_rest = child.is(SyntaxKind::Error) || is_expression(child.kind());
    if (is_rest && !is_value) record_skipped(child);
  }
}

void Resolver::record_skipped_children(ast::Node node) {
  if (!is_recording()) return;
  for (const ast::Node child : node.children()) record_skipped(child);
}

NodeIndex Resolver::hidden_by(std::string_view name) const {
  if (const auto slot = scopes_.find(name)) return recorder_->local(*slot);
  if (const auto own = find_declaration(module_, NameSpace::Values, name)) return own->node;
  const Import* import = find_in(module_.imports, name);
  return import != nullptr ? import->node : kNothing;
}

NodeIndex Resolver::hidden_definition(NameSpace space, std::string_view name) const {
  if (const Definition* local = find_local(space, name)) return local->node;
  const auto own = find_declaration(module_, space, name);
  return own ? own->node : kNothing;
}

void Resolver::record_path(std::span<const std::string_view> names) {
  if (!is_recording() || names.empty()) return;
  const NodeIndex value = hidden_by(names[0]);
  if (value == kNothing) {
    recorder_->use_unknown(names[0], NameSpace::Values);
  } else {
    recorder_->use_own(names[0], value);
  }
  for (const std::string_view member : names.subspan(1)) {
    recorder_->use_unknown(member, NameSpace::Members);
  }
}

void Resolver::record_label(ast::Labeled property, std::size_t slot) {
  if (slot == slots_.names.size()) {
    recorder_->use_unknown(property.label(), NameSpace::Labels, slots_.def);
  } else if (const Property* known = slots_.names[slot].property) {
    recorder_->use_builtin(property.label(), SymbolKind::Property, known);
  } else {
    recorder_->use(property.label(), {slots_.def.file, slots_.names[slot].parameter});
  }
}

/// Properties in the statement are not those of the object, so the slots are put aside.
void Resolver::record_misplaced(ast::Node statement) {
  PropertySlots own = std::exchange(slots_, {});
  record_skipped(statement);
  slots_ = std::move(own);
}

}  // namespace sdlc::lang
