#pragma once

#include <array>
#include <optional>
#include <set>
#include <span>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/eval/builtins.hpp"
#include "lang/eval/computed.hpp"
#include "lang/eval/declarations.hpp"
#include "lang/eval/scopes.hpp"
#include "lang/object/object.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// Names that a file declares and this evaluator cannot use yet.
struct DeclaredNames {
  std::set<std::string_view> values;  ///< import
  std::set<std::string_view> kinds;   ///< def
};

/// Computes expressions. What is wrong is reported once, where it is; what depends on it is silent.
///
/// It recurs as deep as the tree does, which the parser has limited, and into functions of the
/// file's own, which kMaxCalls limits.
class ExpressionEvaluator {
 public:
  ExpressionEvaluator(const DeclaredNames& names, const Declarations& declarations, Scopes& scopes,
                      DiagnosticSink& sink)
      : names_(names), declarations_(declarations), scopes_(scopes), sink_(sink) {}

  Computed evaluate(ast::Node node);
  /// The value in the place of a property or argument: of its type and in its range, or monostate.
  Value evaluate_property(const Property& property, ast::Node node);
  /// The value of a condition; nothing where it is none, which is reported in the name of `word`.
  std::optional<bool> evaluate_condition(ast::Node node, std::string_view word);
  /// The value of a let, param or parameter, of its type if it declares one.
  Computed check_declared_type(std::string_view name, std::optional<ast::Node> type, Computed value,
                               Location where);
  /// Counts a loop's turn or a call; false, once reported, when the file has taken too many.
  bool take_step(Location where);

 private:
  Computed evaluate_inner(ast::Node node);
  Computed evaluate_chain(ast::Node node);
  Computed evaluate_triple(ast::Node node);
  Computed evaluate_interval(ast::Node node);
  Computed evaluate_reference(ast::Node node);
  Computed evaluate_call(ast::Call call);
  Computed evaluate_builtin(const Builtin& builtin, ast::Call call);
  Computed evaluate_conditional(ast::Node node);
  /// `and` or `or`: evaluates no more operands than it needs.
  Computed evaluate_logic(ast::Node node);
  Computed evaluate_list(ast::Node node);
  Computed evaluate_postfix(ast::Node node);
  Computed evaluate_member(const Computed& value, std::string_view name, Location where);
  Computed call_declared(ast::Node function, ast::Call call);
  Computed evaluate_index(const Computed& value, ast::Node index);
  Computed not_supported(ast::Node node, std::string_view what);

  Value to_property(const Property& property, const Computed& computed, ast::Node node);
  Value evaluate_word(const Property& property, ast::Node node);
  Value wrong_type(const Property& property, std::string_view found, ast::Node node);

  const DeclaredNames& names_;
  const Declarations& declarations_;
  Scopes& scopes_;
  DiagnosticSink& sink_;
  int depth_ = 0;  // of evaluate()
  int calls_ = 0;  // of the file's own functions, around this moment
  int steps_ = 0;
};

/// At most this many arguments has a function.
inline constexpr std::size_t kMaxArguments = 3;

/// A built-in function: its parameters are described like properties, its body computes from their
/// values.
struct Function {
  std::string_view name;
  std::span<const Property> parameters;
};

/// What the arguments of a call are, by parameter; monostate where one is neither written nor has a
/// default.
struct Arguments {
  std::array<Slot, kMaxArguments> slots;
  bool are_valid = true;  ///< none is missing or wrong
};

std::span<const Function> all_functions() noexcept;
const Function* find_function(std::string_view name) noexcept;
/// Of functions that the language has and this evaluator does not yet.
bool is_later_function(std::string_view name) noexcept;
Computed call_function(const Function& function, const Arguments& arguments, ast::Call call,
                       DiagnosticSink& sink);

}  // namespace sdlc::lang
