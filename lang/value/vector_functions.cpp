#include <cmath>

#include "lang/math/elementary.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"
#include "render/math/power_of_two.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {
namespace {

using render::Vec3;

Value evaluate_dot(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  return finite(call, Scalar{dot(a->value, b->value)});
}

Value evaluate_cross(const BuiltinCall& call) {
  const auto *a = argument<Triple>(call, 0), *b = argument<Triple>(call, 1);
  if (a == nullptr) return wrong_argument(call, 0, "a vector");
  if (b == nullptr) return wrong_argument(call, 1, "a vector");
  return finite(call, Triple{cross(a->value, b->value)});
}

/// The length, scaled by a power of two so that no square overflows or underflows.
double length_of(Vec3 v) noexcept {
  if (v == Vec3{}) return 0;
  const int e = render::exponent_of(max_abs(v));
  return std::ldexp(render::length(render::scaled_by_power_of_two(v, -e)), e);
}

Value evaluate_length(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  return v == nullptr ? wrong_argument(call, 0, "a vector")
                      : finite(call, Scalar{length_of(v->value), v->unit});
}

Value evaluate_normalize(const BuiltinCall& call) {
  const auto* v = argument<Triple>(call, 0);
  if (v == nullptr) return wrong_argument(call, 0, "a vector");
  if (v->value == Vec3{}) return no_result(call, "the zero vector");
  return Triple{render::unit(render::with_moderate_length(v->value))};
}

/// Rodrigues' rotation, with the part along the axis apart so that it is kept exactly if the axis
/// is one of the coordinate system.
Vec3 rotated(Vec3 v, Vec3 axis, double degrees) noexcept {
  const double sine = sin_degrees(degrees), cosine = cos_degrees(degrees);
  if (cosine == 1) return v;
  const Vec3 along = axis * dot(v, axis);
  return along + (v - along) * cosine + cross(axis, v) * sine;
}

Value evaluate_rotate(const BuiltinCall& call) {
  const auto *v = argument<Triple>(call, 0), *axis = argument<Triple>(call, 1);
  const auto* angle = argument<Angle>(call, 2);
  if (v == nullptr) return wrong_argument(call, 0, "a vector");
  if (axis == nullptr) return wrong_argument(call, 1, "a vector");
  if (angle == nullptr) return wrong_argument(call, 2, kAngleWanted);
  if (axis->value == Vec3{}) return no_result(call, "an axis of length 0");
  const Vec3 unit = render::unit(render::with_moderate_length(axis->value));
  return finite(call, Triple{rotated(v->value, unit, angle->degrees), v->unit});
}

constexpr auto kVectorFunctions = std::to_array<Builtin>({
    {"dot", "dot(a, b)", 2, 2, evaluate_dot, "vec3", "number", "vectors", "Dot product."},
    {"cross", "cross(a, b)", 2, 2, evaluate_cross, "vec3", "vec3", "vectors",
     "Cross product, right-handed."},
    {"length", "length(v)", 1, 1, evaluate_length, "vec3", "number", "vectors",
     "Length, with the unit of the vector.", 5},
    {"normalize", "normalize(v)", 1, 1, evaluate_normalize, "vec3", "vec3", "vectors",
     "The vector of length 1 in the direction of `v`, which is not (0, 0, 0).", 5},
    {"rotate", "rotate(v, axis, angle)", 3, 3, evaluate_rotate, "", "vec3", "vectors",
     "`v` turned about an axis through (0, 0, 0), counterclockwise seen from the tip of `axis`, "
     "which may have any length but 0.",
     150},
});

}  // namespace

std::span<const Builtin> vector_functions() noexcept { return kVectorFunctions; }

}  // namespace sdlc::lang
