#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/ast/statements.hpp"
#include "lang/object/value.hpp"
#include "lang/resolve/lookup.hpp"
#include "lang/resolve/path.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

constexpr double kPi = 3.141592653589793;

bool reads_words(const Property* property) {
  return property != nullptr &&
         (property->type == Type::Word || property->type == Type::Focus || property->reads_none);
}

}  // namespace

/// `property`: the one whose value this is, which may accept a word.
std::uint32_t Resolver::expression(ast::Node node, const Property* property) {
  sink_.stop_if_requested();
  switch (node.kind()) {
    case SyntaxKind::Number: return number(node);
    case SyntaxKind::String: return string(node);
    case SyntaxKind::Color: return code_.add_constant(node, decode_hex_color(node.text()));
    case SyntaxKind::True: return code_.add_constant(node, true);
    case SyntaxKind::False: return code_.add_constant(node, false);
    case SyntaxKind::Group: {
      const auto inside = node.child(0);
      const std::uint32_t value = inside ? expression(*inside, property) : code_.add_broken(node);
      record_rest(node, inside);  // of an incomplete point
      return value;
    }
    case SyntaxKind::Triple: return operands_of(node, Op::Triple);
    case SyntaxKind::Interval: return operands_of(node, Op::Interval);
    case SyntaxKind::Sum: return operands_of(node, Op::Sum);
    case SyntaxKind::Product: return operands_of(node, Op::Product);
    case SyntaxKind::Power: return operands_of(node, Op::Power);
    case SyntaxKind::Negative: return operands_of(node, Op::Negative);
    case SyntaxKind::Not: return operands_of(node, Op::Not);
    case SyntaxKind::Or: return operands_of(node, Op::Or);
    case SyntaxKind::And: return operands_of(node, Op::And);
    case SyntaxKind::Comparison: return operands_of(node, Op::Comparison);
    case SyntaxKind::List: return operands_of(node, Op::List);
    case SyntaxKind::Comprehension: return comprehension(node);
    case SyntaxKind::Conditional: return conditional(node, property);
    case SyntaxKind::LetIn: return let_in(node, property);
    case SyntaxKind::Postfix: return postfix(node);
    case SyntaxKind::Reference: return reference(node, property);
    case SyntaxKind::Call: return call({node});
    default: return broken_expression(node);
  }
}

std::uint32_t Resolver::operands_of(ast::Node node, Op op) {
  const std::size_t mark = code_.mark();
  for (const ast::Node child : node.children()) {
    const std::uint32_t operand = expression(child);
    code_.code().expressions[operand].before = child.op();
    code_.push(operand);
  }
  return code_.add_with(op, node, mark);
}

/// A node that is no expression. Its children may be.
std::uint32_t Resolver::broken_expression(ast::Node node) {
  if (!is_recording()) return operands_of(node, Op::Broken);
  record_skipped(node);
  return code_.add_broken(node);
}

std::uint32_t Resolver::string(ast::Node node) {
  Value text = evaluate_string(node, sink_);
  const auto* value = get_if<std::string>(&text);
  const bool is_good = value == nullptr ||
                       check_string_size(value->size(), modules_.limits(), node.location(), sink_);
  return is_good ? code_.add_constant(node, std::move(text)) : code_.add_broken(node);
}

std::uint32_t Resolver::number(ast::Node node) {
  if (is_recording()) return code_.add_number(node, {});  // names need no values
  const Value value = evaluate_number(node, sink_);
  const auto* scalar = get_if<Scalar>(&value);
  return scalar == nullptr ? code_.add_constant(node, value) : code_.add_number(node, *scalar);
}

std::uint32_t Resolver::conditional(ast::Node node, const Property* property) {
  // Condition, value, condition, value, …; the last value has no condition.
  const std::size_t mark = code_.mark();
  const ast::Children children = node.children();
  for (auto child = children.begin(); child != children.end();) {
    const ast::Node part = *child;
    ++child;
    const bool is_value = (code_.mark() - mark) % 2 == 1 || child == children.end();
    code_.push(expression(part, is_value ? property : nullptr));
  }
  return code_.add_with(Op::Conditional, node, mark);
}

std::uint32_t Resolver::let_in(ast::Node node, const Property* property) {
  // If the value is still missing, the names are visible where it will be.
  const Block scope(*this, node.is_broken() ? scope_end_ : node.span().end);
  const std::size_t mark = code_.mark(), first_slot = code_.reserve();
  std::uint32_t result = kNothing;
  for (const ast::Node part : node.children()) {
    if (part.is(SyntaxKind::Binding)) {
      const auto value = ast::expression_of(part);
      record_rest(part, value);
      const std::string_view declaring = std::exchange(declaring_, ast::declared_name(part));
      const std::uint32_t operand = value ? expression(*value) : code_.add_broken(part);
      declaring_ = declaring;
      const std::uint32_t slot = declare_let(part);  // one after the other
      if (code_.mark() == first_slot + 1) code_[first_slot] = slot;
      code_.push(operand);
    } else {
      result = expression(part, property);
    }
  }
  code_.push(result != kNothing ? result : code_.add_broken(node));
  return code_.add_with(Op::LetIn, node, mark);
}

std::uint32_t Resolver::comprehension(ast::Node node) {
  // Clauses come first: a clause sees the names of those before it, the value all names.
  const Block scope(*this, node.span().end);
  const std::size_t mark = code_.mark();
  code_.push(kNothing);
  for (const ast::Node part : node.children()) {
    if (part.is(SyntaxKind::ForClause)) {
      code_.push(for_clause(part, node.span()));
    } else if (part.is(SyntaxKind::IfClause)) {
      code_.push(operands_of(part, Op::IfClause));
    } else if (part.index() != node.index() + 1) {
      code_.push(broken_expression(part));
    }
  }
  const auto value = node.child(0);
  const std::uint32_t element = value ? expression(*value) : code_.add_broken(node);
  code_[mark] = element;
  return code_.add_with(Op::Comprehension, node, mark);
}

std::uint32_t Resolver::for_clause(ast::Node node, Span scope) {
  const auto list = node.child(1);
  if (!list) return broken_expression(node);
  const std::uint32_t values = expression(*list);
  const std::size_t mark = code_.mark();
  pattern(node, scope);
  code_.push(values);
  return code_.add_with(Op::ForClause, node, mark);
}

std::uint32_t Resolver::postfix(ast::Node node) {
  std::uint32_t value = kNothing;
  for (const ast::Node part : node.children()) {
    if (value == kNothing) {
      value = expression(part);
    } else if (part.is(SyntaxKind::Member)) {
      const auto names = split_path(part.text());
      value = names.empty() ? code_.add_broken(part) : code_.add_member(part, value, names[0]);
    } else if (part.is(SyntaxKind::Index)) {
      const auto position = part.child(0);
      const std::uint32_t index = position ? expression(*position) : code_.add_broken(part);
      const std::size_t mark = code_.mark();
      code_.push({value, index});
      value = code_.add_with(Op::Index, part, mark);
    } else if (is_recording()) {
      record_skipped(part);
    } else {
      return code_.add_broken(part);
    }
  }
  return value == kNothing ? code_.add_broken(node) : value;
}

// Names of values

std::uint32_t Resolver::reference(ast::Node node, const Property* property) {
  const std::string_view path = node.text();
  const bool is_path = path.find('.') != std::string_view::npos;
  if (!is_path && reads_words(property)) {
    if (const std::uint32_t value = word(node, *property); value != kNothing) return value;
  }
  std::vector<std::string_view> split;
  if (is_path) split = split_path(path);
  const auto names = is_path ? std::span<const std::string_view>(split) : std::span(&path, 1);

  std::uint32_t value = kNothing;
  std::size_t used = 1;
  if (const auto local = scopes_.find(names[0])) {
    if (is_recording()) recorder_->use_local(names[0], *local);
    value = local_value(node, scopes_[*local]);
  } else if (const auto own = find_declaration(module_, NameSpace::Values, names[0])) {
    if (is_recording()) recorder_->use_own(names[0], own->node);
    uses_.globals.push_back(own->index);
    value = global_value(node, index_, own->index);
  } else if (const Import* import = find_in(module_.imports, names[0])) {
    value = imported_value(node, *import, names);
    used = names.size() == 1 ? 1 : 2;
  } else {
    value = builtin_value(node, names[0]);
  }
  if (code_.code().expressions[value].op == Op::Broken) return value;
  for (; used < names.size(); ++used) value = code_.add_member(node, value, names[used]);
  return value;
}

std::uint32_t Resolver::local_value(ast::Node node, const Scopes::Local& local) {
  const std::uint32_t outwards = scopes_.frame() - local.frame;
  if (outwards == 0) return code_.add(Op::Local, node, local.slot);
  use_outer({.frame = local.frame, .slot = local.slot});
  return code_.add(Op::Outer, node, local.slot, 0, static_cast<std::uint8_t>(outwards));
}

/// Whether the name is that of a variable or an import, not of a built-in value.
bool Resolver::is_declared(std::string_view name) {
  return scopes_.find(name) || find_declaration(module_, NameSpace::Values, name).has_value() ||
         find_in(module_.imports, name) != nullptr;
}

/// The node as a word, or kNothing if the property does not accept this word. Where values are
/// accepted, too, a variable wins over the name of a sphere.
std::uint32_t Resolver::word(ast::Node node, const Property& property) {
  const std::string_view text = node.text();
  const bool is_none = property.reads_none && text == "none";
  const bool is_name =
      property.type == Type::Word || (property.type == Type::Focus && !is_declared(text));
  if (!is_none && !is_name) return kNothing;
  if (is_recording()) recorder_->use_word(text, property);
  return is_none ? code_.add_constant(node, None{})
                 : code_.add_constant(node, Word{std::string(text)});
}

std::uint32_t Resolver::global_value(ast::Node node, std::uint32_t module, std::uint32_t global) {
  const std::size_t mark = code_.mark();
  code_.push({module, global});
  return code_.add_with(Op::Global, node, mark);
}

std::uint32_t Resolver::imported_value(ast::Node node, const Import& import,
                                       std::span<const std::string_view> names) {
  const auto found = imported_declaration(import, NameSpace::Values, names);
  if (!found) {
    const bool is_loaded = import.module != kNothing;  // if not, that is reported at the import
    if (is_loaded && !is_recording()) unknown_.report_imported_value(node, names, import.module);
    return code_.add_broken(node);
  }
  const Module& module = modules_.module_at(import.module);
  uses_.time = uses_.time || module.globals[found->index].uses_time;
  return global_value(node, import.module, found->index);
}

std::uint32_t Resolver::builtin_value(ast::Node node, std::string_view name) {
  const auto color = find_named_color(name);
  const bool is_time = name == "time";
  if (!color && name != "pi" && !is_time) {
    if (is_recording()) {
      recorder_->use_unknown(name, NameSpace::Values);
    } else {
      unknown_.report_value(node, name, {.declaring = declaring_, .no_color = no_color_});
    }
    return code_.add_broken(node);
  }
  if (is_recording()) recorder_->use_builtin(name, SymbolKind::BuiltinValue);
  if (color) return code_.add_constant(node, *color);
  if (!is_time) return code_.add_number(node, {.value = kPi});
  uses_.time = true;
  return code_.add(Op::Time, node);
}

}  // namespace sdlc::lang
