#include <map>
#include <optional>
#include <string>

#include "lang/eval/evaluator.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/schema/find_kind.hpp"

// The cameras, background, render settings and animation of the root.
namespace sdlc::lang {
namespace {

/// The expression of a property in the code of an object; kNothing if it is not written.
std::uint32_t expression_of(const Code& code, const Statement& statement, std::size_t property) {
  const auto pairs = code.operands_of(statement);
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (pairs[i] == property) return pairs[i + 1];
  }
  return kNothing;
}

}  // namespace

void Evaluator::find_settings() {
  const Module& root = program_.module(Program::kRoot);
  std::map<std::string_view, Location> unique, cameras;
  const auto check_duplicate = [&](std::map<std::string_view, Location>& known,
                                   std::string_view what, std::string_view name, Location where) {
    const auto [first, is_new] = known.try_emplace(name, where);
    if (is_new) return;
    sink_.report(diag::duplicate, where, what, name).label(first->second, "first given here");
  };
  for (const ast::Node statement : ast::Node(root.tree, 0).children()) {
    if (!is_setting(root, statement)) continue;
    const ast::Object object{statement};
    const Kind* kind = find_kind(object.kind());
    settings_.push_back({kind, object});
    if (kind->is_unique) check_duplicate(unique, "object", kind->name, object.kind_location());
    // Cameras are chosen by name. Names of other objects are labels and need not be unique.
    const auto name = kind->id == ObjectKind::Camera ? object.name() : std::nullopt;
    if (name) check_duplicate(cameras, "camera", name->text(), name->location());
  }
}

Code Evaluator::resolve(const Setting& setting) {
  Code code(setting.node.node.tree());
  Resolver(program_, Program::kRoot, sink_).resolve_statement(setting.node.node, code);
  return code;
}

Value Evaluator::setting_value(const Setting& setting, std::size_t property) {
  const Code code = resolve(setting);
  const std::uint32_t expression = expression_of(code, code.statements.back(), property);
  if (expression == kNothing) return {};
  const Frame frame(*this, code, code.statements.back().node, code.frame_size);
  if (!frame.is_open()) return {};
  return property_value(code, setting.kind->properties[property], expression);
}

void Evaluator::find_animation() {
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Animation) continue;
    const Code code = resolve(setting);
    const Frame frame(*this, code, code.statements.back().node, code.frame_size);
    if (!frame.is_open()) return;
    read_object(code, code.statements.back(), *setting.kind,
                code.operands_of(code.statements.back()));
    const auto frames = object_.get<render::Interval>(animation_property::kFrames);
    const auto fps = object_.get<double>(animation_property::kFps);
    const auto step = object_.get<double>(animation_property::kStep);
    if (!frames || !fps || !step) return;
    animation_ = {.first = static_cast<int>(frames->from),
                  .last = static_cast<int>(frames->to),
                  .step = static_cast<int>(*step),
                  .fps = *fps,
                  .where = object_.where};
    return;
  }
}

std::optional<std::string> Evaluator::chosen_camera() {
  if (options_.camera) return options_.camera;
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Render) continue;
    const Value camera = setting_value(setting, render_property::kCamera);
    if (const auto* word = get_if<Word>(&camera)) return word->text;
  }
  return std::nullopt;
}

void Evaluator::find_shutter() {
  const auto name = chosen_camera();
  for (const Setting& setting : settings_) {
    if (setting.kind->id != ObjectKind::Camera) continue;
    const auto own_name = setting.node.name();
    if (name && (!own_name || own_name->text() != *name)) continue;
    const Value shutter = setting_value(setting, camera_property::kShutter);
    const auto interval = value_as<render::Interval>(shutter);
    if (!interval) return;
    const double time = times_[0];
    times_ = {time + interval->from, time + interval->to};
    is_open_ = true;
    shutter_ = render::Interval{times_[0], times_[1]};
    return;
  }
}

void Evaluator::run_settings() {
  for (const Setting& setting : settings_) {
    const Code code = resolve(setting);
    const Statement& statement = code.statements.back();
    const Frame frame(*this, code, statement.node, code.frame_size);
    if (!frame.is_open()) return;
    read_object(code, statement, *setting.kind, code.operands_of(statement));
    Slot& shutter = object_.slots[camera_property::kShutter];
    if (setting.kind->id == ObjectKind::Camera && shutter_ &&
        holds_alternative<Bounds>(shutter.value)) {
      shutter.value = Bounds{shutter_->from, shutter_->to, Unit::Time};
    }
    objects_->add(object_);
  }
}

}  // namespace sdlc::lang
