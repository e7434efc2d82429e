#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/dependencies.hpp"
#include "lang/program/program.hpp"
#include "lang/repair/habits.hpp"
#include "lang/schema/schema.hpp"
#include "lang/value/builtins.hpp"

namespace sdlc::lang {

/// The name that was meant: what a habit says, else the nearest of those that are known.
std::optional<std::string_view> meant_name(const std::optional<Habit>& habit, std::string_view name,
                                           std::span<const std::string_view> known);

/// Finds out what each name of one file means, and makes code of its statements. Every unknown name
/// is reported, whether its place is ever reached or not.
class Resolver {
 public:
  Resolver(Program& program, std::uint32_t module, DiagnosticSink& sink);

  /// The declarations of the file's top level, into its Module.
  void resolve_declarations();
  /// One other statement of the top level: its index, or kNothing; `frame_size` is how many slots
  /// its frame has.
  std::uint32_t resolve_statement(ast::Node statement, Code& code, std::uint32_t& frame_size);
  /// The index of the expression that is all of the file, in the Module's code.
  std::uint32_t resolve_expression();

 private:
  // Names
  struct Local {
    std::string_view name;
    std::uint32_t slot;
    std::uint32_t hidden = kNothing;  ///< of those in by_name_, the one of this name further out
  };
  class Scope;
  class Guess;

  const Local* find_local(std::string_view name) const;
  std::uint32_t declare(std::string_view name);
  void forget_locals(std::size_t from);
  /// The module behind an import's name; kNothing where it could not be read.
  std::optional<std::uint32_t> find_import(std::string_view name) const;
  /// Whether the name that is used at this byte is unknown only because its declaration in the
  /// module could not be read, or is misspelt, which is reported then.
  bool is_excused(std::uint32_t module, std::string_view name, std::uint32_t use);
  const Misspelling* find_misspelling(std::uint32_t use);
  /// Shows the declaration of the name that is meant by the unknown one, if nothing uses it.
  void label_unused(DiagnosticBuilder& report, std::uint32_t use,
                    std::optional<std::string_view> meant);
  /// Shows the declaration in another file that was probably meant.
  static void label_declared(DiagnosticBuilder& report, ast::Node statement);
  /// Whether the nearest of so many names may still be looked for: a text with thousands of
  /// mistakes among thousands of names was not written by hand.
  bool may_suggest(std::size_t names);
  /// The path with the import that was probably meant in place of its first name.
  std::optional<std::string> nearest_import(std::span<const std::string_view> names) const;

  // Declarations
  void collect(ast::Node statement);
  void collect_definition(ast::Node statement, Definition& definition);
  void import_file(ast::Node statement);
  bool add_name(std::unordered_map<std::string_view, std::uint32_t>& names, std::string_view what,
                ast::Node name, std::uint32_t index);
  void report_duplicate(std::string_view what, ast::Node name);
  void resolve_global(Global& global);
  void resolve_definition(Definition& definition);
  const TypeInfo* resolve_type(ast::Node node);

  // Statements: the index of the statement, or kNothing
  std::uint32_t statement(ast::Node node, bool is_top);
  std::uint32_t let_statement(ast::Node node);
  std::uint32_t for_statement(ast::Node node);
  std::uint32_t if_statement(ast::Node node);
  std::uint32_t assert_statement(ast::Node node);
  std::uint32_t include_statement(ast::Node node);
  std::uint32_t object(ast::Object node, bool is_top);
  std::uint32_t object_of(const Kind& kind, ast::Object node);
  std::uint32_t group(const Kind& kind, ast::Object node);
  std::uint32_t instance_of(std::uint32_t module, std::uint32_t def, ast::Object node);
  std::uint32_t unknown_kind(ast::Object node, std::uint32_t scope, bool is_top);
  std::uint32_t object_as(std::string_view kind, ast::Object node, bool is_top);
  std::uint32_t object_of_no_kind(ast::Object node);
  /// Pushes the number of statements in a Block, and then they.
  void block(ast::Node node);
  void misplaced(std::string_view kind, ast::Node statement);
  void top_level_only(ast::Node statement);
  void check_name(const Kind& kind, ast::Object node);
  void read_properties(ast::Object node);
  void expect_inside(ast::Node statement);
  void read_property(ast::Labeled node);
  std::size_t guess_property(ast::Labeled node);
  /// Pushes pairs of the index, counted from `first`, and the value of each property from there on.
  void push_properties(std::size_t first);

  // Expressions: the index of the expression
  std::uint32_t expression(ast::Node node, const Property* property = nullptr);
  std::uint32_t operands_of(ast::Node node, Op op, const Property* property = nullptr);
  std::uint32_t number(ast::Node node);
  std::uint32_t reference(ast::Node node, const Property* property);
  std::uint32_t member(std::uint32_t operand, std::string_view name, ast::Node node);
  std::uint32_t postfix(ast::Node node);
  std::uint32_t call(ast::Call call);
  std::uint32_t builtin_call(const Builtin& builtin, ast::Call call);
  template <typename Parameters>
  std::uint32_t call_of(Op op, std::span<const std::uint32_t> callee, const Parameters& parameters,
                        ast::Call call);
  std::uint32_t function_call(std::uint32_t module, std::uint32_t function, ast::Call call);
  std::uint32_t unknown_name(ast::Node node, std::string_view name);
  /// Whether an object of the file has this label.
  bool names_object(std::string_view name) const;
  std::uint32_t unknown_import(ast::Node node, std::span<const std::string_view> names,
                               std::uint32_t module);
  std::uint32_t unknown_function(ast::Call call);
  std::uint32_t unknown_imported_function(ast::Call call, std::span<const std::string_view> names,
                                          std::optional<std::uint32_t> import);
  bool is_broken_function(Op op, std::span<const std::uint32_t> callee) const;
  std::uint32_t conditional(ast::Node node, const Property* property);
  std::uint32_t broken(ast::Node node);
  std::uint32_t constant(ast::Node node, Computed value);

  // Code
  std::uint32_t add(Op op, ast::Node node, std::uint32_t first = 0, std::uint32_t count = 0,
                    std::uint8_t detail = 0);
  /// With what was pushed since `mark` as its operands.
  std::uint32_t add_with(Op op, ast::Node node, std::size_t mark, std::uint8_t detail = 0);
  std::uint32_t add_statement(Action action, ast::Node node, std::size_t mark,
                              ObjectKind kind = ObjectKind::Sphere);

  /// The properties of the object that is being resolved. They hold expressions only, so that there
  /// is one such object at a time (a group puts its own aside); the vectors are kept for the next.
  struct Slots {
    /// What a property is called, and what it takes where a table says so.
    struct Name {
      std::string_view name;
      const Property* property;
      const TypeInfo* type;  ///< of a parameter, where it is declared with one
    };
    struct Given {
      std::uint32_t value = kNothing;  ///< expression
      Span span = {};                  ///< of the value
      bool is_written = false;
      bool is_guess = false;  ///< its name is misspelt
    };

    std::string_view kind;
    std::vector<Name> names;
    std::vector<Given> given;
    std::vector<std::uint32_t> others;  ///< expressions in no property's place
    bool is_broken = false;             ///< there may be other names, which could not be read

    void reset(std::string_view kind);
    void add(std::string_view name, const Property* property, const TypeInfo* type = nullptr);
    /// names.size() where there is none.
    std::size_t index_of(std::string_view name) const;
  };

  Program& program_;
  const std::uint32_t index_;
  Module& module_;
  DiagnosticSink& sink_;
  Code* code_;
  std::vector<std::uint32_t> pending_;  // operands of what is being resolved
  std::vector<Local> locals_;
  /// Those behind the first kFewLocals, which are looked through.
  std::unordered_map<std::string_view, std::uint32_t> by_name_;
  static constexpr std::size_t kFewLocals = 32;
  std::size_t block_begin_ = 0;  // of the innermost block's own, in locals_
  std::uint32_t frame_size_ = 0;
  bool is_guess_ = false;       // the kind of the object, or the function, is misspelt
  std::string_view declaring_;  // what no unknown name in its own value was meant to be
  Span no_color_;               // the value that was read last where no colour can be
  Uses uses_;                   // of the declaration being resolved
  Slots slots_;
};

/// While it lives, what is resolved is what was probably meant.
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

/// Forgets at its end what was declared while it lived.
class Resolver::Scope {
 public:
  explicit Scope(Resolver& resolver)
      : resolver_(resolver),
        size_(resolver.locals_.size()),
        block_begin_(std::exchange(resolver.block_begin_, size_)) {}
  ~Scope() {
    resolver_.forget_locals(size_);
    resolver_.block_begin_ = block_begin_;
  }
  Scope(const Scope&) = delete;
  Scope& operator=(const Scope&) = delete;

 private:
  Resolver& resolver_;
  std::size_t size_, block_begin_;
};

}  // namespace sdlc::lang
