#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/value/computed.hpp"

namespace sdlc::lang {

/// A call of a built-in function with arguments none of which has failed.
struct BuiltinCall {
  std::string_view name;
  std::span<const Computed> arguments;
  ast::Node node;  ///< of the call; looked at only for places
  DiagnosticSink& sink;

  /// Of the name: what is wrong with the result is reported there.
  Location where() const { return node.head_location(); }
  Location place(std::size_t argument) const { return node.child(argument)->location(); }
};

/// A function of values, written with positional arguments. What is wrong with an argument is
/// reported.
struct Builtin {
  std::string_view name;
  std::string_view signature;  ///< as the reference shows it: "clamp(x, low, high)"
  std::size_t least, most;     ///< numbers of arguments
  Computed (*evaluate)(const BuiltinCall& call);
  std::string_view topic;  ///< under which the reference lists it: "numbers"
  std::string_view doc;
  /// Steps beside those of reading its arguments (see limits.hpp); 0: it does not look at them.
  std::uint64_t steps = 3;
  /// Those that depend on the arguments.
  std::uint64_t (*more_steps)(std::span<const Computed> arguments) = nullptr;

  std::size_t index() const noexcept;  ///< in all_builtins()
};

std::span<const Builtin> all_builtins() noexcept;
const Builtin* find_builtin(std::string_view name) noexcept;

}  // namespace sdlc::lang
