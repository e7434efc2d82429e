#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/frames.hpp"
#include "cli/inspect_report.hpp"
#include "cli/kernel_options.hpp"
#include "cli/numbers/format_numbers.hpp"
#include "lang/report/report.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/tone.hpp"
#include "render/scene/depth_of_field.hpp"
#include "render/scene/instances.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::cli {
namespace {

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", format_whole(count), noun, count == 1 ? "" : "s");
}

std::string format_triple(double x, double y, double z) {
  return fmt::format("({}, {}, {})", format_rounded(x), format_rounded(y), format_rounded(z));
}
std::string format_triple(render::Vec3 v) { return format_triple(v.x, v.y, v.z); }
std::string linear(render::LinearRgb c) { return "linear" + format_triple(c.r, c.g, c.b); }

/// The name, or `otherwise` if it is empty.
std::string name_or(const std::string& name, std::string_view otherwise) {
  return name.empty() ? std::string(otherwise) : lang::printable(name);
}

/// Rows with a label and a text.
class Sheet {
 public:
  void row(std::string_view label, std::string_view text) {
    text_ += fmt::format("{:<{}}{}\n", label, kLabelWidth, text);
  }
  void detail(std::string_view label, std::string_view text) {
    row(fmt::format("  {}", label), text);
  }
  void gap() { text_ += '\n'; }

  std::string take() { return std::move(text_); }

 private:
  static constexpr int kLabelWidth = 16;

  std::string text_;
};

void write_files(const InspectReport& report, Sheet& sheet) {
  std::string text = lang::printable(report.scene);
  if (!report.dependencies.empty()) {
    text += fmt::format(", which reads {}", counted(report.dependencies.size(), "other file"));
  }
  sheet.row("scene", text);
  if (report.errors > 0) {
    sheet.detail("incomplete", fmt::format("{}; the report excludes the invalid parts",
                                           counted(report.errors, "error")));
  }
  if (!report.animation) return;
  const auto& [first, last, step, fps, where] = *report.animation;
  const auto count = frame_count({.first = first, .last = last, .step = step});
  sheet.row("animation", fmt::format("{}: {} .. {}{}, {} per second",
                                     counted(static_cast<std::size_t>(count), "frame"), first, last,
                                     step == 1 ? "" : fmt::format(" in steps of {}", step),
                                     format_rounded(fps)));
  sheet.detail("shown",
               fmt::format("frame {}, at {} s", report.frame, format_rounded(report.frame / fps)));
}

std::string radius(const SphereFigures::Radius& of) {
  return fmt::format("{} ({})", format_rounded(of.radius),
                     of.sphere ? fmt::format("sphere {}", *of.sphere) : "of an instance");
}

void write_spheres(const InspectReport& report, Sheet& sheet) {
  const std::size_t dropped = report.lowered.dropped_spheres;
  if (!report.spheres) {
    const bool is_plain = !report.lowered.camera && report.errors == 0;
    sheet.row("spheres", is_plain ? "none: a plain picture" : "none");
    return;
  }
  const SphereFigures& figures = *report.spheres;
  const render::Scene& scene = report.lowered.scene;
  std::string text = format_whole(render::count_spheres(scene));
  if (figures.moving > 0) text += fmt::format(", {} of them moving", format_whole(figures.moving));
  if (dropped > 0) {
    text += fmt::format("; {} more dropped as {}", format_whole(dropped),
                        dropped == 1 ? "a duplicate" : "duplicates");
  }
  sheet.row("spheres", text);
  if (!scene.instances.empty()) {
    sheet.detail("instances", fmt::format("{} of {}, and {}", format_whole(scene.instances.size()),
                                          counted(scene.prototypes.size(), "prototype"),
                                          counted(scene.spheres.size(), "plain sphere")));
  }
  sheet.detail("bounds",
               fmt::format("{} to {}{}", format_triple(figures.low), format_triple(figures.high),
                           figures.moving > 0 ? ", while the shutter is open" : ""));
  sheet.detail("radii",
               fmt::format("{} to {}, ratio {}", radius(figures.smallest), radius(figures.largest),
                           format_rounded(figures.radius_ratio())));
  if (!report.lowered.camera) return;
  sheet.detail("extent",
               fmt::format("{} from the camera, {} smallest radii", format_rounded(figures.extent),
                           format_rounded(figures.scale_ratio())));
}

void write_materials(const MaterialCounts& counts, Sheet& sheet) {
  std::size_t distinct = 0, widest = 0;
  for (const MaterialFigures& row : counts) {
    distinct += row.materials;
    widest = std::max(widest, counted(row.spheres, "sphere").size());
  }
  if (distinct == 0) return;
  sheet.row("materials", fmt::format("{} distinct", format_whole(distinct)));
  for (const MaterialFigures& row : counts) {
    if (row.spheres == 0) continue;
    sheet.detail(material_name(row.type),
                 fmt::format("{:<{}}  {} distinct", counted(row.spheres, "sphere"), widest,
                             format_whole(row.materials)));
  }
}

/// "aperture 0.1, focus at 10, sharp from 9.55 to 10.5 (blur within a pixel)"
std::string describe_lens(const render::Camera& camera, int height) {
  std::string text = fmt::format("aperture {}, focus at {}", format_rounded(camera.aperture),
                                 format_rounded(camera.focus));
  if (height <= 0) return text;
  const render::DepthOfField sharp = render::depth_of_field(camera, height, 1);
  return text + fmt::format(", sharp from {} (blur within a pixel)", describe(sharp));
}

void write_camera(const lang::LoweredScene& lowered, Sheet& sheet) {
  if (!lowered.camera) {
    if (render::count_spheres(lowered.scene) > 0) sheet.row("camera", "none");
    return;
  }
  const lang::WrittenCamera& chosen = *lowered.camera;
  std::string text = name_or(chosen.name, "without a name");
  if (lowered.cameras.size() > 1) {
    std::vector<std::string> names;
    for (const std::string& name : lowered.cameras) names.push_back(name_or(name, "one unnamed"));
    text += fmt::format(", chosen of {}", fmt::join(names, ", "));
  }
  sheet.row("camera", text);
  const render::Camera& camera = lowered.scene.camera;
  sheet.detail("from", format_triple(camera.from));
  sheet.detail("at", format_triple(camera.at));
  std::string fov = format_rounded(chosen.fov.degrees) + "deg";
  if (chosen.view_height != 2) fov += ", view_height " + format_rounded(chosen.view_height);
  sheet.detail("fov", fov);
  if (camera.has_lens()) sheet.detail("lens", describe_lens(camera, lowered.settings.height));
  sheet.detail("shutter", chosen.shutter ? fmt::format("open from {} s to {} s",
                                                       format_rounded(chosen.shutter->from),
                                                       format_rounded(chosen.shutter->to))
                                         : "none: nothing moves");
}

/// "an error of 1% or 10.0 s, whichever comes first"
std::string describe_goals(const render::RenderSettings& settings) {
  std::vector<std::string> goals;
  if (settings.error) {
    goals.push_back(fmt::format("an error of {}%", format_rounded(100 * *settings.error)));
  }
  if (settings.seconds) goals.push_back(format_seconds(*settings.seconds));
  return fmt::format("{}{}{}", fmt::join(goals, " or "),
                     goals.size() > 1 ? ", whichever comes first" : "",
                     settings.is_adaptive ? ", more samples where there is more noise" : "");
}

/// The settings that are numbers and those that are choices: "depth 16, seed 0", "sobol, light
/// sampling auto".
std::array<std::string, 2> describe_settings(const render::RenderSettings& settings) {
  std::array<std::vector<std::string>, 2> parts;
  render::for_each_setting([&]<typename T>(const render::Setting<T>& setting) {
    const std::string_view space = setting.label.empty() ? "" : " ";
    parts[render::Choice<T>].push_back(
        fmt::format("{}{}{}", setting.label, space, render::shown(settings.*setting.member)));
  });
  return {fmt::format("{}", fmt::join(parts[0], ", ")),
          fmt::format("{}", fmt::join(parts[1], ", "))};
}

void write_picture(const InspectReport& report, Sheet& sheet) {
  const render::Background& background = report.lowered.scene.background;
  sheet.row("background", background.is_constant()
                              ? linear(background.bottom)
                              : fmt::format("gradient, bottom {}, top {}",
                                            linear(background.bottom), linear(background.top)));
  const render::RenderSettings& settings = report.lowered.settings;
  const std::string size = settings.width > 0
                               ? fmt::format("{} x {} pixels", settings.width, settings.height)
                               : "of unknown size";
  const bool has_goal = settings.error || settings.seconds;
  const auto [numbers, choices] = describe_settings(settings);
  sheet.row("picture", fmt::format("{}, {}{}, {}, tone {}", size, has_goal ? "at most " : "",
                                   counted(static_cast<std::size_t>(settings.samples), "sample"),
                                   numbers, describe(report.lowered.output.mapping)));
  const std::string& chosen = report.kernel.light_choice;
  sheet.detail("sampling", chosen.empty() ? choices : fmt::format("{} ({})", choices, chosen));
  if (has_goal) sheet.detail("until", describe_goals(settings));
  sheet.detail("output",
               report.output ? lang::printable(*report.output) : "no name: `render` needs -o OUT");
}

/// "accepted: a hit is off by … (sphere 3, at ball.scene:4:1)"
std::string describe_bounds(const PrecisionFigures& figures) {
  const render::PrecisionClause clause = figures.bounds.deciding();
  const render::PrecisionBound& bound = figures.bounds[clause];
  std::string text = figures.bounds.is_accepted() ? "accepted" : "refused";
  if (!figures.exact_spheres.empty()) {
    text += fmt::format(", {} met in double", counted(figures.exact_spheres.size(), "sphere"));
  }
  text += ": " + describe(clause, bound);
  std::vector<std::string> spheres;
  for (const auto& [sphere, where] : figures.deciding) {
    const std::string place = where.file != nullptr ? " at " + lang::describe_place(where) : "";
    spheres.push_back(fmt::format("sphere {}{}", sphere, place));
  }
  return spheres.empty() ? text : fmt::format("{} ({})", text, fmt::join(spheres, ", "));
}

void write_requirements(const InspectReport& report, Sheet& sheet) {
  sheet.row("requires", report.features.empty()
                            ? "nothing special"
                            : fmt::format("{}", fmt::join(report.features, ", ")));
  sheet.detail("kernel", fmt::format("{} precision, {}, for {} ({})",
                                     name_of(report.kernel.precision), name_of(report.kernel),
                                     instruction_set(report.kernel), reason_for(report.kernel)));
  for (const PrecisionFigures& figures : report.precisions) {
    sheet.detail(name_of(figures.precision), describe_bounds(figures));
  }
}

void write_memory(const InspectReport& report, Sheet& sheet) {
  const MemoryFigures& memory = report.memory;
  const std::uint64_t count = render::count_spheres(report.lowered.scene);
  std::string text = format_bytes(memory.total());
  if (count > 0) text += fmt::format(", {:.0f} B per sphere", memory.per_sphere(count));
  sheet.row("memory", text);
  if (count > 0) {
    sheet.detail("spheres", format_bytes(memory.spheres));
    if (memory.instances > 0) sheet.detail("instances", format_bytes(memory.instances));
    if (memory.motion > 0) sheet.detail("motion", format_bytes(memory.motion));
    sheet.detail("materials", format_bytes(memory.materials));
    sheet.detail("hierarchy", format_bytes(memory.bvh) + ", estimated without building it");
  }
  sheet.detail("picture", format_bytes(memory.picture));
}

}  // namespace

std::string to_text(const InspectReport& report) {
  Sheet sheet;
  write_files(report, sheet);
  sheet.gap();
  write_spheres(report, sheet);
  write_materials(report.materials, sheet);
  sheet.gap();
  write_camera(report.lowered, sheet);
  write_picture(report, sheet);
  sheet.gap();
  write_requirements(report, sheet);
  write_memory(report, sheet);
  sheet.row("time",
            fmt::format("{} to parse, {} to lower", format_seconds(report.times.parse_seconds),
                        format_seconds(report.times.lower_seconds)));
  return sheet.take();
}

std::string to_text(std::span<const TracedSphere> spheres) {
  std::string text;
  for (const TracedSphere& traced : spheres) {
    const std::string& name = traced.origin.name;
    text += fmt::format("sphere {}{}: center {}, radius {}, {}\n", traced.index,
                        name.empty() ? "" : fmt::format(" `{}`", lang::printable(name)),
                        format_triple(traced.sphere.center), format_rounded(traced.sphere.radius),
                        material_name(traced.material));
    if (traced.shift != render::Vec3{}) {
      text += fmt::format("  moves by {} while the shutter is open\n", format_triple(traced.shift));
    }
    text += fmt::format("  at {}\n", lang::describe_place(traced.origin.where));
    for (const lang::ChainLink& link : traced.origin.chain) {
      text += fmt::format("  {}, {}\n", lang::printable(link.message),
                          lang::describe_place(link.where));
    }
  }
  return text;
}

}  // namespace sdlc::cli
