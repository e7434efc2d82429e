#include "lang/math/random.hpp"

#include <bit>
#include <cmath>

#include "lang/math/elementary.hpp"
#include "render/shading/sampler.hpp"

namespace sdlc::lang {
namespace {

/// The word before each argument: its type.
constexpr std::uint64_t kNumber = 1, kBool = 2, kString = 3, kVec3 = 4, kAngle = 5;

double fade(double t) noexcept { return t * t * t * (t * (t * 6 - 15) + 10); }

double mix(double a, double b, double t) noexcept { return a + t * (b - a); }

constexpr double kTurn = 360;

render::Vec3 on_circle(double radius, double turns, double z) noexcept {
  const double degrees = kTurn * turns;
  return {radius * cos_degrees(degrees), radius * sin_degrees(degrees), z};
}

render::Vec3 on_sphere(const RandomHash& arguments, std::string_view name) noexcept {
  const double u = arguments.uniform_of(name, 0);
  return on_circle(2 * std::sqrt(u * (1 - u)), arguments.uniform_of(name, 1), 2 * u - 1);
}

}  // namespace

void RandomHash::add_word(std::uint64_t word) noexcept {
  hash_ = render::mix_bits((hash_ ^ word) + 0x9E3779B97F4A7C15u);
}

void RandomHash::add_bits(double number) noexcept {
  add_word(number == 0 ? 0 : std::bit_cast<std::uint64_t>(number));
}

RandomHash& RandomHash::add_number(double number) noexcept {
  add_word(kNumber);
  add_bits(number);
  return *this;
}

RandomHash& RandomHash::add_bool(bool flag) noexcept {
  add_word(kBool);
  add_word(flag ? 1 : 0);
  return *this;
}

RandomHash& RandomHash::add_string(std::string_view text) noexcept {
  add_word(kString);
  add_word(text.size());
  for (std::size_t start = 0; start < text.size(); start += 8) {
    std::uint64_t word = 0;
    int shift = 0;
    for (const char byte : text.substr(start, 8)) {
      word |= std::uint64_t{static_cast<unsigned char>(byte)} << shift;
      shift += 8;
    }
    add_word(word);
  }
  return *this;
}

RandomHash& RandomHash::add_vec3(render::Vec3 v) noexcept {
  add_word(kVec3);
  add_bits(v.x);
  add_bits(v.y);
  add_bits(v.z);
  return *this;
}

RandomHash& RandomHash::add_angle(double degrees) noexcept {
  add_word(kAngle);
  add_bits(degrees);
  return *this;
}

double noise(render::Vec3 p) noexcept {
  const RandomHash hash = RandomHash().add_string("noise");
  const auto corner = [&](double x, double y, double z) {
    return 2 * RandomHash(hash).add_number(x).add_number(y).add_number(z).uniform() - 1;
  };
  const render::Vec3 low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const render::Vec3 t{fade(p.x - low.x), fade(p.y - low.y), fade(p.z - low.z)};
  const auto along_x = [&](double y, double z) {
    return mix(corner(low.x, y, z), corner(low.x + 1, y, z), t.x);
  };
  const auto along_y = [&](double z) { return mix(along_x(low.y, z), along_x(low.y + 1, z), t.y); };
  return mix(along_y(low.z), along_y(low.z + 1), t.z);
}

double noise(render::Vec3 p, int octaves) noexcept {
  // Its multiples are not near whole numbers, and far enough apart that octaves share no corners.
  constexpr render::Vec3 kShift{101.618, 57.414, 211.732};
  double sum = 0, weights = 0, weight = 1;
  for (int k = 0; k < octaves; ++k) {
    sum += weight * noise(p / weight + kShift * k);
    weights += weight;
    weight /= 2;
  }
  return sum / weights;
}

render::Vec3 random_in_disc(const RandomHash& arguments) noexcept {
  constexpr std::string_view kName = "random_in_disc";
  const double radius = std::sqrt(arguments.uniform_of(kName, 0));
  return on_circle(radius, arguments.uniform_of(kName, 1), 0);
}

render::Vec3 random_on_sphere(const RandomHash& arguments) noexcept {
  return on_sphere(arguments, "random_on_sphere");
}

render::Vec3 random_in_sphere(const RandomHash& arguments) noexcept {
  constexpr std::string_view kName = "random_in_sphere";
  const double u = arguments.uniform_of(kName, 2);
  const double radius = u == 0 ? 0 : power(u, 1 / 3.0);
  return on_sphere(arguments, kName) * radius;
}

double random_normal(const RandomHash& arguments) noexcept {
  constexpr std::string_view kName = "random_normal";
  const double u = arguments.uniform_of(kName, 0);  // below 1
  const double radius = std::sqrt(-2 * log(1 - u).value_or(0));
  return radius * cos_degrees(kTurn * arguments.uniform_of(kName, 1));
}

}  // namespace sdlc::lang
