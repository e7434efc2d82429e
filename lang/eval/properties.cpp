#include <string>

#include "lang/eval/evaluator.hpp"
#include "lang/eval/type_hints.hpp"
#include "lang/object/check.hpp"
#include "lang/value/logic.hpp"

// Evaluates properties: checks type and range, and finds changes while the shutter is open.
namespace sdlc::lang {
namespace {

/// Whether the kind's properties, such as the picture's width, must not depend on the time.
bool is_timeless(const Kind& kind) noexcept {
  return kind.id == ObjectKind::Render || kind.id == ObjectKind::Animation;
}

}  // namespace

Value Evaluator::property_value(const Code& code, const Property& property,
                                std::uint32_t expression) {
  Value value = evaluate(code, expression);
  if (is_nothing(value)) return {};
  const ast::Node written = node(code, expression);
  const bool is_none = property.reads_none && holds_alternative<None>(value);
  if (!is_none && !has_type(property.type, value)) {
    auto report = sink_.report(diag::wrong_type, written.location(), property.name,
                               describe(property.type), describe(value));
    add_type_hint(report, property, value, written);
    return {};
  }
  if (!check_property(property, value, written.location(), sink_)) return {};
  return value;
}

Value Evaluator::timeless_value(const Code& code, const Property& property,
                                std::uint32_t expression) {
  evaluate(code, expression);
  if (!reads_time_) return property_value(code, property, expression);
  reads_time_ = false;
  sink_.report(diag::depends_on_time, place(code, expression), property.name);
  return {};
}

void Evaluator::read_object(const Code& code, const Statement& statement, const Kind& kind,
                            std::span<const std::uint32_t> pairs) {
  const std::size_t used = object_.kind == nullptr ? 0 : object_.kind->properties.size();
  for (std::size_t i = 0; i < used; ++i) object_.slots[i] = {};
  object_.closing.clear();
  object_.kind = &kind;
  const ast::Object written{ast::Node(*code.tree, statement.node)};
  object_.where = written.kind_location();
  const auto name = written.name();
  object_.name = name ? name->text() : std::string_view();
  object_.is_broken = written.is_broken();

  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    const std::uint32_t property = pairs[i], expression = pairs[i + 1];
    steps_ += work::kProperty;
    if (property == kNothing) {
      evaluate(code, expression);
      continue;
    }
    Slot& slot = object_.slots[property];
    slot.is_written = true;
    slot.span = node(code, expression).span();
    reads_time_ = false;
    slot.value = is_timeless(kind) ? timeless_value(code, kind.properties[property], expression)
                                   : property_value(code, kind.properties[property], expression);
    if (reads_time_) read_changing(code, property, expression);
  }
}

void Evaluator::read_changing(const Code& code, std::size_t property, std::uint32_t expression) {
  const Kind& kind = *object_.kind;
  const Property& info = kind.properties[property];
  const bool is_center = kind.id == ObjectKind::Sphere && property == sphere_property::kCenter;
  const bool may_move =
      is_center || (kind.id == ObjectKind::Group && (property == group_property::kTranslate ||
                                                     property == group_property::kRotate));
  if (is_center) center_reads_time_ = true;
  const Value& opening = object_.slots[property].value;
  const bool is_shutter = kind.id == ObjectKind::Camera && property == camera_property::kShutter;
  if (!is_open_ || is_shutter || is_nothing(opening)) return;

  moment_ = 1;
  Value closing = property_value(code, info, expression);
  moment_ = 0;
  if (is_nothing(closing) || are_equal(closing, opening).value_or(false)) return;
  if (may_move) {
    object_.closing.push_back({property, std::move(closing)});
  } else {
    sink_.report(diag::changes_in_shutter, place(code, expression), info.name);
  }
}

Evaluator::Varying Evaluator::evaluate_over_shutter(const Code& code, std::uint32_t expression) {
  reads_time_ = false;
  Varying result;
  result.values[0] = evaluate(code, expression);
  result.reads_time = reads_time_;
  result.varies = reads_time_ && is_open_ && !is_nothing(result.values[0]);
  if (result.varies) {
    moment_ = 1;
    result.values[1] = evaluate(code, expression);
    moment_ = 0;
  }
  return result;
}

}  // namespace sdlc::lang
