#include "lang/lower/background.hpp"

#include "lang/schema/schema.hpp"

namespace sdlc::lang {

using namespace background_property;

void lower_background(const Object& object, DiagnosticSink& sink, render::Background& background) {
  const auto is_written = [&](std::size_t property) { return object.slot(property).is_written; };
  const bool has_ends = is_written(kBottom) || is_written(kTop);
  if (is_written(kColor) && has_ends) {
    sink.report(diag::not_together, object.location(is_written(kBottom) ? kBottom : kTop),
                "`color`", "`bottom` or `top`")
        .label(object.location(kColor), "`color` is the same radiance from everywhere");
    return;
  }
  if (const auto color = object.get<render::LinearRgb>(kColor)) {
    background = {.bottom = *color, .top = *color};
    return;
  }
  if (!has_ends) {
    if (!is_written(kColor) && !object.is_broken) {
      sink.report(diag::missing, object.where, "background", "color")
          .help("give a `color`, or `bottom` and `top`");
    }
    return;
  }
  for (const std::size_t end : {kBottom, kTop}) {
    if (is_written(end) || object.is_broken) continue;
    sink.report(diag::missing, object.where, "background", object.kind->properties[end].name)
        .help("a gradient has both a `bottom` and a `top`");
  }
  const auto bottom = object.get<render::LinearRgb>(kBottom);
  const auto top = object.get<render::LinearRgb>(kTop);
  if (bottom && top) background = {.bottom = *bottom, .top = *top};
}

}  // namespace sdlc::lang
