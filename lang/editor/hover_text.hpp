#pragma once

#include <string>
#include <string_view>

#include "lang/editor/values.hpp"
#include "lang/schema/schema.hpp"

/// The parts of a hover.
namespace sdlc::lang {

/// Paragraphs of Markdown.
class HoverText {
 public:
  /// A fenced block, shortened if it is long.
  void add_code(std::string_view code);
  /// No effect if the text is empty.
  void add(std::string_view paragraph);

  bool is_empty() const noexcept { return markdown_.empty(); }
  std::string take() { return std::move(markdown_); }

 private:
  std::string markdown_;
};

/// Text in backticks.
std::string as_code(std::string_view text);
/// Type, range and default of a property: "a length, at least 0; required".
std::string describe(const Property& property);
/// The value as that of the property, which may be null: a number without a unit is a length too.
ComputedValue as_value_of(const Property* property, ComputedValue computed);
/// "Value: `1.5708`" in several units, or why there is none. Empty if the value has an error, or if
/// it says nothing new about `written`, the text of the expression.
std::string describe_value(const ComputedValue& computed, Values& values, std::string_view written);

}  // namespace sdlc::lang
