#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "lang/object/check.hpp"
#include "lang/schema/schema.hpp"
#include "render/kernel/backend.hpp"
#include "wasm/calls.hpp"

namespace sdlc::wasm {

lang::Overrides overrides_of(const Json& parameters) {
  lang::Overrides overrides{.names_output = true};
  const auto properties = lang::kind_info(lang::ObjectKind::Render).properties;
  const Json settings = parameters.value("render", Json::object());
  for (const auto& [name, value] : settings.items()) {
    const auto property = std::ranges::find(properties, name, &lang::Property::name);
    if (property == properties.end()) {
      throw WrongParameter(fmt::format("`render`: there is no setting `{}`", name));
    }
    const auto index = static_cast<std::size_t>(property - properties.begin());
    const lang::Override override = value.is_number()
                                        ? lang::Override(index, value.get<double>())
                                        : lang::Override(index, value.get<std::string>());
    lang::DiagnosticSink sink;
    if (!check_property(*property, override.value, {}, sink)) {
      throw WrongParameter(fmt::format("`render`: {}", sink.diagnostics().front().message));
    }
    overrides.render.push_back(override);
  }
  if (parameters.contains("seconds")) overrides.seconds = parameters.at("seconds").get<double>();
  overrides.is_adaptive = parameters.value("adaptive", false);
  overrides.is_denoised = parameters.value("denoise", false);
  if (const auto pose = parameters.find("pose"); pose != parameters.end()) {
    const auto point = [&](const char* name) {
      const auto numbers = pose->at(name).get<std::array<double, 3>>();
      return render::Vec3{numbers[0], numbers[1], numbers[2]};
    };
    overrides.pose = lang::CameraPose{.from = point("from"), .at = point("at")};
  }
  return overrides;
}

render::KernelRequest request_of(const Json& parameters) {
  const auto kernel = parameters.value("kernel", "auto");
  render::KernelRequest request;
  if (kernel == "scalar") request.backend = &render::portable_backend();
  if (kernel == "wide") request.search = render::Search::All;
  if (kernel == "bvh") request.search = render::Search::Bvh;
  return request;
}

}  // namespace sdlc::wasm
