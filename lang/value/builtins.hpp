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
  ast::Node node;  ///< of the call; read only for places in reports
  DiagnosticSink& sink;

  /// The place of the name, for reports about the result.
  Location where() const { return node.head_location(); }
  Location place(std::size_t argument) const { return node.child(argument)->location(); }
};

/// A function of values, written with positional arguments. What is wrong with an argument is
/// reported.
struct Builtin {
  std::string_view name;
  std::string_view signature;  ///< as the reference shows it: "clamp(x, low, high)"
  std::size_t least, most;     ///< numbers of arguments
  Value (*evaluate)(const BuiltinCall& call);
  std::string_view topic;  ///< under which the reference lists it: "numbers"
  std::string_view doc;
  /// Steps beside those of reading its arguments (see limits.hpp); 0: it does not read them.
  std::uint64_t steps = 3;
  /// Additional steps that depend on the arguments.
  std::uint64_t (*more_steps)(std::span<const Value> arguments) = nullptr;

  std::size_t index() const noexcept;  ///< in all_builtins()
};

std::span<const Builtin> all_builtins() noexcept;
const Builtin* find_builtin(std::string_view name) noexcept;

}  // namespace sdlc::lang
