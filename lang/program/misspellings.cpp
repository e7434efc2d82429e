#include "lang/program/misspellings.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/program/path.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFF;

/// Values, functions and kinds have name spaces of their own; labels name the parameters of one
/// function or kind.
enum class Space : std::uint8_t { Value, Function, Kind, Label };

struct Declaration {
  Location where;
  std::string_view name;
  std::uint32_t uses = 0;
};

struct UnknownUse {
  Location where;
  std::string_view name;
  std::vector<std::uint32_t> visible;  ///< declarations that it could mean
};

using Names = std::unordered_map<std::string_view, std::uint32_t>;

bool is_known_value(std::string_view name) {
  return find_named_color(name).has_value() || name == "pi" || name == "time";
}
bool is_known_function(std::string_view name) {
  return find_constructor(name) != nullptr || find_builtin(name) != nullptr;
}
const Kind* find_known_kind(std::string_view name) {
  for (const Kind& kind : all_kinds()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}
const Property* find_property(const Kind* kind, std::string_view name) {
  if (kind == nullptr) return nullptr;
  for (const Property& property : kind->properties) {
    if (property.name == name) return &property;
  }
  return nullptr;
}

/// Goes through a file as the resolver does, counting what uses each declaration.
class Census {
 public:
  explicit Census(const SyntaxTree& tree) : tree_(tree) {}

  void run() {
    const ast::Node file(tree_, 0);
    for (const ast::Node statement : file.children()) declare_top(statement);
    for (const ast::Node statement : file.children()) visit(statement);
    if (has_too_many_) unknown.clear();
  }

  std::vector<Declaration> declarations;
  std::vector<UnknownUse> unknown;

 private:
  // Declarations

  std::uint32_t declare(Location where, std::string_view name) {
    declarations.push_back({.where = where, .name = name});
    return static_cast<std::uint32_t>(declarations.size() - 1);
  }

  void declare_top(ast::Node statement) {
    const auto name = statement.first(SyntaxKind::Name);
    if (!name || name->span().size() == 0) return;
    switch (statement.kind()) {
      case SyntaxKind::Let:
      case SyntaxKind::Param:
      case SyntaxKind::Import: declare_in(values_, *name); break;
      case SyntaxKind::Fn: declare_parameters(statement, declare_in(functions_, *name)); break;
      case SyntaxKind::Def: declare_parameters(statement, declare_in(kinds_, *name)); break;
      default: break;
    }
  }

  std::uint32_t declare_in(Names& names, ast::Node name) {
    const std::uint32_t index = declare(name.location(), name.text());
    names.try_emplace(name.text(), index);
    return index;
  }

  void declare_parameters(ast::Node statement, std::uint32_t owner) {
    for (const ast::Node child : statement.children()) {
      if (!child.is(SyntaxKind::Parameter)) continue;
      parameters_[owner].push_back(declare(child.head_location(), child.head()));
    }
    owners_[statement.index()] = owner;
  }

  void declare_local(ast::Node statement) {
    const auto name = statement.first(SyntaxKind::Name);
    if (name) locals_.push_back(declare(name->location(), name->text()));
  }

  // Uses

  void use(Space space, std::string_view name, std::uint32_t begin) {
    constexpr std::size_t kMostLocals = 1000;
    if (space == Space::Value) {
      has_too_many_ = has_too_many_ || locals_.size() > kMostLocals;
      if (has_too_many_) return;
      for (auto local = locals_.rbegin(); local != locals_.rend(); ++local) {
        if (declarations[*local].name == name) return count(*local);
      }
    }
    Names& names = names_of(space);
    if (const auto found = names.find(name); found != names.end()) return count(found->second);
    const bool is_known = space == Space::Value      ? is_known_value(name)
                          : space == Space::Function ? is_known_function(name)
                                                     : find_known_kind(name) != nullptr;
    if (is_known || knows_enough(names.size())) return;
    std::vector<std::uint32_t> visible;
    if (space == Space::Value) visible = locals_;
    for (const auto& [other, index] : names) {
      // What a value is made of was not meant to be that value.
      if (declarations[index].where.span != declaring_) visible.push_back(index);
    }
    std::ranges::sort(visible);  // the table has no order
    add_unknown(name, begin, std::move(visible));
  }

  void use_label(std::uint32_t owner, std::string_view label, std::uint32_t begin) {
    constexpr std::size_t kMostParameters = 1000;
    const std::vector<std::uint32_t>& parameters = parameters_[owner];
    has_too_many_ = has_too_many_ || parameters.size() > kMostParameters;
    if (has_too_many_) return;
    for (const std::uint32_t parameter : parameters) {
      if (declarations[parameter].name == label) return count(parameter);
    }
    add_unknown(label, begin, parameters);
  }

  void count(std::uint32_t declaration) { ++declarations[declaration].uses; }

  /// A text of more names than that was not written by hand, and of more mistakes nobody is told.
  bool knows_enough(std::size_t names) const {
    constexpr std::size_t kMostNames = 10'000, kMostUnknown = 500;
    return names > kMostNames || unknown.size() >= kMostUnknown;
  }

  void add_unknown(std::string_view name, std::uint32_t begin, std::vector<std::uint32_t> visible) {
    if (knows_enough(visible.size())) return;
    const auto end = begin + static_cast<std::uint32_t>(name.size());
    unknown.push_back(
        {.where = tree_.location({begin, end}), .name = name, .visible = std::move(visible)});
  }

  Names& names_of(Space space) {
    return space == Space::Value ? values_ : space == Space::Function ? functions_ : kinds_;
  }

  /// The first name of a path; of one with several it is an import's or that of a value.
  void use_path(Space space, std::string_view path, std::uint32_t begin) {
    const auto names = split_path(path);
    if (names.empty()) return;
    use(names.size() > 1 ? Space::Value : space, names[0], begin);
  }

  std::optional<std::uint32_t> find_own(Space space, std::string_view name) {
    const auto found = names_of(space).find(name);
    return found == names_of(space).end() ? std::nullopt : std::optional(found->second);
  }

  // The tree

  void visit(ast::Node node) {
    switch (node.kind()) {
      case SyntaxKind::Reference: return use_path(Space::Value, node.text(), node.span().begin);
      case SyntaxKind::Call: return visit_call(node);
      case SyntaxKind::Object: return visit_object({node});
      case SyntaxKind::Fn:
      case SyntaxKind::Def: return visit_definition(node);
      case SyntaxKind::Block: return visit_block(node);
      case SyntaxKind::For: return visit_for(node);
      case SyntaxKind::Param:
      case SyntaxKind::Let: return visit_value(node);
      default: return visit_children(node);
    }
  }

  void visit_children(ast::Node node) {
    for (const ast::Node child : node.children()) visit(child);
  }

  void visit_value(ast::Node node) {
    const auto name = node.first(SyntaxKind::Name);
    if (name) declaring_ = name->span();
    visit_children(node);
    declaring_ = {};
    if (is_inside_ && node.is(SyntaxKind::Let)) declare_local(node);
  }

  void visit_block(ast::Node node) {
    const std::size_t size = locals_.size();
    const bool was_inside = std::exchange(is_inside_, true);
    visit_children(node);
    is_inside_ = was_inside;
    locals_.resize(size);
  }

  void visit_for(ast::Node node) {
    const std::size_t size = locals_.size();
    for (const ast::Node child : node.children()) {
      if (child.is(SyntaxKind::Block)) declare_local(node);
      visit(child);
    }
    locals_.resize(size);
  }

  void visit_definition(ast::Node node) {
    const auto owner = owners_.find(node.index());
    const std::size_t size = locals_.size();
    std::size_t next = 0;
    for (const ast::Node child : node.children()) {
      visit(child);
      if (!child.is(SyntaxKind::Parameter) || owner == owners_.end()) continue;
      locals_.push_back(parameters_[owner->second][next++]);
    }
    locals_.resize(size);
  }

  void visit_call(ast::Node node) {
    const ast::Call call{node};
    use_path(Space::Function, call.callee(), node.span().begin);
    const auto own = find_own(Space::Function, call.callee());
    for (const ast::Node argument : call.arguments()) {
      if (own && argument.is(SyntaxKind::Argument)) {
        use_label(*own, argument.head(), argument.span().begin);
      }
      visit(argument);
    }
  }

  void visit_object(ast::Object object) {
    use_path(Space::Kind, object.kind(), object.node.span().begin);
    const auto own = find_own(Space::Kind, object.kind());
    const Kind* kind = own ? &kind_info(ObjectKind::Group) : find_known_kind(object.kind());
    const std::size_t size = locals_.size();
    const bool was_inside = std::exchange(is_inside_, true);
    for (const ast::Node child : object.children()) {
      if (child.is(SyntaxKind::Property)) {
        visit_property(child, own, find_property(kind, child.head()));
      } else {
        visit(child);
      }
    }
    is_inside_ = was_inside;
    locals_.resize(size);
  }

  void visit_property(ast::Node node, std::optional<std::uint32_t> owner,
                      const Property* property) {
    if (owner && property == nullptr) use_label(*owner, node.head(), node.span().begin);
    const bool reads_words =
        property != nullptr && (property->type == Type::Word || property->reads_none);
    if (!reads_words) visit_children(node);
  }

  const SyntaxTree& tree_;
  Names values_, functions_, kinds_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>>
      parameters_;                                       ///< of functions, kinds
  std::unordered_map<NodeIndex, std::uint32_t> owners_;  ///< of statements
  std::vector<std::uint32_t> locals_;
  bool has_too_many_ = false;  ///< names in one frame: no one wrote it by hand
  Span declaring_;             ///< the name of the value that is being visited
  bool is_inside_ = false;     ///< of a block, where a let is local
};

/// How often each word stands in a text; `golden_angle` is two words.
class Words {
 public:
  explicit Words(std::string_view text) {
    for_each_word(text, [&](std::string word) { ++counts_[std::move(word)]; });
  }

  /// Whether all words of the name are used in the text besides.
  bool knows(std::string_view name, std::uint32_t own_uses) const {
    bool is_known = true, is_word = false;
    for_each_word(name, [&](const std::string& word) {
      const auto found = counts_.find(word);
      is_word = is_word || word.size() >= kShortest;
      is_known = is_known && found != counts_.end() && found->second > own_uses;
    });
    return is_known && is_word;
  }

 private:
  static constexpr std::size_t kShortest = 3;

  template <typename Function>
  static void for_each_word(std::string_view text, Function function) {
    std::string word;
    for (const char c : text) {
      if (is_ascii_letter(c)) {
        word += to_lower(c);
      } else if (!word.empty()) {
        function(std::exchange(word, {}));
      }
    }
    if (!word.empty()) function(std::move(word));
  }

  std::map<std::string, std::uint32_t> counts_;
};

/// The declaration that the use probably means: unused, and no used one is nearer.
std::uint32_t nearest_declaration(const std::vector<Declaration>& declarations,
                                  const UnknownUse& use) {
  std::vector<std::string_view> names;
  std::vector<std::uint32_t> indices;
  for (const bool is_used : {false, true}) {
    for (const std::uint32_t index : use.visible) {
      if ((declarations[index].uses > 0) != is_used) continue;
      names.push_back(declarations[index].name);
      indices.push_back(index);
    }
  }
  const auto nearest = nearest_name(use.name, names);
  constexpr std::size_t kMostLetters = 2;  // beyond that it is no slip of the pen
  const bool is_near = nearest && nearest->size() <= use.name.size() + kMostLetters &&
                       use.name.size() <= nearest->size() + kMostLetters;
  if (!is_near) return kNone;
  const auto found =
      static_cast<std::size_t>(std::find(names.begin(), names.end(), *nearest) - names.begin());
  return declarations[indices[found]].uses == 0 ? indices[found] : kNone;
}

}  // namespace

Misspellings::Misspellings(const SyntaxTree& tree) {
  Census census(tree);
  census.run();
  std::map<std::pair<std::uint32_t, std::string_view>, std::vector<const UnknownUse*>> groups;
  for (const UnknownUse& use : census.unknown) {
    const std::uint32_t declaration = nearest_declaration(census.declarations, use);
    if (declaration != kNone) groups[{declaration, use.name}].push_back(&use);
  }
  std::optional<Words> words;
  for (const auto& [key, uses] : groups) {
    const Declaration& declaration = census.declarations[key.first];
    if (!words) words.emplace(tree.file().text());
    const bool is_certain =
        uses.size() > 1 || (words->knows(key.second, 1) && !words->knows(declaration.name, 1));
    for (const UnknownUse* use : uses) {
      uses_[use->where.span.begin] = {.declared = declaration.where,
                                      .used = uses.front()->where,
                                      .name = declaration.name,
                                      .meant = key.second,
                                      .is_certain = is_certain};
    }
  }
}

const Misspelling* Misspellings::find(std::uint32_t use) const {
  const auto found = uses_.find(use);
  return found == uses_.end() ? nullptr : &found->second;
}

}  // namespace sdlc::lang
