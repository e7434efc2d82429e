#include <array>
#include <cmath>
#include <string>

#include "lang/math/random.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

/// Adds the arguments; false if one has a wrong type, which is reported.
bool add_arguments(const BuiltinCall& call, RandomHash& hash) {
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
      wrong_argument(call, i, "numbers, strings, vectors, angles, true or false");
      return false;
    }
  }
  return true;
}

Value evaluate_random(const BuiltinCall& call) {
  RandomHash hash;
  if (!add_arguments(call, hash)) return Nothing{};
  return Scalar{hash.uniform()};
}

template <render::Vec3 (*point)(const RandomHash&) noexcept>
Value random_point(const BuiltinCall& call) {
  RandomHash hash;
  if (!add_arguments(call, hash)) return Nothing{};
  return Triple{point(hash)};
}

Value evaluate_normal(const BuiltinCall& call) {
  RandomHash hash;
  if (!add_arguments(call, hash)) return Nothing{};
  return Scalar{random_normal(hash)};
}

constexpr auto kNoiseOption = std::to_array<Property>({
    {.name = "octaves",
     .type = Type::WholeNumber,
     .range = Range::Octaves,
     .default_value = 1.0,
     .default_text = "1",
     .doc = "How many noises are added up, each twice as fine and half as strong as the one "
            "before; the sum is scaled to stay between -1 and 1."},
});

constexpr std::uint64_t kStepsOfNoise = 14;

int octaves_of(const BuiltinCall& call) {
  return static_cast<int>(get<Scalar>(call.options[0]).value);
}

BuiltinWork work_of_noise(const BuiltinCall& call) {
  const auto more = static_cast<std::uint64_t>(octaves_of(call) - 1);
  return {.steps = kStepsOfNoise * more};
}

Value evaluate_noise(const BuiltinCall& call) {
  const auto* p = argument<Triple>(call, 0);
  if (p == nullptr) return wrong_argument(call, 0, "a vector");
  const int octaves = octaves_of(call);
  if (octaves == 1) return Scalar{noise(p->value)};
  const Value finest = finite(call, Triple{p->value * std::ldexp(1, octaves)});
  return is_nothing(finest) ? finest : Scalar{noise(p->value, octaves)};
}

constexpr auto kRandomFunctions = std::to_array<Builtin>({
    {"random", "random(a, …)", 1, kAnyNumber, evaluate_random, "", "number", "randomness",
     "A random number, uniform in [0, 1); the same arguments give the same number.", 3},
    {.name = "noise",
     .signature = "noise(p, octaves: 1)",
     .min_arguments = 1,
     .max_arguments = 1,
     .evaluate = evaluate_noise,
     .takes = "vec3",
     .result = "number",
     .topic = "randomness",
     .doc = "Smooth noise between -1 and 1 at a point in space.",
     .steps = kStepsOfNoise,
     .more_work = work_of_noise,
     .options = kNoiseOption},
    {"random_in_disc", "random_in_disc(a, …)", 1, kAnyNumber, random_point<random_in_disc>, "",
     "vec3", "randomness", "A random point in the disc of radius 1 about (0, 0, 0), with z = 0.",
     80},
    {"random_on_sphere", "random_on_sphere(a, …)", 1, kAnyNumber, random_point<random_on_sphere>,
     "", "vec3", "randomness", "A random point on the sphere of radius 1: a random direction.", 80},
    {"random_in_sphere", "random_in_sphere(a, …)", 1, kAnyNumber, random_point<random_in_sphere>,
     "", "vec3", "randomness", "A random point in the sphere of radius 1.", 180},
    {"random_normal", "random_normal(a, …)", 1, kAnyNumber, evaluate_normal, "", "number",
     "randomness", "A random number of the normal distribution of mean 0 and standard deviation 1.",
     140},
});

}  // namespace

std::span<const Builtin> random_functions() noexcept { return kRandomFunctions; }

}  // namespace sdlc::lang
