#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "lang/compile/compile.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"
#include "render/compare/difference.hpp"
#include "render/session/render.hpp"

// Checks the confidence intervals of errors against long renders. For each scene: tiny pictures
// with many seeds, with a fixed number of samples and with an error goal.
namespace sdlc::bench {
namespace {

constexpr const char* kHelp =
    "Usage: coverage [OPTION]... SCENE...\n"
    "Checks the confidence intervals of errors against long renders of other seeds.\n"
    "\n"
    "  --seeds=N           pictures of each kind (300)\n"
    "  --size=N            width of a picture; the height is 9/16 of it (32)\n"
    "  --samples=N         of a picture without a goal (64)\n"
    "  --truth=N           samples of the long render (65536)\n"
    "  --goal=X            the error goal, relative to the median error without a goal (0.6)\n"
    "  --denoise           pictures are denoised\n"
    "  --light-sampling=W  as of sdlc render\n"
    "\n"
    "A picture is covered if its true error, the distance from the long render, is within its\n"
    "interval; a goal is met if the true error is at most the goal. Spent is the mean number of\n"
    "samples divided by the number with which the true error would have been the goal, if errors\n"
    "fall with the root of the samples. An interval of 95 % covers 92.5 to 97.5 % of 300 pictures\n"
    "with a probability of 95 %. Pictures whose error is unknown do not count.\n";

struct Options {
  int seeds = 300, size = 32, samples = 64, truth = 1 << 16;
  double goal = 0.6;
  lang::Overrides overrides;
  std::vector<std::string> scenes;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const auto equals = std::min(argument.find('='), argument.size());
    const std::string_view name = argument.substr(0, equals);
    const std::string value(argument.substr(std::min(equals + 1, argument.size())));
    if (name == "--seeds") {
      options.seeds = std::stoi(value);
    } else if (name == "--size") {
      options.size = std::stoi(value);
    } else if (name == "--samples") {
      options.samples = std::stoi(value);
    } else if (name == "--truth") {
      options.truth = std::stoi(value);
    } else if (name == "--goal") {
      options.goal = std::stod(value);
    } else if (name == "--denoise") {
      options.overrides.is_denoised = true;
    } else if (name == "--light-sampling") {
      options.overrides.render.emplace_back(lang::render_property::kLightSampling, value);
    } else if (name.starts_with("-")) {
      throw std::invalid_argument(fmt::format("unknown option {}", name));
    } else {
      options.scenes.emplace_back(argument);
    }
  }
  return options;
}

lang::LoweredScene lower(const std::string& path, const lang::Overrides& overrides) {
  const lang::DiskFileSystem disk;
  lang::Workspace workspace(disk);
  std::error_code error;
  const auto document = workspace.load(path, lang::Limits().any_file(), error);
  if (!document) throw std::runtime_error(path + ": " + error.message());
  lang::DiagnosticSink sink;
  lang::Compiler compiler(*document, {.workspace = &workspace, .limits = {}}, sink);
  auto lowered = compiler.lower(overrides);
  if (!lowered) throw std::runtime_error(path + ": has errors");
  return *std::move(lowered);
}

struct Outcome {
  bool is_known = false;
  bool is_covered = false;
  double true_error = 0;
  double samples = 0;
};

/// Renders with each seed, on all threads.
class Pictures {
 public:
  Pictures(const render::PreparedScene& scene, const render::Picture& truth)
      : scene_(scene), truth_(truth) {}

  std::vector<Outcome> render(const render::RenderSettings& settings, int seeds) const {
    std::vector<Outcome> outcomes(static_cast<std::size_t>(seeds));
    std::atomic<int> next{0};
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1u, std::thread::hardware_concurrency()); ++i) {
      threads.emplace_back([&] {
        for (int seed = next++; seed < seeds; seed = next++) {
          render::RenderSettings own = settings;
          own.seed = static_cast<std::uint64_t>(seed) + 1;
          own.threads = 1;
          outcomes[static_cast<std::size_t>(seed)] = outcome(own);
        }
      });
    }
    threads.clear();
    return outcomes;
  }

 private:
  Outcome outcome(const render::RenderSettings& settings) const {
    render::RenderMonitor monitor;
    const render::RenderResult result = render::render(scene_, settings, monitor);
    Outcome outcome;
    outcome.is_known = result.error && (!settings.error || result.has_reached_error);
    if (!outcome.is_known) return outcome;
    outcome.true_error = render::measure_difference(result.picture, truth_).relative_error;
    const render::Interval interval = result.error->interval;
    outcome.is_covered = interval.from <= outcome.true_error && outcome.true_error <= interval.to;
    outcome.samples = static_cast<double>(result.max_samples);
    return outcome;
  }

  const render::PreparedScene& scene_;
  const render::Picture& truth_;
};

struct Shares {
  int known = 0;
  double covered = 0, met = 0, spent = 0;
};

Shares shares_of(const std::vector<Outcome>& outcomes, double goal) {
  Shares shares;
  double spent = 0, needed = 0;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.is_known) continue;
    ++shares.known;
    shares.covered += outcome.is_covered;
    shares.met += outcome.true_error <= goal;
    spent += outcome.samples;
    const double missing = outcome.true_error / goal;
    needed += outcome.samples * missing * missing;
  }
  shares.covered /= shares.known;
  shares.met /= shares.known;
  shares.spent = spent / needed;
  return shares;
}

double median_error(const std::vector<Outcome>& outcomes) {
  std::vector<double> errors;
  for (const Outcome& outcome : outcomes) {
    if (outcome.is_known) errors.push_back(outcome.true_error);
  }
  if (errors.empty()) return 0;
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::ranges::nth_element(errors, middle);
  return *middle;
}

void print_row(const std::string& path, const Options& options) {
  lang::LoweredScene lowered = lower(path, options.overrides);
  render::RenderSettings settings = lowered.settings;
  settings.width = options.size;
  settings.height = options.size * 9 / 16;
  settings.samples = options.samples;
  settings.error.reset();
  const render::PreparedScene scene = render::prepare(std::move(lowered.scene), settings);

  render::RenderSettings longer = settings;
  longer.samples = options.truth;
  longer.seed = 1'000'000;
  longer.is_denoised = false;
  render::RenderMonitor monitor;
  const render::Picture truth = render::render(scene, longer, monitor).picture;

  const std::string name = std::filesystem::path(path).stem().string();
  const Pictures pictures(scene, truth);
  const std::vector<Outcome> fixed = pictures.render(settings, options.seeds);
  const double typical = median_error(fixed);
  if (typical == 0) {
    fmt::print("| {} | unknown | | | | | | | |\n", name);
    return;
  }
  settings.error = options.goal * typical;
  settings.samples = 1'000'000;
  const Shares plain = shares_of(fixed, typical);
  const Shares to_goal = shares_of(pictures.render(settings, options.seeds), *settings.error);
  fmt::print("| {} | {:.2g} % | {} | {:.3f} | {:.2g} % | {} | {:.3f} | {:.3f} | {:.2f} |\n", name,
             100 * typical, plain.known, plain.covered, 100 * *settings.error, to_goal.known,
             to_goal.covered, to_goal.met, to_goal.spent);
  std::fflush(stdout);
}

}  // namespace
}  // namespace sdlc::bench

int main(int argc, char** argv) {
  try {
    const sdlc::bench::Options options = sdlc::bench::parse(argc, argv);
    if (options.scenes.empty()) {
      fmt::print("{}", sdlc::bench::kHelp);
      return EXIT_FAILURE;
    }
    fmt::print(
        "| scene | error | known | covered | goal | known | covered | met | spent |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (const std::string& scene : options.scenes) sdlc::bench::print_row(scene, options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
