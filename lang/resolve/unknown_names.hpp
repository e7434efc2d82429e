#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/scopes.hpp"
#include "lang/schema/habits.hpp"

namespace sdlc::lang {

/// The name that was probably meant: what a habit says, else the nearest of the known ones.
std::optional<std::string_view> meant_name(const std::optional<Habit>& habit, std::string_view name,
                                           std::span<const std::string_view> known);

/// Reports the unknown names of one file, with the names that were probably meant. What returns a
/// name returns the one that the caller should go on with.
class UnknownNames {
 public:
  UnknownNames(Modules& modules, std::uint32_t module, const Scopes& scopes, DiagnosticSink& sink)
      : modules_(modules),
        index_(module),
        module_(modules.module_at(module)),
        scopes_(scopes),
        sink_(sink) {}

  /// What an unknown value cannot have been meant to be.
  struct Excluded {
    std::string_view declaring;  ///< the value in whose declaration it is
    Span no_color;               ///< the place of a value that cannot be a colour
  };

  /// `name`: the first of the path that the Reference is.
  void report_value(ast::Node reference, std::string_view name, const Excluded& excluded);
  void report_imported_value(ast::Node reference, std::span<const std::string_view> names,
                             std::uint32_t module);
  std::optional<std::string_view> report_function(ast::Call call);
  void report_imported_function(ast::Call call, std::span<const std::string_view> names,
                                std::optional<std::uint32_t> module);
  /// `module`: where kinds of that path are declared. Nothing is reported if `excused` is set.
  struct MeantKind {
    bool is_excused = false;
    std::optional<std::string_view> name = {};
  };
  MeantKind report_kind(ast::Object object, std::uint32_t module);
  /// The first of the names is no import.
  MeantKind report_kind_of_no_import(ast::Object object, std::span<const std::string_view> names);

  struct MeantProperty {
    std::optional<std::string_view> name;
    std::string_view in_place_of;  ///< a property that this one replaces
  };
  /// `names`: the properties of the kind; it is not reported if the kind is broken.
  MeantProperty report_property(ast::Labeled property, std::string_view kind,
                                std::span<const std::string_view> names, bool is_broken);
  /// Whether the name is unknown only because its declaration in the module could not be read, or
  /// is misspelt, which is reported then. `use`: the byte where the name begins.
  bool is_excused(std::uint32_t module, std::string_view name, std::uint32_t use);

 private:
  const Misspelling* find_misspelling(std::uint32_t use);
  std::vector<std::string_view> known_values(std::uint32_t use, std::string_view declaring);
  /// Labels the declaration of the name that was meant, if nothing uses it.
  void label_unused(DiagnosticBuilder& report, std::uint32_t use,
                    std::optional<std::string_view> meant);
  /// The suggestion of a name that another file declares.
  static void suggest_member(DiagnosticBuilder& report, std::string_view import,
                             std::string_view name, ast::Node declaration);
  /// Whether the nearest of so many names may still be searched: a text with thousands of mistakes
  /// and thousands of names was not written by hand.
  bool may_suggest(std::size_t names);
  /// The path with the import that was probably meant in place of its first name.
  std::optional<std::string> nearest_import(std::span<const std::string_view> names) const;
  /// Whether an object of the file has this label.
  bool names_object(std::string_view name) const;

  Modules& modules_;
  std::uint32_t index_;
  Module& module_;
  const Scopes& scopes_;
  DiagnosticSink& sink_;
};

}  // namespace sdlc::lang
