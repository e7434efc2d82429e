#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/completion_builder.hpp"
#include "lang/editor/snippets.hpp"
#include "lang/schema/property_text.hpp"

namespace sdlc::lang {
namespace {

/// The property type that is written like values of the type; nullopt for the others.
std::optional<Type> written_like(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, Type>, 6> kTypes{{{"vec3", Type::Vec3},
                                                                     {"angle", Type::Angle},
                                                                     {"angles", Type::Angles},
                                                                     {"interval", Type::Interval},
                                                                     {"bool", Type::Bool},
                                                                     {"string", Type::String}}};
  const auto found = std::ranges::find(kTypes, type, [](const auto& pair) { return pair.first; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

/// Whether a value has parts to fill in, or few choices.
bool has_structure(const Property& property) {
  switch (property.type) {
    case Type::Number:
    case Type::WholeNumber:
    case Type::Length:
    case Type::Color:
    case Type::Material: return false;
    case Type::Word: return !property.words.empty();
    default: return true;
  }
}

std::string without_backticks(std::string text) {
  std::erase(text, '`');
  return text;
}

CompletionItem label_item(std::string_view name, bool is_argument, bool has_colon) {
  CompletionItem item{.label = std::string(name), .kind = CompletionKind::Property};
  if (is_argument) item.label += ':';
  item.text = has_colon ? std::string(name) : fmt::format("{}: ", name);
  return item;
}

/// The text of a declaration up to its value or block.
std::string head_of(const SceneView& view, SymbolId id) {
  const ast::Node node(view.tree(id.file), id.index);
  std::uint32_t end = node.span().end;
  if (const auto block = node.first(SyntaxKind::Block)) {
    end = block->span().begin;
  } else if (const auto value = ast::expression_of(node)) {
    end = value->span().begin;
  }
  std::string head(view.file(id.file).text({node.span().begin, end}));
  const std::size_t last = head.find_last_not_of(" \t\r\n=");
  head.resize(last == std::string::npos ? 0 : last + 1);
  return head;
}

/// The required parameters as placeholders, after `prefix`.
std::string parameter_placeholders(const SceneView& view, SymbolId owner, bool with_labels) {
  std::string text;
  int next = 1;
  for (const SymbolId id : parameters_of(view, owner)) {
    if (has_default(view, id)) continue;
    const std::string_view name = view.index().find(id)->name;
    text += fmt::format("{}{}${{{}:{}}}", text.empty() ? "" : ", ",
                        with_labels ? fmt::format("{}: ", name) : "", next++, name);
  }
  return text;
}

}  // namespace

CompletionItem property_item(const Property& property, bool is_argument, bool has_colon) {
  CompletionItem item = label_item(property.name, is_argument, has_colon);
  std::string usual = describe_default(property);
  if (!usual.empty() && usual != "required") usual = "default " + usual;
  item.detail = without_backticks(
      fmt::format("{}{}{}", describe_values(property), usual.empty() ? "" : ", ", usual));
  item.documentation = property.doc;
  if (!has_colon && has_structure(property)) item.snippet = snippet_of(property);
  return item;
}

CompletionItem parameter_item(const SceneView& view, SymbolId parameter, bool is_argument,
                              bool has_colon) {
  const std::string_view name = view.index().find(parameter)->name;
  CompletionItem item = label_item(name, is_argument, has_colon);
  const std::string_view type = type_name_of(view, parameter);
  const ast::Node node(view.tree(parameter.file), parameter.index);
  const auto value = ast::expression_of(node);
  item.detail = fmt::format("{}{}{}", type, type.empty() ? "" : ", ",
                            value ? fmt::format("default {}", value->text()) : "required");
  item.documentation = view.index().documentation(parameter);
  const std::optional<Type> written = written_like(type);
  if (!has_colon && written)
    item.snippet = snippet_of(Property{.name = name, .type = *written, .doc = {}});
  return item;
}

CompletionItem function_item(const SceneView& view, SymbolId function, std::string name,
                             bool has_arguments) {
  CompletionItem item{.label = std::move(name), .kind = CompletionKind::Function};
  item.detail = head_of(view, function);
  item.documentation = view.index().documentation(function);
  if (has_arguments) return item;
  item.text = item.label + "(";
  item.snippet = fmt::format("{}({})", item.label, parameter_placeholders(view, function, false));
  return item;
}

CompletionItem def_item(const SceneView& view, SymbolId def, std::string name, bool has_block) {
  CompletionItem item{.label = std::move(name), .kind = CompletionKind::ObjectKind};
  item.detail = head_of(view, def);
  item.documentation = view.index().documentation(def);
  if (has_block) return item;
  const std::string inside = parameter_placeholders(view, def, true);
  item.text = item.label + " { ";
  item.snippet = fmt::format("{} {{ {} }}", item.label, inside.empty() ? "$0" : inside);
  return item;
}

}  // namespace sdlc::lang
