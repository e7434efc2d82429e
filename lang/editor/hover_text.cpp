#include "lang/editor/hover_text.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/editor/value_text.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// The first lines of the code.
std::string shortened(std::string_view code) {
  constexpr std::size_t kMaxLines = 8, kMaxBytes = 600;
  std::size_t end = std::min(code.size(), kMaxBytes), line = 0;
  for (std::size_t lines = 0; lines < kMaxLines && line != std::string_view::npos; ++lines) {
    line = code.find('\n', line + (lines > 0 ? 1 : 0));
  }
  end = std::min(end, line);
  while (end < code.size() && end > 0 && is_continuation(code[end])) --end;
  return std::string(code.substr(0, end)) + (end < code.size() ? " …" : "");
}

}  // namespace

void HoverText::add_code(std::string_view code) {
  std::string text = shortened(code);
  std::erase(text, '\r');
  const std::string_view fence = text.find("```") == std::string::npos ? "```" : "````";
  add(fmt::format("{0}scene\n{1}\n{0}", fence, text));
}

void HoverText::add(std::string_view paragraph) {
  if (paragraph.empty()) return;
  if (!markdown_.empty()) markdown_ += "\n\n";
  markdown_ += paragraph;
}

std::string as_code(std::string_view text) {
  if (text.find('`') == std::string_view::npos) return fmt::format("`{}`", text);
  return fmt::format("`` {} ``", text);
}

std::string describe(const Property& property) {
  const std::string values = describe_values(property), usual = describe_default(property);
  if (usual.empty()) return values;
  const bool is_required = property.presence == Presence::Required;
  return fmt::format("{}; {}{}", values, is_required ? "" : "default ", usual);
}

ComputedValue as_value_of(const Property* property, ComputedValue computed) {
  const auto* number = get_if<Scalar>(&computed.value);
  const bool is_length = property != nullptr && property->type == Type::Length;
  if (is_length && number != nullptr && number->unit == Unit::None) {
    computed.value = Scalar{number->value, Unit::Length};
  }
  return computed;
}

std::string describe_value(const ComputedValue& computed, Values& values,
                           std::string_view written) {
  switch (computed.status) {
    case ComputedValue::Status::Wrong: return {};
    case ComputedValue::Status::Local:
      return fmt::format("The value depends on {}.", as_code(computed.local));
    case ComputedValue::Status::TooExpensive: return "The value takes too long to compute.";
    case ComputedValue::Status::Known: break;
  }
  const std::string value = short_text(computed.value);
  std::vector<std::string> spellings;
  if (value != written) spellings.push_back(as_code(value));
  for (const std::string& other : other_spellings(computed.value)) {
    if (other != written) spellings.push_back(as_code(other));
  }
  if (spellings.empty()) return {};
  std::string text = fmt::format("Value: {}", fmt::join(spellings, " = "));
  if (computed.reads_time) {
    text += fmt::format(" at {}, the time of the first frame",
                        as_code(to_text(Value(Scalar{values.time(), Unit::Time}))));
  }
  return text;
}

}  // namespace sdlc::lang
