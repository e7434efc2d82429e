#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

struct Builtin;

/// A call of a built-in function; no argument is Nothing.
struct BuiltinCall {
  const Builtin& function;
  std::span<const Value> arguments;
  std::span<const Value> options;  ///< one per option; Nothing: not given, and without a default
  ast::Node node;                  ///< of the call; for places in diagnostics only
  DiagnosticSink& sink;

  /// The place of the name, for errors of the result.
  Location where() const { return node.head_location(); }
  Location place(std::size_t argument) const { return node.child(argument)->location(); }
  /// The value of an option, if it is given.
  std::optional<ast::Node> option_node(std::size_t option) const;
};

/// What a call costs besides a constant.
struct BuiltinWork {
  std::uint64_t steps = 0;  ///< see limits.hpp
  std::uint64_t bytes = 0;  ///< of memory that the result takes, and of memory for its computation
};

/// Builtin::max_arguments of functions with any number of arguments.
inline constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);

/// The largest number of options that a function has.
inline constexpr std::size_t kMaxOptions = 3;

/// A built-in function with positional arguments, and options: settings that may be left out, given
/// by name or in order after the arguments. A wrong argument is reported; the result is then
/// Nothing.
struct Builtin {
  std::string_view name;
  std::string_view signature;  ///< as the reference shows it: "clamp(x, low, high)"
  std::size_t min_arguments, max_arguments;
  Value (*evaluate)(const BuiltinCall& call);
  /// The type of all arguments, one of types.hpp; empty: it varies. Those that return the type of
  /// their argument take angles too.
  std::string_view takes;
  /// A type of types.hpp; "=": that of the first argument; empty: it varies.
  std::string_view result;
  std::string_view topic;  ///< under which the reference lists it: "numbers"
  std::string_view doc;
  /// Steps (see limits.hpp) in addition to those of reading its arguments; 0: it does not read
  /// them.
  std::uint64_t steps = 3;
  /// What depends on the arguments; may be called with arguments of wrong types.
  BuiltinWork (*more_work)(const BuiltinCall& call) = nullptr;
  /// Of a function with a fixed number of arguments.
  std::span<const Property> options = {};

  std::size_t index() const noexcept;  ///< in all_builtins()
};

std::span<const Builtin> all_builtins() noexcept;
const Builtin* find_builtin(std::string_view name) noexcept;

}  // namespace sdlc::lang
