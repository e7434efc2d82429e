#include "lang/schema/schema.hpp"

namespace sdlc::lang {

std::string_view describe(Type type) noexcept {
  switch (type) {
    case Type::Number: return "a number";
    case Type::WholeNumber: return "a whole number";
    case Type::Bool: return "true or false";
    case Type::String: return "a string";
    case Type::Vec3: return "a point (x, y, z)";
    case Type::Length: return "a length";
    case Type::Angle: return "an angle";
    case Type::Angles: return "three angles";
    case Type::Color: return "a colour";
    case Type::Interval: return "an interval a .. b";
    case Type::Frames: return "an interval of frames";
    case Type::Focus: return "a point, the name of a sphere or a distance";
    case Type::Word: return "a word";
    case Type::Material: return "a material";
    case Type::Motion: return "a motion";
  }
  return "";
}

std::string_view describe(Range range) noexcept {
  switch (range) {
    case Range::Any: return "any value";
    case Range::NonNegative: return "at least 0";
    case Range::NonNegativeExact: return "from 0 to 9007199254740992";
    case Range::Positive: return "greater than 0";
    case Range::AtLeastOne: return "at least 1";
    case Range::ByteCode: return "from 0 to 255";
    case Range::Fraction: return "from 0 to 100%";
    case Range::PositiveFraction: return "greater than 0 and at most 100%";
    case Range::Kelvin: return "from 1667 to 25000";
    case Range::UpToHundred: return "from 0 to 100";
    case Range::Octaves: return "from 1 to 32";
    case Range::BetweenZeroAndHalfTurn: return "greater than 0 and less than 180 degrees";
  }
  return "";
}

}  // namespace sdlc::lang
