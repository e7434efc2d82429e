#include "lang/object/check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

bool is_in(Range range, double number) noexcept {
  switch (range) {
    case Range::Any: return true;
    case Range::NonNegative: return number >= 0;
    case Range::NonNegativeExact: return number >= 0 && number <= 0x1p53;
    case Range::Positive: return number > 0;
    case Range::AtLeastOne: return number >= 1;
    case Range::ByteCode: return number >= 0 && number <= 255;
    case Range::Fraction: return number >= 0 && number <= 1;
    case Range::PositiveFraction: return number > 0 && number <= 1;
    case Range::Kelvin: return number >= 1667 && number <= 25000;
    case Range::UpToHundred: return number >= 0 && number <= 100;
    case Range::Octaves: return number >= 1 && number <= 32;
    case Range::BetweenZeroAndHalfTurn: return number > 0 && number < 180;
  }
  return false;
}

}  // namespace

bool has_type(Type type, const Value& value) noexcept {
  const auto* scalar = get_if<Scalar>(&value);
  const auto* triple = get_if<Triple>(&value);
  const auto* bounds = get_if<Bounds>(&value);
  switch (type) {
    case Type::Number:
    case Type::WholeNumber: return scalar != nullptr && scalar->unit == Unit::None;
    case Type::Length: return scalar != nullptr && scalar->unit != Unit::Time;
    case Type::Bool: return holds_alternative<bool>(value);
    case Type::String: return holds_alternative<std::string>(value);
    case Type::Vec3: return triple != nullptr && triple->unit != Unit::Time;
    case Type::Angle: return holds_alternative<Angle>(value);
    case Type::Angles: return holds_alternative<AngleTriple>(value);
    case Type::Color: return holds_alternative<render::LinearRgb>(value);
    case Type::Frames: return bounds != nullptr && bounds->unit == Unit::None;
    case Type::Interval: return bounds != nullptr && bounds->unit != Unit::Length;
    case Type::Focus:
      return has_type(Type::Length, value) || has_type(Type::Vec3, value) ||
             holds_alternative<Word>(value);
    case Type::Word: return holds_alternative<Word>(value);
    case Type::Material: return holds_alternative<MaterialValue>(value);
    case Type::Motion: return holds_alternative<MotionValue>(value);
  }
  return false;
}

namespace {

bool check_color(std::string_view name, Range range, render::LinearRgb color, Location where,
                 DiagnosticSink& sink) {
  for (const double component : {color.r, color.g, color.b}) {
    if (!check_range(name, range, component, where, sink)) return false;
  }
  return true;
}

bool check_word(const Property& property, const Word& word, Location where, DiagnosticSink& sink) {
  const auto words = property.words;
  if (words.empty() || std::find(words.begin(), words.end(), word.text) != words.end()) return true;
  sink.report(diag::unknown_word, where, word.text, property.name)
      .suggest(nearest_name(word.text, words))
      .help(fmt::format("it takes {}", fmt::join(words, ", ")));
  return false;
}

}  // namespace

bool check_range(std::string_view name, Range range, double number, Location where,
                 DiagnosticSink& sink) {
  if (is_in(range, number)) return true;
  sink.report(diag::out_of_range, where, name, describe(range), to_text(number));
  return false;
}

bool check_whole_number(std::string_view name, Range range, double number, Location where,
                        DiagnosticSink& sink) {
  if (number != std::floor(number)) {
    auto report = sink.report(diag::not_whole, where, name, to_text(number));
    const bool has_functions = where.file != nullptr && where.file->format() == SourceFormat::Scene;
    if (has_functions) report.help("round it with `floor(…)` or `round(…)`");
    return false;
  }
  if (!check_range(name, range, number, where, sink)) return false;
  if (range == Range::NonNegativeExact || std::fabs(number) <= kMaxWholeNumber) return true;
  const bool is_large = number > 0;
  sink.report(diag::out_of_range, where, name,
              is_large ? "at most 1000000000" : "at least -1000000000", to_text(number));
  return false;
}

bool check_value(std::string_view name, Type type, Range range, const Value& value, Location where,
                 DiagnosticSink& sink) {
  if (is_nothing(value)) return false;
  if (!has_type(type, value)) {
    sink.report(diag::wrong_type, where, name, describe(type), describe(value));
    return false;
  }

  if (type == Type::WholeNumber) {
    return check_whole_number(name, range, get<Scalar>(value).value, where, sink);
  }
  if (const auto* scalar = get_if<Scalar>(&value)) {
    return check_range(name, range, scalar->value, where, sink);
  }
  if (const auto* angle = get_if<Angle>(&value)) {
    if (is_in(range, angle->degrees)) return true;
    sink.report(diag::out_of_range, where, name, describe(range), to_text(value));
    return false;
  }
  if (const auto* color = get_if<render::LinearRgb>(&value)) {
    return check_color(name, range, *color, where, sink);
  }
  if (type == Type::Frames) {
    const auto frames = get<Bounds>(value);
    const bool are_whole = check_whole_number(name, Range::NonNegative, frames.from, where, sink) &&
                           check_whole_number(name, Range::NonNegative, frames.to, where, sink);
    if (!are_whole || frames.from <= frames.to) return are_whole;
    sink.report(diag::no_frames, where, to_text(frames.to), to_text(frames.from));
    return false;
  }
  if (const auto* motion = get_if<MotionValue>(&value)) {
    if (motion->over.from != motion->over.to) return true;
    sink.report(diag::empty_interval, where, name, to_text(motion->over.from));
    return false;
  }
  return true;
}

bool check_property(const Property& property, const Value& value, Location where,
                    DiagnosticSink& sink) {
  if (property.reads_none && holds_alternative<None>(value)) return true;
  if (!check_value(property.name, property.type, property.range, value, where, sink)) return false;
  const auto* word = get_if<Word>(&value);
  return word == nullptr || check_word(property, *word, where, sink);
}

}  // namespace sdlc::lang
