#include "lang/eval/type_hints.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/ascii.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/value/colors.hpp"

namespace sdlc::lang {
namespace {

Location end_of(ast::Node node) { return node.tree().location({node.span().end, node.span().end}); }

bool is_literal_number(ast::Node node) {
  if (node.is(SyntaxKind::Number)) return true;
  const auto operand = node.is(SyntaxKind::Negative) ? node.child(0) : std::nullopt;
  return operand && operand->is(SyntaxKind::Number);
}

void hint_angle(DiagnosticBuilder& report, const Value& given, ast::Node written) {
  if (!holds_alternative<Scalar>(given)) return;
  if (is_literal_number(written)) {
    report.unsafe_fix(end_of(written), "deg");
  } else {
    report.help("an angle needs a unit: `40deg`, or `(…) * 1deg`");
  }
}

void hint_angles(DiagnosticBuilder& report, const Value& given, ast::Node written) {
  report.help("write three angles, about the x, y and z axes: `(0deg, 30deg, 0deg)`");
  if (!holds_alternative<Triple>(given) || !written.is(SyntaxKind::Triple)) return;
  for (const ast::Node component : written.children()) {
    if (is_literal_number(component)) report.unsafe_fix(end_of(component), "deg");
  }
}

bool is_color(std::string_view text) {
  if (text.starts_with('#')) {
    text.remove_prefix(1);
    return (text.size() == 3 || text.size() == 6) && std::ranges::all_of(text, is_hex_digit);
  }
  return find_named_color(text).has_value();
}

bool is_word(std::string_view text) {
  return !text.empty() && end_of_identifier(text, 0) == text.size();
}

/// Whether the file declares the name, as a value or a parameter.
bool declares(const SyntaxTree& tree, std::string_view name) {
  return std::ranges::any_of(tree.nodes(), [&](const SyntaxNode& node) {
    if (node.kind == SyntaxKind::Name) return tree.text(node.span()) == name;
    return node.kind == SyntaxKind::Parameter &&
           tree.text({node.begin, node.begin + node.head}) == name;
  });
}

void hint_color(DiagnosticBuilder& report, const Value& given, ast::Node written) {
  if (const auto* text = get_if<std::string>(&given)) {
    const bool is_written = written.is(SyntaxKind::String) && is_color(*text);
    if (is_written) {
      report.help("a colour is written without quotes");
      // A declaration of the file may hide the colour of this name.
      declares(written.tree(), *text) ? report.unsafe_fix(written.location(), *text)
                                      : report.fix(written.location(), *text);
      return;
    }
  }
  if (holds_alternative<Triple>(given)) {
    report.help(
        "write `rgb(r, g, b)` with sRGB values from 0 to 255, or `linear(r, g, b)` where 1 is "
        "white");
    return;
  }
  report.help("a colour is `#ff8000`, `rgb(255, 128, 0)` or a CSS name such as `tomato`");
}

void hint_material(DiagnosticBuilder& report, const Value& given, ast::Node written) {
  if (holds_alternative<render::LinearRgb>(given)) {
    report.unsafe_fix(written.location(), fmt::format("diffuse(color: {})", written.text()));
  } else {
    report.help(
        "a material is `diffuse(color: …)`, `specular`, `transmissive`, `emissive` or `unlit`");
  }
}

void hint_triple(DiagnosticBuilder& report, const Value& given, ast::Node written) {
  const auto* list = get_if<ListValue>(&given);
  const bool is_point = list != nullptr && list->size() == 3 && written.is(SyntaxKind::List);
  if (!is_point) return;
  const std::string_view text = written.text();
  report.help("a point is written in parentheses: `(x, y, z)`")
      .fix(written.location(), fmt::format("({})", text.substr(1, text.size() - 2)));
}

void hint_interval(DiagnosticBuilder& report, Type wanted) {
  report.help(wanted == Type::Frames ? "write two whole numbers: `1 .. 48`"
                                     : "write two times: `0s .. 20ms`");
}

}  // namespace

void add_type_hint(DiagnosticBuilder& report, const Property& property, const Value& given,
                   ast::Node written) {
  const Type wanted = property.type;
  const auto* text = get_if<std::string>(&given);
  switch (wanted) {
    case Type::Angle: return hint_angle(report, given, written);
    case Type::Angles: return hint_angles(report, given, written);
    case Type::Color: return hint_color(report, given, written);
    case Type::Material: return hint_material(report, given, written);
    case Type::Vec3: return hint_triple(report, given, written);
    case Type::Frames:
    case Type::Interval: return hint_interval(report, wanted);
    case Type::Motion: report.help("a motion is `line(to: (1, 0, 0), over: 0s .. 1s)`"); return;
    case Type::Focus:
    case Type::Word:
      if (text != nullptr && written.is(SyntaxKind::String) && is_word(*text)) {
        report.help("the word is written without quotes");
        if (property.words.empty() || std::ranges::count(property.words, *text) > 0) {
          report.fix(written.location(), *text);
        }
      }
      if (!property.words.empty()) {
        report.help(fmt::format("it takes {}", fmt::join(property.words, ", ")));
      }
      return;
    default: return;
  }
}

std::string as_range(ast::Node interval, const Bounds& bounds) {
  const std::string_view from = interval.child(0)->text(), to = interval.child(1)->text();
  const bool is_literal = to == to_text(bounds.to);
  return fmt::format("range({}, {})", from,
                     is_literal ? to_text(bounds.to + 1) : fmt::format("{} + 1", to));
}

}  // namespace sdlc::lang
