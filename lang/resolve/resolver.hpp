#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/code/code_builder.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/declarations.hpp"
#include "lang/resolve/global_order.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/property_slots.hpp"
#include "lang/resolve/scopes.hpp"
#include "lang/resolve/symbol_recorder.hpp"
#include "lang/resolve/unknown_names.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {

/// Resolves the names of one file and makes code of its statements: the only walk over a tree that
/// resolves names. Every unknown name is reported, whether evaluation reaches it or not.
///
/// resolver.cpp resolves declarations; resolve_statements.cpp, resolve_objects.cpp,
/// resolve_expressions.cpp and resolve_calls.cpp their parts; record_symbols.cpp has the functions
/// for recording only.
class Resolver {
 public:
  /// With a recorder, names are also resolved in text that compilation skips because of errors, no
  /// file is loaded and no name is suggested.
  Resolver(Modules& modules, std::uint32_t module, DiagnosticSink& sink,
           SymbolRecorder* recorder = nullptr);

  /// Resolves the declarations of the file's top level, which collect_declarations() has found,
  /// into its Module.
  void resolve_declarations();
  /// Resolves another statement of the top level into `code`. Returns its index there, or kNothing.
  std::uint32_t resolve_statement(ast::Node statement, Code& code);
  /// Resolves a file that is one expression. Returns its index in the Module's code.
  std::uint32_t resolve_expression();
  /// Resolves an expression that uses no locals but its own, as the value of `property`, which may
  /// be null, into `code`. Returns its index there.
  std::uint32_t resolve_value(ast::Node value, const Property* property, Code& code);
  /// Resolves every statement for the recorder. The Module does not change.
  void record_all();

 private:
  /// A block whose locals are visible up to `end`.
  class Block;
  /// During its lifetime, the kind or function being resolved is a guess for a misspelt one:
  /// missing properties and arguments are not reported.
  class Guess;

  // Declarations
  void resolve_global(Global& global);
  void resolve_definition(Definition& definition);
  /// A fn or def in a block.
  void local_definition(ast::Node statement);
  /// The visible local fn or def with this name, or null.
  const Definition* find_local(NameSpace space, std::string_view name) const;
  /// Notes for the local definition being resolved, if any, that it reads a local of a frame around
  /// its own, or uses another definition.
  void use_outer(OuterLocal local);
  void use_definition(const Definition& used);
  /// The operands that a call of a local fn or an instance of a local def begins with.
  std::array<std::uint32_t, 2> local_callee(const Definition& definition) const;
  const TypeInfo* resolve_type(ast::Node node);
  /// Returns the slot of the local in its frame.
  std::uint32_t declare_local(Symbol symbol);

  // Recording
  bool is_recording() const noexcept { return recorder_ != nullptr; }
  void record_declaration(ast::Node statement);
  void record_duplicate_parameters(const Definition& definition);
  /// A declaration in a block that is allowed at the top level only.
  void record_misplaced_declaration(ast::Node statement);
  /// A node without code because of an error.
  void record_skipped(ast::Node node);
  void record_skipped_children(ast::Node node);
  void record_error(ast::Node error, bool is_top);
  /// The children of a node besides its value: the rest of an expression with an error.
  void record_rest(ast::Node node, std::optional<ast::Node> value);
  void record_broken_for(ast::Node node);
  /// The declaration of the visible value with this name, which a new local hides; or kNothing.
  NodeIndex hidden_by(std::string_view name) const;
  /// The same for a local fn or def.
  NodeIndex hidden_definition(NameSpace space, std::string_view name) const;
  /// A path whose first name is no import.
  void record_path(std::span<const std::string_view> names);
  /// The label of a property in this slot.
  void record_label(ast::Labeled property, std::size_t slot);
  /// A statement in an object that takes properties only.
  void record_misplaced(ast::Node statement);

  // Statements; all return the index of the statement, or kNothing
  std::uint32_t statement(ast::Node node, bool is_top);
  std::uint32_t let_statement(ast::Node node);
  /// Declares the name of a let or binding whose value is resolved; returns its slot.
  std::uint32_t declare_let(ast::Node node);
  std::uint32_t for_statement(ast::Node node);
  /// Declares the names of a For or ForClause, and pushes its LoopSlots.
  void pattern(ast::Node loop, Span scope);
  std::uint32_t if_statement(ast::Node node);
  std::uint32_t assert_statement(ast::Node node);
  std::uint32_t include_statement(ast::Node node);
  void top_level_only(ast::Node statement);
  std::uint32_t property_outside(ast::Labeled property, bool is_top);
  /// Pushes the number of statements in a Block, then their indices.
  void block(ast::Node node);

  // Objects; all return the index of the statement, or kNothing
  std::uint32_t object(ast::Object node, bool is_top);
  std::uint32_t imported_object(ast::Object node, bool is_top);
  std::uint32_t object_of(const Kind& kind, ast::Object node);
  std::uint32_t group(const Kind& kind, ast::Object node);
  /// `callee`: the first operands of the Instance or LocalInstance.
  std::uint32_t instance_of(Action action, std::array<std::uint32_t, 2> callee,
                            const Definition& def, ast::Object node);
  std::uint32_t local_instance(const Definition& def, ast::Object node);
  /// Of a def of a top level.
  std::uint32_t instance_of(std::uint32_t module, std::uint32_t def, ast::Object node);
  bool has_all_parameters(const Module& owner, const Definition& def, ast::Object node);
  std::uint32_t object_as(const UnknownNames::IntendedKind& intended, std::uint32_t module,
                          ast::Object node, bool is_top);
  std::uint32_t object_of_no_kind(ast::Object node);
  void misplaced(ast::Node statement);
  void expect_inside(ast::Node statement);
  void check_name(const Kind& kind, ast::Object node);
  void read_properties(ast::Object node);
  void read_property(ast::Labeled node);
  std::size_t guess_property(ast::Labeled node);
  std::uint32_t property_value(ast::Labeled node, std::size_t index);

  // Names of imported files
  /// The declaration that a path such as `lib.name` names; records its names. Only a path of values
  /// may go on after the second name.
  std::optional<Declaration> imported_declaration(const Import& import, NameSpace space,
                                                  std::span<const std::string_view> names);

  // Expressions; all return the index of the expression
  std::uint32_t expression(ast::Node node, const Property* property = nullptr);
  std::uint32_t operands_of(ast::Node node, Op op);
  std::uint32_t broken_expression(ast::Node node);
  std::uint32_t string(ast::Node node);
  std::uint32_t number(ast::Node node);
  std::uint32_t conditional(ast::Node node, const Property* property);
  std::uint32_t let_in(ast::Node node, const Property* property);
  std::uint32_t comprehension(ast::Node node);
  std::uint32_t for_clause(ast::Node node, Span scope);
  std::uint32_t postfix(ast::Node node);
  std::uint32_t reference(ast::Node node, const Property* property);
  std::uint32_t local_value(ast::Node node, const Scopes::Local& local);
  bool is_declared(std::string_view name);
  std::uint32_t word(ast::Node node, const Property& property);
  std::uint32_t imported_value(ast::Node node, const Import& import,
                               std::span<const std::string_view> names);
  std::uint32_t builtin_value(ast::Node node, std::string_view name);
  std::uint32_t global_value(ast::Node node, std::uint32_t module, std::uint32_t global);

  // Calls; all return the index of the expression
  std::uint32_t call(ast::Call call);
  std::uint32_t imported_call(ast::Call call);
  std::uint32_t unknown_function(ast::Call call);
  std::uint32_t function_call(std::uint32_t module, std::uint32_t function, ast::Call call);
  std::uint32_t constructor_call(const Constructor& constructor, ast::Call call);
  std::uint32_t builtin_call(const Builtin& builtin, ast::Call call);
  struct BuiltinArguments;
  void builtin_argument(BuiltinArguments& arguments, ast::Node argument);
  void builtin_option(BuiltinArguments& arguments, ast::Labeled argument);
  std::size_t unknown_option(BuiltinArguments& arguments, ast::Labeled argument);
  // T: Property of a constructor, Parameter of a fn
  template <typename T>
  struct Binding;
  template <typename T>
  std::uint32_t call_of(Op op, std::span<const std::uint32_t> callee, std::span<const T> parameters,
                        ast::Call call, const Definition* function = nullptr);
  bool has_swapped_color(ast::Call call, std::span<const Property> parameters);
  template <typename T>
  void bind_argument(Binding<T>& binding, ast::Node argument);
  template <typename T>
  std::size_t labeled_argument(Binding<T>& binding, ast::Labeled argument);
  template <typename T>
  std::size_t positional_argument(Binding<T>& binding, ast::Node argument);
  template <typename T>
  void record_argument(const Binding<T>& binding, std::string_view label, std::size_t index);

  Modules& modules_;
  const std::uint32_t index_;
  Module& module_;
  DiagnosticSink& sink_;
  SymbolRecorder* recorder_;
  CodeBuilder code_;
  Scopes scopes_;
  Scopes functions_, kinds_;                                      // local fns and defs
  std::vector<const Definition*> local_functions_, local_kinds_;  // by index in those
  Definition* definition_ = nullptr;                              // the local one being resolved
  UnknownNames unknown_;
  std::uint32_t scope_end_ = 0;  // of the innermost block
  bool is_guess_ = false;
  std::string_view declaring_;  // the current let or param
  Span no_color_;               // the last value in a place that does not accept a colour
  Uses uses_;                   // of the current declaration
  // Of the current object. Properties contain expressions only, so objects are not nested here (a
  // group moves its own slots aside); the vectors are reused.
  PropertySlots slots_;
};

class Resolver::Block {
 public:
  Block(Resolver& resolver, std::uint32_t end)
      : block_(resolver.scopes_),
        functions_(resolver.functions_),
        kinds_(resolver.kinds_),
        scope_end_(resolver.scope_end_),
        outer_end_(std::exchange(resolver.scope_end_, end)) {}
  ~Block() { scope_end_ = outer_end_; }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

 private:
  Scopes::Block block_, functions_, kinds_;
  std::uint32_t& scope_end_;
  std::uint32_t outer_end_;
};

class Resolver::Guess {
 public:
  explicit Guess(Resolver& resolver)
      : resolver_(resolver), outer_(std::exchange(resolver.is_guess_, true)) {}
  ~Guess() { resolver_.is_guess_ = outer_; }
  Guess(const Guess&) = delete;
  Guess& operator=(const Guess&) = delete;

 private:
  Resolver& resolver_;
  bool outer_;
};

}  // namespace sdlc::lang
