#include "lang/eval/eval.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/eval/evaluator.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

/// Kinds that the language has and this evaluator does not yet.
constexpr auto kLaterKinds = std::to_array<std::string_view>({"group", "animation"});

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

DeclaredNames find_later_names(ast::Node file) {
  DeclaredNames names;
  for (const ast::Node statement : file.children()) {
    if (statement.is(SyntaxKind::Import)) names.values.insert(declared_name(statement));
    if (statement.is(SyntaxKind::Def)) names.kinds.insert(declared_name(statement));
  }
  return names;
}

const Kind* find_kind(std::string_view name) noexcept {
  const auto kinds = all_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == kinds.end() ? nullptr : &*found;
}

/// Properties of one kind, by their index in its table.
using PropertySet = std::bitset<kMaxProperties>;

class FileEvaluator {
 public:
  FileEvaluator(const SyntaxTree& tree, ObjectSink& objects, DiagnosticSink& sink)
      : file_(tree, 0),
        objects_(objects),
        sink_(sink),
        names_(find_later_names(file_)),
        declarations_(file_, sink),
        expressions_(names_, declarations_, scopes_, sink) {}

  void run() {
    evaluate_declarations();
    for (const ast::Node statement : file_.children()) evaluate_statement(statement, true);
  }

 private:
  void evaluate_declarations() {
    // What depends on itself has been reported; to whoever uses it, it is a value that has failed.
    for (const ast::Node statement : file_.children()) {
      const bool is_value = statement.is(SyntaxKind::Let) || statement.is(SyntaxKind::Param);
      if (is_value) scopes_.declare_at_top(declared_name(statement), Failed{});
    }
    for (const ast::Node statement : declarations_.values()) {
      scopes_.declare_at_top(declared_name(statement), value_of(statement));
    }
  }

  /// The value of a let or param statement.
  Computed value_of(ast::Node statement) {
    const auto type = statement.first(SyntaxKind::TypeName);
    for (const ast::Node child : statement.children()) {
      if (child.is(SyntaxKind::Name) || child.is(SyntaxKind::TypeName)) continue;
      return expressions_.check_declared_type(declared_name(statement), type,
                                              expressions_.evaluate(child), child.location());
    }
    return Failed{};
  }

  void evaluate_statement(ast::Node statement, bool is_top) {
    switch (statement.kind()) {
      case SyntaxKind::Object: return evaluate_object({statement}, is_top);
      case SyntaxKind::Property: {
        const ast::Labeled property{statement};
        sink_.report(diag::property_outside, property.label_location(), property.label());
        return;
      }
      case SyntaxKind::Let:
        if (!is_top) scopes_.declare(declared_name(statement), value_of(statement));
        return;
      case SyntaxKind::Param:
      case SyntaxKind::Fn:
        if (!is_top)
          report_top_level_only(word_location(statement), statement_word(statement.kind()));
        return;
      case SyntaxKind::If: return evaluate_if(statement);
      case SyntaxKind::For: return evaluate_for(statement);
      case SyntaxKind::Assert: return evaluate_assert(statement);
      case SyntaxKind::Error:
      case SyntaxKind::Version: return;
      default:
        sink_.report(diag::not_supported, word_location(statement),
                     fmt::format("`{}` is", statement_word(statement.kind())));
    }
  }

  void report_top_level_only(Location where, std::string_view word) {
    sink_.report(diag::top_level_only, where, word);
  }

  void evaluate_block(ast::Node block) {
    const BlockScope scope(scopes_);
    for (const ast::Node statement : block.children()) evaluate_statement(statement, false);
  }

  /// Conditions and blocks take turns; a last block without a condition is the one behind `else`.
  void evaluate_if(ast::Node statement) {
    bool holds = true;
    for (const ast::Node child : statement.children()) {
      if (child.is(SyntaxKind::Block)) {
        if (holds) return evaluate_block(child);
        holds = true;  // where no condition follows
      } else {
        const std::optional<bool> condition = expressions_.evaluate_condition(child, "if");
        if (!condition) return;
        holds = *condition;
      }
    }
  }

  void evaluate_for(ast::Node statement) {
    const auto expression = statement.child(1), block = statement.child(2);
    if (!expression || !block || !block->is(SyntaxKind::Block)) return;
    const Computed value = expressions_.evaluate(*expression);
    if (has_failed(value)) return;
    const auto* list = std::get_if<ListValue>(&value);
    if (list == nullptr) {
      auto report = sink_.report(diag::not_a_list, expression->location(), describe(value));
      const auto* bounds = std::get_if<Bounds>(&value);
      if (bounds != nullptr) {
        report.help("`range` excludes its end")
            .fix(expression->location(),
                 fmt::format("range({}, {})", to_text(bounds->from), to_text(bounds->to + 1)));
      }
      return;
    }
    // What is wrong in one turn is most likely wrong in all: it is told once.
    const std::size_t errors = sink_.error_count();
    for (std::size_t i = 0; i < list->size() && sink_.error_count() == errors; ++i) {
      if (!expressions_.take_step(expression->location())) return;
      const BlockScope scope(scopes_);
      scopes_.declare(declared_name(statement), (*list)[i]);
      evaluate_block(*block);
    }
  }

  void evaluate_assert(ast::Node statement) {
    const auto condition = statement.child(0), message = statement.child(1);
    if (!condition || !message) return;
    const std::optional<bool> holds = expressions_.evaluate_condition(*condition, "assert");
    if (!holds || *holds) return;
    const Computed text = expressions_.evaluate(*message);
    if (const auto* words = std::get_if<std::string>(&text)) {
      sink_.report(diag::failed_assertion, condition->location(), *words);
    } else if (!has_failed(text)) {
      sink_.report(diag::wrong_argument, message->location(), "assert", "a string", describe(text));
    }
  }

  void evaluate_object(ast::Object node, bool is_top) {
    const Kind* kind = find_kind(node.kind());
    if (kind == nullptr) return report_unknown_kind(node);
    if (!is_top && kind->id != ObjectKind::Sphere) {
      return report_top_level_only(node.kind_location(), kind->name);
    }

    Object object;
    object.kind = kind;
    object.where = node.kind_location();
    if (const auto name = node.name()) {
      object.name = name->text();
      check_name(*kind, *name);
    }
    if (kind->is_unique) check_unique(*kind, node);

    PropertySet guessed;
    for (const ast::Node statement : node.children()) {
      if (statement.is(SyntaxKind::Property)) {
        evaluate_property(object, {statement}, guessed);
      } else if (!statement.is(SyntaxKind::Name) && !statement.is(SyntaxKind::Error)) {
        report_misplaced(*kind, statement);
      }
    }
    // A property that could not be read may be the one that is missing.
    if (!node.is_broken()) check_required(object, sink_);
    objects_.add(object);
  }

  void evaluate_property(Object& object, ast::Labeled property, PropertySet& guessed) {
    const auto properties = object.kind->properties;
    const auto found = std::find_if(properties.begin(), properties.end(),
                                    [&](const Property& p) { return p.name == property.label(); });
    if (found == properties.end()) return evaluate_misspelt(object, property, guessed);

    const auto index = static_cast<std::size_t>(found - properties.begin());
    Slot& slot = object.slots[index];
    if (slot.is_written && !guessed[index]) {
      sink_.report(diag::duplicate, property.label_location(), "property", property.label())
          .label(property.node.tree().location(slot.span), "first given here");
      return;
    }
    guessed[index] = false;
    read_value(*found, property, slot);
  }

  /// Reports an unknown property and takes it for the one that was probably meant, unless that one
  /// stands there too: what is missing only because of a slip of the pen is not missing.
  void evaluate_misspelt(Object& object, ast::Labeled property, PropertySet& guessed) {
    const auto properties = object.kind->properties;
    std::vector<std::string_view> names;
    for (const Property& known : properties) names.push_back(known.name);
    const auto nearest = nearest_name(property.label(), names);
    sink_
        .report(diag::unknown_property, property.label_location(), property.label(),
                object.kind->name)
        .suggest(nearest);
    const auto index = static_cast<std::size_t>(
        nearest ? std::find(names.begin(), names.end(), *nearest) - names.begin() : 0);
    if (nearest && !object.slots[index].is_written) {
      guessed[index] = true;
      read_value(properties[index], property, object.slots[index]);
    } else if (const auto value = property.value()) {
      expressions_.evaluate(*value);
    }
  }

  void read_value(const Property& property, ast::Labeled written, Slot& slot) {
    slot = {.value = {}, .span = written.node.span(), .is_written = true};
    if (const auto value = written.value()) {
      slot.span = value->span();
      slot.value = expressions_.evaluate_property(property, *value);
    }
  }

  void check_name(const Kind& kind, ast::Node name) {
    if (!kind.takes_name) {
      sink_.report(diag::takes_no_name, name.location(), kind.name).fix(name.location(), "");
      return;
    }
    // Spheres' names are labels outside the namespace; cameras are picked by name.
    if (kind.id != ObjectKind::Camera) return;
    const auto [first, is_new] = cameras_.try_emplace(name.text(), name.location());
    if (is_new) return;
    sink_.report(diag::duplicate, name.location(), "camera", name.text())
        .label(first->second, "first given here");
  }

  void check_unique(const Kind& kind, ast::Object node) {
    const auto [first, is_new] = unique_.try_emplace(kind.name, node.kind_location());
    if (is_new) return;
    sink_.report(diag::duplicate, node.kind_location(), "object", kind.name)
        .label(first->second, "first given here");
  }

  void report_unknown_kind(ast::Object node) {
    const std::string_view kind = node.kind();
    const bool is_later =
        std::find(kLaterKinds.begin(), kLaterKinds.end(), kind) != kLaterKinds.end();
    if (is_later) {
      sink_.report(diag::not_supported, node.kind_location(), fmt::format("`{}` is", kind));
      return;
    }
    if (names_.kinds.contains(kind) || names_.values.contains(first_name(kind)))
      return;  // reported where it is declared
    std::vector<std::string_view> names(names_.kinds.begin(), names_.kinds.end());
    for (const Kind& known : all_kinds()) names.push_back(known.name);
    names.insert(names.end(), kLaterKinds.begin(), kLaterKinds.end());
    sink_.report(diag::unknown_kind, node.kind_location(), kind).suggest(nearest_name(kind, names));
  }

  void report_misplaced(const Kind& kind, ast::Node statement) {
    const bool is_object = statement.is(SyntaxKind::Object);
    const Location where = is_object ? statement.head_location() : word_location(statement);
    const std::string_view word = is_object ? statement.head() : statement_word(statement.kind());
    auto report = sink_.report(diag::properties_only, where, kind.name, word);
    if (statement.is(SyntaxKind::If)) report.help("write `radius: if … then … else …`");
  }

  ast::Node file_;
  ObjectSink& objects_;
  DiagnosticSink& sink_;
  DeclaredNames names_;
  Declarations declarations_;
  Scopes scopes_;
  ExpressionEvaluator expressions_;
  std::map<std::string_view, Location> cameras_;
  std::map<std::string_view, Location> unique_;
};

}  // namespace

void evaluate(const SyntaxTree& tree, ObjectSink& objects, DiagnosticSink& sink) {
  FileEvaluator(tree, objects, sink).run();
}

}  // namespace sdlc::lang
