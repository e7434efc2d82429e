#include <string>

#include "lang/math/random.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

Value evaluate_random(const BuiltinCall& call) {
  RandomHash hash;
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    if (const auto* number = argument<Scalar>(call, i)) {
      hash.add_number(number->value);
    } else if (const auto* flag = argument<bool>(call, i)) {
      hash.add_bool(*flag);
    } else if (const auto* text = argument<std::string>(call, i)) {
      hash.add_string(*text);
    } else if (const auto* v = argument<Triple>(call, i)) {
      hash.add_vec3(v->value);
    } else if (const auto* angle = argument<Angle>(call, i)) {
      hash.add_angle(angle->degrees);
    } else {
      return wrong_argument(call, i, "numbers, strings, vectors, angles, true or false");
    }
  }
  return Scalar{hash.uniform()};
}

Value evaluate_noise(const BuiltinCall& call) {
  const auto* p = argument<Triple>(call, 0);
  return p == nullptr ? wrong_argument(call, 0, "a vector") : Scalar{noise(p->value)};
}

constexpr auto kRandomFunctions = std::to_array<Builtin>({
    {"random", "random(a, …)", 1, kAnyNumber, evaluate_random, "", "number", "randomness",
     "A random number, uniform in [0, 1); the same arguments give the same number.", 3},
    {"noise", "noise(p)", 1, 1, evaluate_noise, "vec3", "number", "randomness",
     "Smooth noise between -1 and 1 at a point in space.", 14},
});

}  // namespace

std::span<const Builtin> random_functions() noexcept { return kRandomFunctions; }

}  // namespace sdlc::lang
