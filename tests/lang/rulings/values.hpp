#pragma once

#include <string>
#include <vector>

#include "lang/object/object.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "tests/support/compilation/compilation.hpp"

/// The results of expressions, observed through a property of a scene; the test fails if the scene
/// has errors. `declarations` are added at the top level.
namespace sdlc::test {

double number(const std::string& expression, const std::string& declarations = "");
bool is_true(const std::string& expression, const std::string& declarations = "");
std::string text(const std::string& expression, const std::string& declarations = "");
double degrees(const std::string& expression, const std::string& declarations = "");
render::Vec3 vec3(const std::string& expression, const std::string& declarations = "");
render::LinearRgb color(const std::string& expression, const std::string& declarations = "");
lang::MaterialValue material(const std::string& expression, const std::string& declarations = "");

/// The codes of the diagnostics of an expression; empty if it is valid.
std::vector<std::string> errors_in(const std::string& expression,
                                   const std::string& declarations = "");
/// The diagnostics of statements of a scene, except those about missing parts of a picture.
std::vector<std::string> errors_of(const std::string& statements);
/// Their only diagnostic; the test fails if there is none or another one.
Told only_error_of(const std::string& statements);

/// A camera that looks at the origin, and a sphere of radius 1 there.
inline const std::string kCamera = "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n";
inline const std::string kBall = "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n";

/// A sphere with this center and radius.
std::string ball_at(const std::string& center, const std::string& radius = "1");

}  // namespace sdlc::test
