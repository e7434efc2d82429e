#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/amounts.hpp"
#include "cli/command_line.hpp"
#include "cli/compare_pair.hpp"
#include "cli/compare_report.hpp"
#include "cli/dispatcher.hpp"
#include "cli/interrupt.hpp"
#include "cli/outputs.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "lang/text/display_width.hpp"
#include "render/compare/color_map.hpp"
#include "render/compare/difference.hpp"
#include "render/compare/flip.hpp"
#include "render/compare/z_test.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {
namespace {

constexpr std::array<std::string_view, 3> kReportFormats{"human", "concise", "json"};
constexpr std::array<std::string_view, 2> kMaps{"difference", "flip"};

double parse_limit(const std::string& flag, const std::string& text) {
  return parse_number(flag, text, 0);
}

/// A gate that can be set on the command line.
struct GateKind {
  const char* flag;
  const char* quantity;
  const char* help;
  double (*parse)(const std::string& flag, const std::string& text);
  bool is_minimum;
  double (*value)(const CompareReport&);
};

constexpr std::array kGates{
    GateKind{"max-rmse", "the RMSE", "Max RMSE", parse_limit, false,
             [](const CompareReport& report) { return report.difference.rmse; }},
    GateKind{"max-relative-error", "the relative error",
             "Max RMSE relative to the mean of B: 3%, 0.03, 250%", parse_ratio, false,
             [](const CompareReport& report) { return report.difference.relative_error; }},
    GateKind{"max-relative-mse", "the relative MSE", "Max relative MSE, untrimmed", parse_limit,
             false, [](const CompareReport& report) { return report.difference.relative_mse; }},
    GateKind{"max-flip", "FLIP", "Max mean FLIP, from 0 to 1", parse_limit, false,
             [](const CompareReport& report) { return report.flip.mean; }},
    GateKind{"max-difference", "the largest difference",
             "Max difference of a value, in either direction; 0: equal", parse_limit, false,
             [](const CompareReport& report) { return std::abs(report.difference.largest.value); }},
    GateKind{"min-psnr", "the PSNR", "Min PSNR, in decibels", parse_signed_number, true,
             [](const CompareReport& report) { return report.difference.psnr; }},
    GateKind{"max-z", "z",
             "Max z of the z-test, of means and of noise; above 4 is unlikely to be chance",
             parse_limit, false,
             [](const CompareReport& report) { return report.z_test->largest(); }},
};
constexpr std::size_t kMaxZ = kGates.size() - 1;

struct CompareOptions {
  std::string picture, reference;
  std::string output;
  std::string what{kMaps[0]};
  std::optional<double> top;
  double pixels_per_degree = render::kFlipPixelsPerDegree;
  std::array<std::optional<double>, kGates.size()> limits;
  std::string format{kReportFormats[0]};
  bool quiet = false;
};

/// Decodes codes to linear values, for FLIP.
render::Picture to_linear(const render::Picture& picture, render::Tone tone) {
  render::Picture linear = picture;
  if (tone == render::Tone::Linear) return linear;
  for (render::LinearRgb& c : linear.pixels) {
    c = {decode_tone(tone, c.r), decode_tone(tone, c.g), decode_tone(tone, c.b)};
  }
  return linear;
}

class CompareJob {
 public:
  CompareJob(const CompareOptions& options, Environment& env) : options_(options), env_(env) {}

  ExitCode run() {
    check_output();
    CompareReport report;
    report.pair = read_pair(options_.picture, options_.reference);
    if (options_.limits[kMaxZ] && !report.pair.has_variance) {
      throw UsageError(
          "--max-z needs two .exr files with a variance, from `sdlc render --aov variance`");
    }
    measure(report);
    set_gates(report);
    std::atomic<bool> interrupted{false};
    if (!options_.output.empty()) {
      const InterruptGuard guard(interrupted);
      write_output(report);
    }
    if (options_.format == "json") {
      env_.out << to_json(report);
    } else if (!options_.quiet) {
      env_.out << (options_.format == "concise" ? to_concise_text(report) : to_text(report));
    }
    const bool is_broken = report_broken_gates(report);
    if (interrupted.load()) {
      env_.err << fmt::format("interrupted; {} was finished\n", lang::printable(options_.output));
      return ExitCode::Interrupted;
    }
    return is_broken ? ExitCode::Findings : ExitCode::Success;
  }

 private:
  /// Reports errors that are known before anything is read.
  void check_output() {
    if (options_.output.empty()) {
      if (options_.top || options_.what != kMaps[0]) {
        throw UsageError(
            fmt::format("{} applies to the picture that -o writes; name one, such as -o diff.png",
                        options_.top ? "--top" : "--what"));
      }
      return;
    }
    if (options_.output == kStandardStream) {
      throw UsageError("-o -: standard output is for the report; name a file, such as -o diff.png");
    }
    format_ = output_format(options_.output);
    if (format_ == render::ImageFormat::Hdr) {
      throw render::IoError("write", options_.output,
                            "Radiance HDR cannot store negative values; use .exr");
    }
    if (options_.top && is_linear_output()) {
      throw UsageError("--top is for colour maps such as .png; .exr stores the values");
    }
    if (InputSet({options_.picture, options_.reference}).contains(options_.output)) {
      throw render::IoError("write", options_.output, "it is one of the pictures to compare");
    }
    render::check_writable(options_.output);
  }

  bool is_linear_output() const { return render::describe(format_).is_linear; }

  void measure(CompareReport& report) const {
    const ComparedPair& pair = report.pair;
    const render::Picture &picture = pair.picture.picture, &reference = pair.reference.picture;
    report.difference = measure_difference(picture, reference);
    report.pixels_per_degree = options_.pixels_per_degree;
    report.flip = flip(to_linear(picture, pair.tone), to_linear(reference, pair.tone),
                       options_.pixels_per_degree);
    if (pair.has_variance) {
      report.z_test = render::z_test({.mean = picture, .variance = *pair.picture.variance},
                                     {.mean = reference, .variance = *pair.reference.variance});
    }
  }

  void set_gates(CompareReport& report) const {
    for (std::size_t i = 0; i < kGates.size(); ++i) {
      if (!options_.limits[i]) continue;
      report.gates.push_back({.name = kGates[i].flag,
                              .quantity = kGates[i].quantity,
                              .limit = *options_.limits[i],
                              .value = kGates[i].value(report),
                              .is_minimum = kGates[i].is_minimum});
    }
  }

  /// A - B, or FLIP as grey.
  render::Picture values_to_write(const CompareReport& report) const {
    const render::Picture &picture = report.pair.picture.picture,
                          &reference = report.pair.reference.picture;
    render::Picture values(picture.width, picture.height);
    for (std::size_t i = 0; i < values.pixels.size(); ++i) {
      values.pixels[i] = options_.what == "flip" ? render::LinearRgb(report.flip.values[i])
                                                 : picture.pixels[i] - reference.pixels[i];
    }
    return values;
  }

  void write_output(CompareReport& report) const {
    render::Picture values = values_to_write(report);
    report.output = {.path = options_.output, .what = options_.what, .top = {}};
    if (!is_linear_output()) {
      std::vector<float> sizes;  // magnitude of the difference per pixel
      float largest = 0;
      for (const render::LinearRgb c : values.pixels) {
        sizes.push_back(static_cast<float>(std::sqrt((c.r * c.r + c.g * c.g + c.b * c.b) / 3)));
        largest = std::max(largest, sizes.back());
      }
      // FLIP has a fixed maximum.
      const double top = options_.what == "flip" ? 1 : largest;
      report.output->top = options_.top.value_or(top);
      values = render::color_mapped(sizes, values.width, values.height, *report.output->top);
    }
    write_picture(options_.output, values,
                  {.format = format_,
                   .metadata = {.software = fmt::format("sdlc {}", kVersion), .entries = {}}});
  }

  bool report_broken_gates(const CompareReport& report) {
    bool is_any = false;
    for (const Gate& gate : report.gates) {
      if (gate.passes()) continue;
      is_any = true;
      env_.err << fmt::format("error: {} is {:.6g}, {} than the {:.6g} of --{}\n", gate.quantity,
                              gate.value, gate.is_minimum ? "less" : "more", gate.limit, gate.name);
    }
    return is_any;
  }

  const CompareOptions& options_;
  Environment& env_;
  render::ImageFormat format_ = render::ImageFormat::Png;
};

void add_number(Command& command, const std::string& flag, const char* type,
                const std::string& help, std::function<void(const std::string&)> set) {
  command.add_text(flag, std::move(set), help).type_name(type);
}

void add_gates(Command& command, CompareOptions& options) {
  for (std::size_t i = 0; i < kGates.size(); ++i) {
    const GateKind& gate = kGates[i];
    const std::string flag = std::string("--") + gate.flag;
    add_number(command, flag, gate.parse == parse_ratio ? "RATIO" : "X", gate.help,
               [flag, parse = gate.parse, &limit = options.limits[i]](const std::string& text) {
                 limit = parse(flag, text);
               });
  }
}

}  // namespace

void add_compare_command(Command& program, Dispatcher& dispatcher) {
  // Beyond this range the picture is smaller than on any display, or the filter has hundreds of
  // pixels.
  constexpr double kMinPixelsPerDegree = 1, kMaxPixelsPerDegree = 1000;
  auto options = std::make_shared<CompareOptions>();
  Command command = program.add_command(
      "compare", "Compare a picture with a reference, and fail if they differ too much");
  command.add_text("A", options->picture, "The picture").required();
  command.add_text("B", options->reference, "The reference, of the same size and kind").required();
  add_gates(command, *options);
  command.add_text("-o,--output", options->output,
                   "Write the difference: as colours, or signed, A - B, to an .exr");
  command.add_text("--what", options->what, "Contents of -o: the difference, or the FLIP map")
      .one_of(kMaps);
  add_number(command, "--top", "X",
             "Value of the brightest colour of -o; default: the largest, 1 for FLIP",
             [options = options.get()](const std::string& text) {
               options->top = parse_positive_number("--top", text);
             });
  add_number(command, "--pixels-per-degree", "X",
             "Resolution of the viewer, for FLIP: 1 to 1000; default 67.0206",
             [options = options.get()](const std::string& text) {
               const double v = parse_number("--pixels-per-degree", text, kMinPixelsPerDegree);
               if (v > kMaxPixelsPerDegree) {
                 throw ArgumentError("--pixels-per-degree", "takes a number up to 1000");
               }
               options->pixels_per_degree = v;
             });
  command.add_text("--format", options->format, "Format of the report").one_of(kReportFormats);
  command.add_flag("--quiet", options->quiet, "No report, except with --format json");
  command.footer(
      "Examples:\n"
      "  sdlc compare new.exr reference.exr                     all measures\n"
      "  sdlc compare new.png old.png --max-difference 0        fails unless they are equal\n"
      "  sdlc compare new.exr old.exr --max-relative-error 2%   a gate for CI; may be combined\n"
      "  sdlc compare a.exr b.exr --max-z 4                     with --aov variance in both\n"
      "  sdlc compare new.png old.png -o diff.png --top 0.1     the difference as colours\n"
      "  sdlc compare new.png old.png --format json | jq .flip\n"
      "\n"
      "docs/compare.md explains each measure. Exit status: 0 all limits hold, 1 one is exceeded, 2 "
      "a file cannot be\n"
      "read or written, or the two cannot be compared.");
  dispatcher.on(command, [options](Environment& env) { return CompareJob(*options, env).run(); });
}

}  // namespace sdlc::cli
