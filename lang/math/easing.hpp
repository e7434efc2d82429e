#pragma once

#include <array>
#include <cstdint>
#include <string_view>

/// Easing: curves from 0 to 1 for motion, after Penner, Robert Penner's Programming Macromedia
/// Flash MX, 2002, chapter 7. The same bits on every machine.
namespace sdlc::lang {

enum class EaseCurve : std::uint8_t {
  Sine,     ///< 1 - cos(90deg t)
  Quad,     ///< t^2
  Cubic,    ///< t^3
  Quart,    ///< t^4
  Expo,     ///< (2^(10 t) - 1) / 1023
  Circ,     ///< 1 - sqrt(1 - t^2)
  Back,     ///< t^2 (t - 1.70158 (1 - t)): a tenth below 0 first
  Elastic,  ///< expo times cos(1200deg (1 - t)): swings with growing amplitude
  Bounce,   ///< arcs of a ball that bounces ever higher
};

/// The names of the curves, in their order.
inline constexpr std::array<std::string_view, 9> kEaseCurveNames{
    "sine", "quad", "cubic", "quart", "expo", "circ", "back", "elastic", "bounce"};

/// Precondition: one of the names.
EaseCurve find_ease_curve(std::string_view name) noexcept;

/// Exactly 0 for t <= 0 and exactly 1 for t >= 1.
double ease_in(EaseCurve curve, double t) noexcept;
/// 1 - ease_in(1 - t)
double ease_out(EaseCurve curve, double t) noexcept;
/// ease_in(2 t) / 2 up to the middle, then 1 - ease_in(2 - 2 t) / 2
double ease_in_out(EaseCurve curve, double t) noexcept;

}  // namespace sdlc::lang
