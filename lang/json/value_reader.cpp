#include "lang/json/value_reader.hpp"

#include <algorithm>
#include <charconv>

#include "lang/object/check.hpp"
#include "render/math/color.hpp"
#include "render/math/interval.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {
namespace {

/// Whether the content of a string is a value of the type, so that only the quotes are wrong.
bool is_quoted_value(std::string_view wanted, std::string_view content) {
  if (wanted == describe(JsonType::Bool)) return content == "true" || content == "false";
  const bool wants_number =
      wanted.find("number") != std::string_view::npos && !wanted.ends_with(']');
  const bool looks_like_number =
      !content.empty() &&
      (content.front() == '-' || (content.front() >= '0' && content.front() <= '9'));
  if (!wants_number || !looks_like_number) return false;
  double number = 0;
  const char* end = content.data() + content.size();
  const auto result = std::from_chars(content.data(), end, number);
  return result.ec == std::errc() && result.ptr == end;
}

}  // namespace

void ValueReader::diagnose_type(std::string_view key, std::string_view wanted,
                                const JsonNode& node) {
  const bool is_bare_word = node.type == JsonNodeType::String && node.quote_size == 0;
  if (node.type == JsonNodeType::Error || is_bare_word) return;  // has been reported
  auto report = sink_->report(diag::wrong_type, at(node.span), key, wanted, describe(node));
  if (node.type != JsonNodeType::String) return;
  const std::string_view content = file_->text(node.content());
  if (is_quoted_value(wanted, content)) report.fix(at(node.span), std::string(content));
}

Value ValueReader::read(const JsonKey& key, const Tape& tape, std::uint32_t index) {
  const JsonNode& node = tape[index];
  switch (key.type) {
    case JsonType::Number:
    case JsonType::Degrees: {
      const auto number = read_number(key.key, describe(key.type), key.range, node);
      if (!number) return {};
      return key.type == JsonType::Number ? Value(Scalar{*number}) : Value(Angle{*number});
    }
    case JsonType::WholeNumber: return read_whole_number(key, node);
    case JsonType::Bool: return read_bool(key.key, node);
    case JsonType::String: {
      auto text = read_string(key.key, tape, index);
      return text ? Value(std::move(*text)) : Value();
    }
    case JsonType::Triple: return read_triple(key, tape, index);
    case JsonType::Color: return read_color(key, tape, index);
    case JsonType::Interval: return read_interval(key, tape, index);
    case JsonType::Movement: return read_movement(key, tape, index);
    case JsonType::Object:
    case JsonType::Material:
    case JsonType::Spheres: break;
  }
  return {};
}

std::optional<double> ValueReader::read_number(std::string_view key, std::string_view wanted,
                                               Range range, const JsonNode& node) {
  if (node.type != JsonNodeType::Number) {
    diagnose_type(key, wanted, node);
    return std::nullopt;
  }
  if (!check_range(key, range, node.number, at(node.span), *sink_)) return std::nullopt;
  return node.number;
}

bool ValueReader::is_array_of(std::string_view key, JsonType type, std::size_t size,
                              const Tape& tape, std::uint32_t index) {
  const JsonNode& node = tape[index];
  if (node.type != JsonNodeType::Array) {
    diagnose_type(key, describe(type), node);
    return false;
  }
  if (!node.is_complete) return false;
  const std::size_t found = count_elements(tape, index);
  if (found == size) return true;
  sink_->report(diag::wrong_length, at(node.span), key, describe(type), found);
  return false;
}

bool ValueReader::read_numbers(const JsonKey& key, JsonType type, const Tape& tape,
                               std::uint32_t array, std::span<double> numbers) {
  if (!is_array_of(key.key, type, numbers.size(), tape, array)) return false;
  bool is_good = true;
  std::uint32_t element = array + 1;
  for (double& number : numbers) {
    const auto value = read_number(key.key, describe(JsonType::Number), key.range, tape[element]);
    is_good &= value.has_value();
    number = value.value_or(0);
    element = tape[element].next;
  }
  return is_good;
}

Value ValueReader::read_whole_number(const JsonKey& key, const JsonNode& node) {
  const auto number = read_number(key.key, describe(JsonType::WholeNumber), Range::Any, node);
  if (!number || !check_whole_number(key.key, key.range, *number, at(node.span), *sink_)) return {};
  return Scalar{*number};
}

Value ValueReader::read_bool(std::string_view key, const JsonNode& node) {
  if (node.type == JsonNodeType::Bool) return node.number != 0;
  diagnose_type(key, describe(JsonType::Bool), node);
  return {};
}

std::optional<std::string> ValueReader::read_string(std::string_view key, const Tape& tape,
                                                    std::uint32_t index) {
  const JsonNode& node = tape[index];
  if (node.type != JsonNodeType::String) {
    diagnose_type(key, describe(JsonType::String), node);
    return std::nullopt;
  }
  const std::string_view content = file_->text(node.content());
  std::string text = node.has_escapes ? unescape(content) : std::string(content);
  if (text.find('\0') == std::string::npos) return text;
  // C interfaces would silently end the string there.
  sink_->report(diag::bad_string, at(node.span), "a NUL character");
  return std::nullopt;
}

Value ValueReader::read_triple(const JsonKey& key, const Tape& tape, std::uint32_t node) {
  std::array<double, 3> v{};
  if (!read_numbers(key, key.type, tape, node, v)) return {};
  return Triple{{v[0], v[1], v[2]}};
}

Value ValueReader::read_color(const JsonKey& key, const Tape& tape, std::uint32_t node) {
  constexpr double kWhite = 255;
  std::array<double, 3> c{};
  if (!read_numbers(key, key.type, tape, node, c)) return {};
  return render::LinearRgb{c[0] / kWhite, c[1] / kWhite, c[2] / kWhite};
}

Value ValueReader::read_interval(const JsonKey& key, const Tape& tape, std::uint32_t node) {
  std::array<double, 2> ends{};
  if (!read_numbers(key, key.type, tape, node, ends)) return {};
  return Bounds{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

Value ValueReader::read_movement(const JsonKey& key, const Tape& tape, std::uint32_t index) {
  if (!is_array_of(key.key, key.type, 3, tape, index)) return {};
  const std::uint32_t target = index + 1;
  const std::uint32_t from = tape[target].next;
  const std::uint32_t to = tape[from].next;
  const auto number = describe(JsonType::Number);

  std::array<double, 3> v{};
  const bool has_target = read_numbers(key, JsonType::Triple, tape, target, v);
  const auto t0 = read_number(key.key, number, key.range, tape[from]);
  const auto t1 = read_number(key.key, number, key.range, tape[to]);
  if (t0 && t1 && *t0 == *t1) {
    sink_->report(diag::empty_interval, at({tape[from].span.begin, tape[to].span.end}), key.key,
                  to_text(*t0));
    return {};
  }
  if (!has_target || !t0 || !t1) return {};
  return MotionValue{.to = {v[0], v[1], v[2]}, .over = {*t0, *t1}};
}

}  // namespace sdlc::lang
