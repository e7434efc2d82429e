#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "lang/lower/settings.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"
#include "render/image/image_format.hpp"

namespace sdlc::lang {
namespace {

/// Why a picture of this size cannot be saved under the name; empty if it can.
std::string refusal_of(const std::string& name, const render::RenderSettings& settings) {
  std::string refusal = render::refusal_of_name(name);
  if (!refusal.empty()) return refusal;
  return render::refusal_of_size(settings.width, settings.height, *render::image_format_of(name));
}

void report_bad_output(const std::string& name, const std::string& refusal, Location where,
                       DiagnosticSink& sink) {
  std::string extension = std::filesystem::path(name).extension().string();
  if (!extension.empty()) extension.erase(0, 1);
  const auto nearest = render::image_format_of(name)
                           ? std::nullopt
                           : nearest_name(extension, render::image_extensions());
  // In a string literal, mark only the extension.
  const bool is_literal = nearest && where.file->text(where.span).ends_with(extension + '"');
  if (is_literal) {
    --where.span.end;
    where.span.begin = where.span.end - static_cast<std::uint32_t>(extension.size());
  }
  auto report = sink.report(diag::bad_output, where, abbreviated(name), refusal);
  if (is_literal) report.suggest(nearest);
  if (nearest && !is_literal) report.help(fmt::format("did you mean `.{}`?", *nearest));
}

}  // namespace

void check_output(const WantedSettings& wanted, bool is_animated, const LoweredScene& lowered) {
  const auto name = wanted.render.get<std::string>(render_property::kOutput);
  if (!name) return;
  const Location where = wanted.render.location(render_property::kOutput);
  const std::string refusal = refusal_of(*name, lowered.settings);
  if (!refusal.empty()) {
    report_bad_output(*name, refusal, where, wanted.sink);
  } else if (is_animated && name->find("####") == std::string::npos) {
    wanted.sink.report(diag::no_frame_number, where, *name);
  }
}

}  // namespace sdlc::lang
