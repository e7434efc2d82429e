#include "lang/eval/computed.hpp"

namespace sdlc::lang {
namespace {

struct Describe {
  std::string_view operator()(Failed) const { return "nothing"; }
  std::string_view operator()(Scalar scalar) const {
    switch (scalar.unit) {
      case Unit::None: return "a number";
      case Unit::Length: return "a length";
      case Unit::Time: return "a time";
    }
    return "";
  }
  std::string_view operator()(bool) const { return "true or false"; }
  std::string_view operator()(const std::string&) const { return "a string"; }
  std::string_view operator()(Triple triple) const {
    return triple.unit == Unit::Time ? "three times" : "a point (x, y, z)";
  }
  std::string_view operator()(Angle) const { return "an angle"; }
  std::string_view operator()(AngleTriple) const { return "three angles"; }
  std::string_view operator()(render::LinearRgb) const { return "a colour"; }
  std::string_view operator()(Bounds bounds) const {
    return bounds.unit == Unit::Length ? "an interval of lengths" : "an interval a .. b";
  }
  std::string_view operator()(const MaterialValue&) const { return "a material"; }
  std::string_view operator()(const MotionValue&) const { return "a motion"; }
};

}  // namespace

std::string_view describe(const Computed& value) noexcept { return std::visit(Describe(), value); }

}  // namespace sdlc::lang
