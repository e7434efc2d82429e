#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// The values and functions that the top level of a file declares, in an order in which each can be
/// computed from those before it (ruling 9: the order they are written in does not matter).
class Declarations {
 public:
  /// Reports names that are declared twice, and values that depend on themselves.
  Declarations(ast::Node file, DiagnosticSink& sink);

  /// The let and param statements, each behind those it uses. One that depends on itself is left
  /// out.
  const std::vector<ast::Node>& values() const noexcept { return order_; }
  /// The fn statement of this name, or nothing.
  std::optional<ast::Node> function(std::string_view name) const;
  const std::vector<std::string_view>& function_names() const noexcept { return function_names_; }

 private:
  void collect(ast::Node file, DiagnosticSink& sink);
  void sort(DiagnosticSink& sink);

  struct Declaration {
    ast::Node statement;
    std::vector<std::size_t> uses;
  };

  std::vector<Declaration> declarations_;
  std::unordered_map<std::string_view, std::size_t> values_, functions_;
  std::vector<std::string_view> function_names_;
  std::vector<ast::Node> order_;
};

/// The name that a let, param, fn or for statement declares; empty where it could not be read.
std::string_view declared_name(ast::Node statement);

/// The name of `.name`, without the blanks that may stand around it.
std::string_view name_behind_dot(std::string_view member) noexcept;

/// The first name of a path: `mat` of `mat.brushed`.
std::string_view first_name(std::string_view path) noexcept;

}  // namespace sdlc::lang
