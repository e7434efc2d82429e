#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/variant.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"
#include "render/math/color.hpp"
#include "render/math/interval.hpp"
#include "render/math/vec3.hpp"

/// The validated form that both formats are read into: values that have met their property's type
/// and range, each with its place in the text.
namespace sdlc::lang {

struct Angle {
  double degrees = 0;

  friend bool operator==(const Angle&, const Angle&) = default;
};

/// Angles about the three axes.
struct AngleTriple {
  render::Vec3 degrees;

  friend bool operator==(const AngleTriple&, const AngleTriple&) = default;
};

/// A name that stands for itself: `tone: sqrt`.
struct Word {
  std::string text;

  friend bool operator==(const Word&, const Word&) = default;
};

/// The word `none`, where a property reads it.
struct None {
  friend bool operator==(const None&, const None&) = default;
};

/// A material constructor with its arguments filled in.
struct MaterialValue {
  MaterialKind kind = MaterialKind::Diffuse;
  render::LinearRgb color;
  double parameter = 0;        ///< fuzz, ior or intensity, as the kind has it
  bool exact_fresnel = false;  ///< of transmissive

  friend bool operator==(const MaterialValue&, const MaterialValue&) = default;
};

/// Straight motion of a centre: at its own place at time over.from, at `to` at time over.to,
/// extrapolated.
struct MotionValue {
  render::Vec3 to;
  render::Interval over;  ///< seconds; the ends differ

  friend bool operator==(const MotionValue&, const MotionValue&) = default;
};

/// monostate: nothing is written, or what is written was wrong and has been reported.
using Value =
    Variant<std::monostate, double, bool, render::Vec3, Angle, AngleTriple, render::LinearRgb,
            render::Interval, None, MaterialValue, MotionValue, std::string, Word>;

/// "a number", "a colour": what a message calls the value.
std::string_view describe(const Value& value) noexcept;
/// The value as the language spells it, for messages ("-1", "40deg").
std::string to_text(const Value& value);
/// The shortest spelling that reads back as the same number.
std::string to_text(double number);

/// One property of an object as it was written.
struct Slot {
  Value value;
  Span span;                ///< of the value, in the object's file
  bool is_written = false;  ///< also when the value was wrong
};

/// The value of a property at the closing of the shutter.
struct ClosingValue {
  std::size_t property;
  Value value;
};

/// An object whose properties have been checked one by one; `slots` has one entry per row of the
/// kind's table.
struct Object {
  const Kind* kind = nullptr;
  Location
      where;  ///< of what names it in messages: the kind's name, or the object's first character
  std::string name;        ///< `main` of `camera main`; empty where there is none
  bool is_broken = false;  ///< something of it could not be read: what is missing may be that
  std::array<Slot, kMaxProperties> slots;
  /// What changes while the shutter is open, as it is at the closing; `slots` hold the opening.
  /// Only centres of spheres and translations and rotations of groups can (ruling 29).
  std::vector<ClosingValue> closing;

  const Slot& slot(std::size_t property) const { return slots[property]; }
  Location location(std::size_t property) const { return {where.file, slots[property].span}; }

  /// The value if it is a T (the written one, else the table's default).
  template <typename T>
  std::optional<T> get(std::size_t property) const;
  /// The value at the closing of the shutter.
  template <typename T>
  std::optional<T> get_closing(std::size_t property) const {
    for (const ClosingValue& changed : closing) {
      if (changed.property == property) return lang::get<T>(changed.value);
    }
    return get<T>(property);
  }
};

/// Receives checked objects one at a time, so that no reader has to hold all of them.
class ObjectSink {
 public:
  virtual ~ObjectSink() = default;

  /// There may be so many objects to come, not more: room for them need not be moved later.
  virtual void expect(std::size_t /*objects*/) {}

  /// An object of any kind. Its written values have passed check_value or are monostate; what it
  /// lacks has been reported.
  virtual void add(const Object& object) = 0;

  /// Whether nothing more is of use, as what is wrong with it has been reported.
  virtual bool is_full() const { return false; }

  /// What is added until leave() stands inside this group.
  virtual void enter(const Object& /*group*/) {}
  virtual void leave() {}

  /// Whether it is of use to know which groups hold the same.
  virtual bool wants_contents() const { return false; }
  /// The group entered just now is the first that holds the contents of this number.
  virtual void begin_contents(std::uint32_t /*contents*/) {}
  /// Those of this number will not be repeated.
  virtual void forget_contents(std::uint32_t /*contents*/) {}
  /// Does for `group` what enter(), all that the contents of this number were and leave() would do.
  /// False where it cannot, and has done nothing: they are then added once more.
  virtual bool repeat(const Object& /*group*/, std::uint32_t /*contents*/) { return false; }
};

/// The largest whole number of a property without Range::NonNegativeExact: such values count
/// pixels, samples, rays and threads, and fit an int.
inline constexpr double kMaxWholeNumber = 1e9;

/// Whether the number is in the range; if not, that is reported at `where` under the name `name`.
bool check_range(std::string_view name, Range range, double number, Location where,
                 DiagnosticSink& sink);

/// Whether the number is whole, in the range and at most kMaxWholeNumber (but for
/// NonNegativeExact); what is wrong is reported.
bool check_whole_number(std::string_view name, Range range, double number, Location where,
                        DiagnosticSink& sink);

/// Whether the value is of the C++ type that stands for the type of the table; its range aside.
bool has_type(Type type, const Value& value) noexcept;

/// Whether `value` has the property's type and is in its range; what is wrong is reported at
/// `where` under the name `name` (the JSON format has other names). A number serves as a length, a
/// whole number must be whole. monostate is wrong silently: it has been reported. None is never
/// right here: see check_property.
bool check_value(std::string_view name, Type type, Range range, const Value& value, Location where,
                 DiagnosticSink& sink);

/// The same by the property's row in its table, which also says whether `none` is a value and which
/// words are.
bool check_property(const Property& property, const Value& value, Location where,
                    DiagnosticSink& sink);

template <typename T>
std::optional<T> Object::get(std::size_t property) const {
  if (const T* value = get_if<T>(&slots[property].value)) return *value;
  if (slots[property].is_written) return std::nullopt;
  const Default& fallback = kind->properties[property].default_value;
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, bool>) {
    if (const T* value = get_if<T>(&fallback)) return *value;
  } else if constexpr (std::is_same_v<T, Word>) {
    if (const auto* word = get_if<std::string_view>(&fallback)) return Word{std::string(*word)};
  } else if constexpr (std::is_same_v<T, render::Vec3> || std::is_same_v<T, render::LinearRgb>) {
    if (const auto* triple = get_if<std::array<double, 3>>(&fallback)) {
      return T{(*triple)[0], (*triple)[1], (*triple)[2]};
    }
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
