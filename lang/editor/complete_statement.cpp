#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/editor/callee.hpp"
#include "lang/editor/completion_builder.hpp"
#include "lang/editor/snippets.hpp"
#include "lang/schema/find_kind.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

using Role = OpenBracket::Role;

/// The ranks of statements; properties that are missing come before all of them.
enum Fit : int { kRequired, kOptional, kContinuation, kStatement, kLateProperty, kExisting };
enum Distance : int {
  kSphere,
  kOwnDef,
  kImportedDef,
  kMissingSetting,
  kKeyword = 20,
  kGroup = 23,  // after let, for, if
  kSetting = 60,
  kModule,
  kTemplate,
};

/// What the block at the cursor accepts.
struct Accepted {
  BlockKind kind = {};  ///< whose properties
  bool has_properties = false;
  bool has_statements = false;
  bool is_top = false;
};

Accepted accepted_at(const CompletionBuilder& builder) {
  const OpenBracket& block = builder.place().inner();
  if (block.role == Role::File) return {.has_statements = true, .is_top = true};
  const std::string_view head = builder.text().substr(block.head.begin, block.head.size());
  if (head == "for" || head == "if" || head == "else" || head == "def") {
    return {.has_statements = true};
  }
  const BlockKind kind = find_block_kind(builder.view(), builder.file(), head);
  const bool is_group = kind.kind != nullptr && kind.kind->id == ObjectKind::Group;
  return {.kind = kind, .has_properties = true, .has_statements = is_group};
}

void add_properties(CompletionBuilder& builder, const BlockKind& kind, bool are_late) {
  const OpenBracket& block = builder.place().inner();
  std::vector<std::string_view> given = labels_after(builder.place(), builder.text());
  given.insert(given.end(), block.labels.begin(), block.labels.end());
  const bool has_colon = builder.is_followed_by(':');
  int row = 0;
  for (const BlockProperty& property : properties_of(builder.view(), kind)) {
    ++row;
    if (std::ranges::find(given, property.name) != given.end()) continue;
    const bool is_required = property.property != nullptr
                                 ? property.property->presence == Presence::Required
                                 : !has_default(builder.view(), property.parameter);
    const int fit = are_late ? kLateProperty : is_required ? kRequired : kOptional;
    builder.add(property.property != nullptr
                    ? property_item(*property.property, false, has_colon)
                    : parameter_item(builder.view(), property.parameter, false, has_colon),
                {fit, row});
  }
}

/// The number of objects of a kind at the top level.
std::size_t count_objects(const SyntaxTree& tree, std::string_view kind, Span except) {
  std::size_t count = 0;
  for (const ast::Node child : ast::Node(tree, 0).children()) {
    const bool is_kind = child.is(SyntaxKind::Object) && child.head() == kind;
    if (is_kind && child.span().begin != except.begin) ++count;
  }
  return count;
}

CompletionRank rank_of(const CompletionBuilder& builder, const Kind& kind) {
  if (kind.id == ObjectKind::Sphere) return {kStatement, kSphere};
  if (kind.id == ObjectKind::Group) return {kStatement, kGroup};
  const std::size_t count =
      count_objects(builder.view().tree(builder.file()), kind.name, builder.place().word);
  if (count > 0 && kind.is_unique) return {kExisting, kSetting};
  // A film is rare.
  const bool is_wanted = count == 0 && kind.id != ObjectKind::Animation;
  return {kStatement, is_wanted ? kMissingSetting + static_cast<int>(kind.id) : kSetting};
}

void add_kinds(CompletionBuilder& builder, bool is_top) {
  const bool has_block = builder.is_followed_by('{');
  for (const Kind& kind : all_kinds()) {
    if (kind.is_setting && !is_top) continue;
    CompletionItem item{.label = std::string(kind.name),
                        .kind = CompletionKind::ObjectKind,
                        .documentation = std::string(kind.doc)};
    if (!has_block) {
      item.text += item.label + " ";
      item.snippet = snippet_of(kind);
    }
    builder.add(std::move(item), rank_of(builder, kind));
  }
}

void add_defs(CompletionBuilder& builder) {
  SceneView& view = builder.view();
  const bool has_block = builder.is_followed_by('{');
  const SymbolTable& table = view.table(builder.file());
  for (const Symbol* def : table.visible(builder.place().offset, NameSpace::Kinds)) {
    if (!builder.accepts(def->name)) continue;
    builder.add(def_item(view, table.id_of(*def), std::string(def->name), has_block),
                {kStatement, kOwnDef});
  }
  for (const auto& [name, import] : view.module(builder.file()).imports) {
    if (import.module >= view.file_count()) continue;
    bool has_defs = false;
    for (const Definition& def : view.module(import.module).defs) {
      has_defs = true;
      std::string path = std::string(name) + "." + std::string(def.name);
      if (def.name.empty() || !builder.accepts(path)) continue;
      builder.add(def_item(view, {import.module, def.node}, std::move(path), has_block),
                  {kStatement, kImportedDef});
    }
    if (!has_defs) continue;
    builder.add({.label = std::string(name),
                 .kind = CompletionKind::Module,
                 .detail = view.file(import.module).name()},
                {kStatement, kModule});
  }
}

void add_templates(CompletionBuilder& builder, bool is_top) {
  int row = 0;
  for (const Snippet& snippet : all_snippets()) {
    ++row;
    if (snippet.place == SnippetPlace::EmptyFile) continue;
    if (snippet.place == SnippetPlace::TopLevel && !is_top) continue;
    CompletionItem item{
        .label = std::string(snippet.name),
        .kind = snippet.is_keyword ? CompletionKind::Keyword : CompletionKind::Snippet,
        .documentation = std::string(snippet.doc),
        .snippet = std::string(snippet.body)};
    if (snippet.is_keyword) item.text = item.label + " ";
    builder.add(std::move(item), {kStatement, (snippet.is_keyword ? kKeyword : kTemplate) + row});
  }
}

/// `else` after the block of an `if`; `and` and `or` after a value.
void add_continuations(CompletionBuilder& builder) {
  const OpenBracket& f = builder.place().inner();
  const bool is_after_if =
      f.step == PlaceStep::Start && f.previous == "if" && builder.place().before == "}";
  if (is_after_if) {
    builder.add({.label = "else",
                 .kind = CompletionKind::Keyword,
                 .text = "else ",
                 .snippet = "else {\n  $0\n}"},
                {kContinuation, 0});
  }
  const bool is_after_value =
      f.step == PlaceStep::AfterOperand && !builder.place().is_first_of_line;
  // `let a = 1 and` makes no sense.
  const char last = builder.place().before.empty() ? ' ' : builder.place().before.front();
  if (is_digit(last) || last == '"' || last == '#') return;
  const bool is_block = f.role == Role::File || f.has_statements;
  if (is_after_value && (is_block || !builder.prefix().empty())) complete_operator(builder);
}

bool has_version(const SyntaxTree& tree) {
  return ast::Node(tree, 0).first(SyntaxKind::Version).has_value();
}

void add_version(CompletionBuilder& builder) {
  builder.add({.label = "scene 1",
               .kind = CompletionKind::Keyword,
               .documentation = "The version of the language. Every scene begins with it.",
               .text = "scene 1\n"},
              {kRequired, 0});
  const Snippet& snippet = all_snippets().front();
  builder.add({.label = std::string(snippet.name),
               .kind = CompletionKind::Snippet,
               .documentation = std::string(snippet.doc),
               .snippet = std::string(snippet.body)},
              {kRequired, 1});
}

}  // namespace

void complete_statement(CompletionBuilder& builder) {
  const OpenBracket& block = builder.place().inner();
  const Accepted accepted = accepted_at(builder);
  if (accepted.is_top && !has_version(builder.view().tree(builder.file()))) {
    add_version(builder);
    if (!block.has_statements) return;
  }
  if (accepted.has_properties) {
    add_properties(builder, accepted.kind, accepted.has_statements && block.has_statements);
  }
  add_continuations(builder);
  if (!accepted.has_statements) return;
  add_kinds(builder, accepted.is_top);
  add_defs(builder);
  add_templates(builder, accepted.is_top);
}

void complete_operator(CompletionBuilder& builder) {
  const OpenBracket& f = builder.place().inner();
  const auto add = [&](std::string_view word, int distance) {
    builder.add({.label = std::string(word),
                 .kind = CompletionKind::Keyword,
                 .text = std::string(word) + " "},
                {kContinuation, distance});
  };
  if (f.word == "else" && f.path.size() == 0) return add("if", 0);
  const bool is_open = !f.conditionals.empty();
  if (is_open && f.conditionals.back() == ConditionalPart::Condition) add("then", 0);
  if (is_open && f.conditionals.back() == ConditionalPart::Then) add("else", 0);
  const bool may_have_clause = f.role == OpenBracket::Role::List && f.commas == 0 && !is_open;
  if (may_have_clause) add("for", 3);
  if (may_have_clause && !f.word.empty()) add("if", 0);
  add("and", 1);
  add("or", 2);
}

}  // namespace sdlc::lang
