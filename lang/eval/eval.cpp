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

DeclaredNames find_declared_names(ast::Node file) {
  DeclaredNames names;
  for (const ast::Node statement : file.children()) {
    const auto name =
        statement.is(SyntaxKind::Object) ? std::nullopt : statement.first(SyntaxKind::Name);
    if (!name) continue;
    if (statement.is(SyntaxKind::Fn)) {
      names.functions.insert(name->text());
    } else if (statement.is(SyntaxKind::Def)) {
      names.kinds.insert(name->text());
    } else {
      names.values.insert(name->text());
    }
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
        names_(find_declared_names(file_)),
        expressions_(names_, sink) {}

  void run() {
    for (const ast::Node statement : file_.children()) evaluate_statement(statement);
  }

 private:
  void evaluate_statement(ast::Node statement) {
    switch (statement.kind()) {
      case SyntaxKind::Object: return evaluate_object({statement});
      case SyntaxKind::Property: {
        const ast::Labeled property{statement};
        sink_.report(diag::property_outside, property.label_location(), property.label());
        return;
      }
      case SyntaxKind::Error:
      case SyntaxKind::Version: return;
      default:
        sink_.report(diag::not_supported, word_location(statement),
                     fmt::format("`{}` is", statement_word(statement.kind())));
    }
  }

  void evaluate_object(ast::Object node) {
    const Kind* kind = find_kind(node.kind());
    if (kind == nullptr) return report_unknown_kind(node);

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
    const std::string_view first = kind.substr(0, kind.find_first_of(". \t\r\n/"));
    if (names_.kinds.contains(kind) || names_.values.contains(first))
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
  ExpressionEvaluator expressions_;
  std::map<std::string_view, Location> cameras_;
  std::map<std::string_view, Location> unique_;
};

}  // namespace

void evaluate(const SyntaxTree& tree, ObjectSink& objects, DiagnosticSink& sink) {
  FileEvaluator(tree, objects, sink).run();
}

}  // namespace sdlc::lang
