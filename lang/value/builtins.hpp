#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"

namespace sdlc::lang {

/// A call of a built-in function; no argument is Nothing.
struct BuiltinCall {
  std::string_view name;
  std::span<const Value> arguments;
  ast::Node node;  ///< of the call; for places in diagnostics only
  DiagnosticSink& sink;

  /// The place of the name, for errors of the result.
  Location where() const { return node.head_location(); }
  Location place(std::size_t argument) const { return node.child(argument)->location(); }
};

/// Builtin::max_arguments of functions with any number of arguments.
inline constexpr std::size_t kAnyNumber = static_cast<std::size_t>(-1);

/// A built-in function with positional arguments. A wrong argument is reported; the result is then
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
  /// Additional steps that depend on the arguments.
  std::uint64_t (*more_steps)(std::span<const Value> arguments) = nullptr;

  std::size_t index() const noexcept;  ///< in all_builtins()
};

std::span<const Builtin> all_builtins() noexcept;
const Builtin* find_builtin(std::string_view name) noexcept;

}  // namespace sdlc::lang
