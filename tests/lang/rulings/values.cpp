#include "tests/lang/rulings/values.hpp"

#include <gtest/gtest.h>

#include "lang/schema/schema.hpp"

namespace sdlc::test {
namespace {

/// The value of a property of the last object, which is the only one with an expression in it.
template <typename T>
T value_of(const std::string& declarations, const std::string& object, std::size_t property) {
  const std::string scene = declarations + "\n" + object;
  const Evaluated result = evaluated({.root = scene});
  for (const Told& told : result.told) {
    ADD_FAILURE() << scene << "\n" << told.code << ": " << told.message << " at " << told.at;
  }
  if (result.objects.empty()) return T{};
  return result.objects.back().get<T>(property).value_or(T{});
}

}  // namespace

double number(const std::string& expression, const std::string& declarations) {
  return vec3("(" + expression + ", 0, 0)", declarations).x;
}

bool is_true(const std::string& expression, const std::string& declarations) {
  return number("if " + expression + " then 1 else 0", declarations) == 1;
}

std::string text(const std::string& expression, const std::string& declarations) {
  return value_of<std::string>(declarations, "render { output: " + expression + " }",
                               lang::render_property::kOutput);
}

double degrees(const std::string& expression, const std::string& declarations) {
  return value_of<lang::AngleTriple>(declarations,
                                     "group { rotate: (" + expression + ", 0deg, 0deg) }",
                                     lang::group_property::kRotate)
      .degrees.x;
}

render::Vec3 vec3(const std::string& expression, const std::string& declarations) {
  return value_of<render::Vec3>(declarations, "group { translate: " + expression + " }",
                                lang::group_property::kTranslate);
}

render::LinearRgb color(const std::string& expression, const std::string& declarations) {
  return material("unlit(" + expression + ")", declarations).color;
}

lang::MaterialValue material(const std::string& expression, const std::string& declarations) {
  return value_of<lang::MaterialValue>(declarations, "group { material: " + expression + " }",
                                       lang::group_property::kMaterial);
}

std::vector<std::string> errors_in(const std::string& expression, const std::string& declarations) {
  return errors_of(declarations + "\nlet tested = " + expression);
}

std::vector<std::string> errors_of(const std::string& statements) {
  return evaluated({.root = statements}).codes();
}

Told only_error_of(const std::string& statements) {
  const std::vector<Told> told = evaluated({.root = statements}).told;
  if (told.size() != 1) {
    ADD_FAILURE() << statements << "\n" << told.size() << " reports";
    for (const Told& one : told) ADD_FAILURE() << one.code << ": " << one.message;
  }
  return told.empty() ? Told{} : told.front();
}

std::string ball_at(const std::string& center, const std::string& radius) {
  return "sphere { center: " + center + ", radius: " + radius + ", material: unlit(red) }\n";
}

}  // namespace sdlc::test
