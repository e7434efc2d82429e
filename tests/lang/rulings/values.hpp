#pragma once

#include <string>
#include <vector>

#include "lang/object/object.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"
#include "tests/support/compilation/compilation.hpp"

/// What expressions compute to, found through a property of a scene; the test fails where the scene
/// is wrong. `declarations` stand at the scene's top level.
namespace sdlc::test {

double number(const std::string& expression, const std::string& declarations = "");
bool is_true(const std::string& expression, const std::string& declarations = "");
std::string text(const std::string& expression, const std::string& declarations = "");
double degrees(const std::string& expression, const std::string& declarations = "");
render::Vec3 vec3(const std::string& expression, const std::string& declarations = "");
render::LinearRgb color(const std::string& expression, const std::string& declarations = "");
lang::MaterialValue material(const std::string& expression, const std::string& declarations = "");

/// The codes of what is reported about an expression; empty where it is right.
std::vector<std::string> errors_in(const std::string& expression,
                                   const std::string& declarations = "");
/// What is reported about statements of a scene, but for what is missing to make a picture.
std::vector<std::string> errors_of(const std::string& statements);
/// The only thing that is reported about them; the test fails where there is none or another.
Told only_error_of(const std::string& statements);

/// A camera that looks at the origin, and a sphere of radius 1 there.
inline const std::string kCamera = "camera { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n";
inline const std::string kBall = "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n";

/// A sphere with this center and radius.
std::string ball_at(const std::string& center, const std::string& radius = "1");

}  // namespace sdlc::test
