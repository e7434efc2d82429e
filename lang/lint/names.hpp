#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// A name that a file declares.
struct DeclaredName {
  enum Kind : std::uint8_t { Let, Param, Import, Fn, Def, Parameter, Loop } kind = Let;
  Location where;           ///< of the name
  NodeIndex statement = 0;  ///< that declares it
  std::string_view name;
  bool is_used = false;           ///< outside of its own declaration
  std::optional<Location> hides;  ///< another value of the name that is visible there too
};

/// The names of a file without errors, and what `time` it reads, by the rules of the resolver:
/// values, functions and kinds have name spaces of their own, the top level is without order, a
/// block's let is visible behind it.
class FileNames {
 public:
  explicit FileNames(const SyntaxTree& tree);

  const std::vector<DeclaredName>& declared() const noexcept { return declared_; }
  /// The first use of the built-in `time`.
  std::optional<Location> time() const noexcept { return time_; }

 private:
  using Names = std::unordered_map<std::string_view, std::uint32_t>;

  std::uint32_t declare(DeclaredName::Kind kind, ast::Node statement, Location where,
                        std::string_view name);
  void declare_top(ast::Node statement);
  void declare_local(DeclaredName::Kind kind, ast::Node statement, Location where,
                     std::string_view name);
  /// Ends a scope: all but the first `size` local names.
  void leave_locals(std::size_t size);
  std::optional<std::uint32_t> find_value(std::string_view name) const;
  void use(std::optional<std::uint32_t> declared);
  void use_path(const Names& names, std::string_view path);
  void use_value(std::string_view name, Location where);

  void visit(ast::Node node);
  void visit_children(ast::Node node);
  void visit_top(ast::Node statement);
  void visit_for(ast::Node node);
  void visit_definition(ast::Node node);
  void visit_object(ast::Object object);

  const SyntaxTree& tree_;
  std::vector<DeclaredName> declared_;
  Names values_, functions_, kinds_;
  std::vector<std::uint32_t> locals_;  ///< that are visible, by where they are declared
  std::unordered_map<std::string_view, std::vector<std::uint32_t>> locals_by_name_;
  std::optional<std::uint32_t> inside_;  ///< the top declaration that is being visited
  bool is_inside_block_ = false;
  std::optional<Location> time_;
};

}  // namespace sdlc::lang
