#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/repair/habits.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/scopes.hpp"

namespace sdlc::lang {

/// The intended name: that of the habit if it is known; without a habit the nearest known name.
std::optional<std::string_view> intended_name(const std::optional<Habit>& habit,
                                              std::string_view name,
                                              std::span<const std::string_view> known);

/// Reports the unknown names of one file, with suggestions. Functions that return a name return the
/// intended one, which the caller resolves instead.
class UnknownNames {
 public:
  /// What is visible in blocks, beside the declarations of the file.
  struct Locals {
    const Scopes &values, &functions, &kinds;
  };

  UnknownNames(Modules& modules, std::uint32_t module, Locals locals, DiagnosticSink& sink)
      : modules_(modules),
        index_(module),
        module_(modules.module_at(module)),
        locals_(locals),
        sink_(sink) {}

  /// Values that are not suggested.
  struct Excluded {
    std::string_view declaring;  ///< the value whose declaration has the name
    Span no_color;               ///< the place of a value that cannot be a colour
  };

  /// `name`: the first name of the Reference.
  void report_value(ast::Node reference, std::string_view name, const Excluded& excluded);
  void report_imported_value(ast::Node reference, std::span<const std::string_view> names,
                             std::uint32_t module);
  std::optional<std::string_view> report_function(ast::Call call);
  void report_imported_function(ast::Call call, std::span<const std::string_view> names,
                                std::optional<std::uint32_t> module);
  /// If `is_excused`, nothing is reported.
  struct IntendedKind {
    bool is_excused = false;
    std::optional<std::string_view> name = {};
  };
  /// `module`: the module that the path names, or this one.
  IntendedKind report_kind(ast::Object object, std::uint32_t module);
  /// A path whose first name is no import.
  IntendedKind report_kind_of_no_import(ast::Object object,
                                        std::span<const std::string_view> names);

  struct IntendedProperty {
    std::optional<std::string_view> name;
    std::string_view in_place_of;  ///< a property that is not missing: see Habit
  };
  /// `names`: the properties of the kind. If `is_broken`, nothing is reported.
  IntendedProperty report_property(ast::Labeled property, std::string_view kind,
                                   std::span<const std::string_view> names, bool is_broken);
  /// Whether the name is unknown only because its declaration in the module could not be read, or
  /// is misspelt, which is reported instead. `use`: the offset of the name.
  bool is_excused(std::uint32_t module, std::string_view name, std::uint32_t use);

 private:
  const Misspelling* find_misspelling(std::uint32_t use);
  std::vector<std::string_view> known_values(std::uint32_t use, std::string_view declaring);
  /// Adds a label to the declaration of the intended name if nothing uses it.
  void label_unused(DiagnosticBuilder& report, std::uint32_t use,
                    std::optional<std::string_view> meant);
  /// Suggests the nearest name that an imported module declares in place of the end of the path;
  /// returns it.
  std::optional<std::string_view> suggest_member(DiagnosticBuilder& report,
                                                 std::span<const std::string_view> path,
                                                 const Module& module, NameSpace space);
  /// Whether the nearest of this many names may be searched. The number of comparisons is limited:
  /// a text with thousands of errors and thousands of names is not written by hand.
  bool may_suggest(std::size_t names);
  /// The path with the nearest import as its first name.
  std::optional<std::string> nearest_import(std::span<const std::string_view> names) const;
  /// Whether an object of the file has this name.
  bool names_object(std::string_view name);

  Modules& modules_;
  std::uint32_t index_;
  Module& module_;
  Locals locals_;
  DiagnosticSink& sink_;
};

}  // namespace sdlc::lang
