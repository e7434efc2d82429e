#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::cli {

/// The cameras that a text declares.
std::vector<lang::ast::Node> cameras_of(const lang::SyntaxTree& tree);
/// Empty if it has none.
std::string_view name_of(const lang::ast::Node& object);

// The names that a scene declares itself, as far as it can be parsed.

std::vector<std::string> camera_names(const lang::Document& scene);
std::vector<std::string> param_names(const lang::Document& scene);

}  // namespace sdlc::cli
