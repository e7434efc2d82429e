#include "render/measure/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "render/compare/flip.hpp"
#include "render/math/clock.hpp"
#include "render/measure/trade.hpp"
#include "render/parallel/threads.hpp"
#include "render/shading/choose_lights.hpp"

namespace sdlc::render {
namespace {

/// Seeds far from those of the points, so that the reference is independent of them.
constexpr std::uint64_t kReferenceSeed = 1'000'003, kProbeSeed = 2'000'003;

double cut_paths(const RenderResult& result) {
  return static_cast<double>(result.truncated_paths) /
         static_cast<double>(std::max<std::uint64_t>(result.camera_samples, 1));
}

double seconds_of(const RenderResult& result) {
  return result.build_seconds + result.render_seconds;
}

}  // namespace

Study::Study(const Scene& scene, const RenderSettings& settings, KernelRequest request,
             StudyOptions options, StudyLedger& ledger, const StudyObserver& observer,
             RenderMonitor& monitor)
    : scene_(scene),
      settings_(settings),
      request_(request),
      options_(options),
      ledger_(ledger),
      observer_(observer),
      monitor_(monitor),
      spent_before_(ledger.spent_seconds),
      start_(Clock::now()) {
  settings_.error.reset();
  settings_.seconds.reset();
  settings_.is_adaptive = false;
  const Kernel kernel = choose_kernel(scene, settings, request);
  if (kernel.refusal) throw std::invalid_argument(describe(kernel.refusal->obstacle));
  for_each_configuration_setting([&](const auto& row) {
    if (row.setting != nullptr) own_.*row.member = settings.*row.setting;
  });
  own_.precision = kernel.precision;
  ledger_.light_choice = kernel.light_choice;
  // Where float fails, its bound is the reason, not that of double.
  const bool is_forced = kernel.precision == Precision::Double && !request.precision &&
                         !kernel.precision_reason.empty();
  const PrecisionClause clause = kernel.bounds.deciding();
  ledger_.precision_bound =
      is_forced ? "in float " + kernel.precision_reason : describe(clause, kernel.bounds[clause]);
}

KernelRequest Study::request_of(const Configuration& configuration) const {
  if (configuration == own_) return request_;
  // Fix the precision: the automatic choice might change with the depth.
  KernelRequest request = request_;
  request.precision =
      configuration.precision == Precision::Mixed ? Precision::Float : configuration.precision;
  request.may_take_double = false;
  return request;
}

RenderSettings Study::settings_of(const Configuration& configuration, int samples,
                                  std::uint64_t seed) const {
  RenderSettings settings = settings_;
  if (ledger_.plan) {
    settings.width = ledger_.plan->width;
    settings.height = ledger_.plan->height;
  }
  for_each_configuration_setting([&](const auto& row) {
    if (row.setting != nullptr) settings.*row.setting = configuration.*row.member;
  });
  settings.samples = samples;
  settings.seed = seed;
  return settings;
}

Kernel Study::kernel_of(const Configuration& configuration) const {
  return choose_kernel(scene_, settings_of(configuration, 8, settings_.seed),
                       request_of(configuration));
}

RenderResult Study::render_once(const RenderSettings& settings,
                                const Configuration& configuration) {
  monitor_.samples_done = 0;
  monitor_.rays_done = 0;
  return render(*prepared(settings, configuration), settings, monitor_);
}

std::shared_ptr<const PreparedScene> Study::prepared(const RenderSettings& settings,
                                                     const Configuration& configuration) {
  const std::array<int, 2> size{settings.width, settings.height};
  const auto known = std::ranges::find_if(prepared_, [&](const Prepared& one) {
    return one.configuration == configuration && one.size == size;
  });
  if (known != prepared_.end()) return known->scene;
  constexpr std::size_t kKept = 2;
  if (prepared_.size() == kKept) prepared_.erase(prepared_.begin());
  prepared_.push_back({configuration, size,
                       std::make_shared<const PreparedScene>(
                           prepare(scene_, settings, request_of(configuration)))});
  return prepared_.back().scene;
}

std::vector<Configuration> Study::configurations() const {
  std::vector<Configuration> configurations{own_};
  const auto add = [&](auto Configuration::*member, auto value) {
    Configuration configuration = own_;
    configuration.*member = value;
    configurations.push_back(configuration);
  };
  add(&Configuration::sampler,
      own_.sampler == SamplerKind::Sobol ? SamplerKind::Independent : SamplerKind::Sobol);
  const Kernel kernel = kernel_of(own_);
  for (const LightSampling other : {LightSampling::On, LightSampling::Off}) {
    Configuration with_other = own_;
    with_other.light_sampling = other;
    const Kernel of_other = kernel_of(with_other);
    if (of_other.lights != kernel.lights || of_other.casters != kernel.casters ||
        of_other.samples_at_metal != kernel.samples_at_metal) {
      add(&Configuration::light_sampling, other);
    }
  }
  const bool has_light = !choose_lights(scene_, LightSampling::On).empty();
  if (has_light && kernel.casters.empty() &&
      !choose_casters(scene_, kernel.exact_spheres).empty()) {
    add(&Configuration::light_sampling, LightSampling::Caustics);
  }
  add(&Configuration::precision,
      own_.precision == Precision::Double ? Precision::Float : Precision::Double);
  add(&Configuration::is_denoised, !own_.is_denoised);
  if (own_.depth > 2) add(&Configuration::depth, own_.depth / 2);
  if (own_.depth <= 64) add(&Configuration::depth, 2 * own_.depth);
  return configurations;
}

ConfigurationCost Study::try_configuration(const Configuration& configuration) {
  ConfigurationCost cost{.configuration = configuration};
  const Kernel kernel = kernel_of(configuration);
  if (kernel.refusal) {
    cost.refusal = describe(kernel.refusal->obstacle);
    return cost;
  }
  prepared_.clear();  // each trial measures a build
  cost.configuration.precision = kernel.precision;
  RenderSettings settings = settings_of(configuration, 8, settings_.seed);
  // Small enough to be cheap, large enough to keep all lanes and threads busy.
  constexpr double kPixels = 1 << 15;
  const double scale = std::sqrt(kPixels / (static_cast<double>(settings.width) * settings.height));
  if (scale < 1) {
    settings.width = std::max(1, static_cast<int>(settings.width * scale));
    settings.height = std::max(1, static_cast<int>(settings.height * scale));
  }
  const RenderResult result = render_once(settings, configuration);
  cost.build_seconds = result.build_seconds;
  const double pixels = static_cast<double>(settings.width) * settings.height;
  cost.seconds_per_pixel = result.denoise_seconds / pixels;
  cost.seconds_per_sample =
      (result.render_seconds - result.denoise_seconds) / (pixels * settings.samples);
  return cost;
}

ConfigurationCost Study::guess_configuration(const Configuration& configuration,
                                             const ConfigurationCost& own) const {
  const Kernel kernel = kernel_of(configuration);
  ConfigurationCost cost = own;
  cost.configuration = configuration;
  cost.configuration.precision = kernel.precision;
  if (kernel.refusal) cost.refusal = describe(kernel.refusal->obstacle);
  // Upper bounds for usual scenes.
  constexpr double kOfLights = 2, kOfCaustics = 8, kOfDouble = 2;
  if (configuration.light_sampling == LightSampling::On) cost.seconds_per_sample *= kOfLights;
  if (configuration.light_sampling == LightSampling::Caustics) {
    cost.seconds_per_sample *= kOfCaustics;
  }
  if (configuration.precision == Precision::Double && own_.precision != Precision::Double) {
    cost.seconds_per_sample *= kOfDouble;
  }
  constexpr double kOfDenoising = 20e-6;
  if (configuration.is_denoised) cost.seconds_per_pixel = kOfDenoising;
  return cost;
}

void Study::make_plan() {
  StudyRequest request{
      .settings = settings_, .budget_seconds = options_.budget_seconds, .size = options_.size};
  if (options_.sweeps_threads) {
    request.thread_counts = thread_counts_up_to(thread_count(settings_.threads));
  }
  // The first render of a process is slower than later ones, so run it twice. If one trial alone
  // takes a good part of the time, guess the others.
  ConfigurationCost own = try_configuration(own_);
  constexpr double kShareOfTrials = 0.1;
  for (const Configuration& configuration : configurations()) {
    if (monitor_.cancel.load()) return;
    const double spent = options_.budget_seconds - seconds_left();
    const bool is_quick = spent < kShareOfTrials * options_.budget_seconds;
    request.costs.push_back(is_quick ? try_configuration(configuration)
                                     : guess_configuration(configuration, own));
  }
  request.reference_configuration = own_;
  request.reference_configuration.sampler = SamplerKind::Sobol;
  request.reference_configuration.is_denoised = false;
  // Sampled lights are not missed.
  if (!choose_lights(scene_, LightSampling::On).empty()) {
    request.reference_configuration.light_sampling =
        kernel_of(own_).casters.empty() ? LightSampling::On : LightSampling::Caustics;
  }
  ledger_.plan = plan_study(request);
  // The trials extrapolate from a few pixels. One render at the planned size corrects them.
  const StudyTask task{.kind = StudyTask::Kind::Repeat,
                       .configuration = own_,
                       .samples = static_cast<int>(kMinReplicatedSamples)};
  const double expected = ledger_.plan->seconds_of(task);
  constexpr double kShareOfCorrection = 0.05;
  if (ledger_.plan->width < settings_.width &&
      expected < kShareOfCorrection * options_.budget_seconds) {
    const auto result = rendered(own_, task.samples, settings_.seed);
    if (!result) return;
    const double factor = result->render_seconds / (expected - own.build_seconds);
    for (ConfigurationCost& cost : request.costs) cost.seconds_per_sample *= factor;
    ledger_.plan = plan_study(request);
  }
  std::erase_if(ledger_.plan->depths, [&](int depth) {
    Configuration configuration = own_;
    configuration.depth = depth;
    return kernel_of(configuration).refusal.has_value();
  });
}

double Study::seconds_left() const {
  return options_.budget_seconds - spent_before_ - seconds_since(start_);
}

void Study::account() {
  ledger_.spent_seconds = spent_before_ + seconds_since(start_);
  if (observer_.on_progress) observer_.on_progress(ledger_);
}

std::optional<RenderResult> Study::rendered(const Configuration& configuration, int samples,
                                            std::uint64_t seed, bool keeps_variance) {
  RenderSettings settings = settings_of(configuration, samples, seed);
  settings.keeps_variance = keeps_variance;
  RenderResult result = render_once(settings, configuration);
  if (!result.is_complete) return std::nullopt;
  ledger_.nonfinite_samples += result.nonfinite_samples;
  return result;
}

bool Study::is_done(const StudyTask& task) const {
  const Point* const point = find_point(ledger_.points, task.configuration, task.samples);
  const auto of_round = [&](const auto& probe) { return probe.round == task.round; };
  switch (task.kind) {
    case StudyTask::Kind::Reference: return ledger_.reference && reference_;
    case StudyTask::Kind::Point: return point != nullptr;
    case StudyTask::Kind::Repeat:  // nothing to repeat if there was no time for the point
      return point == nullptr || std::cmp_greater(point->timings.size(), task.round);
    case StudyTask::Kind::Depths:
      return static_cast<std::size_t>(std::ranges::count_if(ledger_.depths, of_round)) ==
             ledger_.plan->depths.size();
    case StudyTask::Kind::Precisions: return std::ranges::any_of(ledger_.precisions, of_round);
    case StudyTask::Kind::Threads: return std::ranges::any_of(ledger_.threads, of_round);
  }
  return false;
}

bool Study::run_reference(const StudyTask& task) {
  const std::uint64_t seed = settings_.seed + kReferenceSeed;
  std::optional<RenderResult> result = rendered(task.configuration, task.samples, seed, true);
  if (!result) return false;
  Reference reference{.configuration = task.configuration,
                      .samples = task.samples,
                      .seed = seed,
                      .seconds = seconds_of(*result),
                      .scarce_emitters = result->scarce_emitters.size()};
  reference.error = {INFINITY, {INFINITY, INFINITY}};
  if (result->error) {
    reference.error = {result->error->relative_error, result->error->interval};
  }
  reference_ = reference_picture(*std::move(result));
  reference.mean_radiance = mean_radiance(reference_->picture);
  ledger_.reference = reference;
  if (observer_.on_reference) observer_.on_reference(*reference_);
  return true;
}

bool Study::run_point(const StudyTask& task) {
  if (task.kind == StudyTask::Kind::Repeat) prepared_.clear();  // its time is independent
  const std::optional<RenderResult> result =
      rendered(task.configuration, task.samples, settings_.seed);
  if (!result) return false;
  if (task.kind == StudyTask::Kind::Repeat) {
    Point* const point = find_point(ledger_.points, task.configuration, task.samples);
    point->timings.push_back(seconds_of(*result));
    return true;
  }
  const Picture& picture = result->picture;
  ledger_.points.push_back({.configuration = task.configuration,
                            .samples = task.samples,
                            .timings = {seconds_of(*result)},
                            .rays = result->rays,
                            .error = error_against(picture, *reference_),
                            .error_spread = error_spread(picture, *reference_),
                            .difference = measure_difference(picture, reference_->picture),
                            .flip = flip(picture, reference_->picture).mean,
                            .scarce_emitters = result->scarce_emitters.size(),
                            .cut_paths = cut_paths(*result)});
  if (observer_.on_picture) {
    observer_.on_picture(task.configuration, task.samples, picture, *reference_);
  }
  return true;
}

bool depths_have_converged(std::span<const DepthProbe> probes) {
  constexpr double kNegligibleLight = 1e-4, kNegligibleCuts = 0.01;
  constexpr int kQuietDoublings = 3;
  std::map<int, double> means;  // sums over the rounds
  for (const DepthProbe& probe : probes) means[probe.depth] += probe.mean;
  if (means.empty()) return false;
  const auto [deepest, light] = *means.rbegin();
  double cut = 0;
  for (const DepthProbe& probe : probes) {
    if (probe.depth == deepest) cut = std::max(cut, probe.cut_paths);
  }
  int quiet = 0;  // number of doublings of the depth that added almost no light
  for (auto deep = std::prev(means.end()); deep->first > 1; ++quiet) {
    const auto after_half = means.upper_bound(deep->first / 2);
    if (after_half == means.begin()) break;
    const auto half = std::prev(after_half);
    if (deep->second - half->second > kNegligibleLight * light) break;
    deep = half;
  }
  return cut == 0 || (quiet > 0 && cut <= kNegligibleCuts) ||
         (quiet >= kQuietDoublings && light > 0);
}

bool Study::run_depths(const StudyTask& task) {
  constexpr int kMaxProbedDepth = 1 << 14;
  std::vector<int> depths = ledger_.plan->depths;
  std::vector<DepthProbe> probes;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    Configuration configuration = own_;
    configuration.depth = depths[i];
    const auto result = rendered(configuration, task.samples,
                                 settings_.seed + kProbeSeed + static_cast<unsigned>(task.round));
    if (!result) return false;
    probes.push_back({.depth = configuration.depth,
                      .round = task.round,
                      .mean = mean_radiance(result->picture),
                      .seconds = seconds_of(*result),
                      .cut_paths = cut_paths(*result)});
    // The first round goes on until no more light is found; the others use the same depths.
    if (task.round > 0 || i + 1 < depths.size() || depths_have_converged(probes)) continue;
    if (configuration.depth > kMaxProbedDepth / 2) continue;
    configuration.depth *= 2;
    const double seconds = kProbeSeeds * 2 * probes.back().seconds;  // upper bound over all rounds
    if (seconds > seconds_left() || kernel_of(configuration).refusal) continue;
    depths.push_back(configuration.depth);
  }
  ledger_.plan->depths = std::move(depths);
  ledger_.depths.insert(ledger_.depths.end(), probes.begin(), probes.end());
  return true;
}

bool Study::run_precisions(const StudyTask& task) {
  const std::uint64_t seed = settings_.seed + kProbeSeed + static_cast<unsigned>(task.round);
  const ConfigurationCost* const other = ledger_.plan->other_precision();
  const auto first = rendered(own_, task.samples, seed);
  if (!first) return false;
  const auto second = rendered(other->configuration, task.samples, seed);
  if (!second) return false;
  ledger_.precisions.push_back(
      {.round = task.round,
       .mean = mean_radiance(first->picture),
       .other_mean = mean_radiance(second->picture),
       .rms_difference = measure_difference(first->picture, second->picture).relative_error,
       .seconds = seconds_of(*first),
       .other_seconds = seconds_of(*second)});
  return true;
}

bool Study::run_threads(const StudyTask& task) {
  // Up and down in turn, so that a drift of the machine cancels.
  std::vector<int> counts = ledger_.plan->thread_counts;
  if (task.round % 2 == 1) std::ranges::reverse(counts);
  std::vector<ThreadProbe> probes;
  std::optional<Picture> first;
  for (const int threads : counts) {
    prepared_.clear();  // each build takes these threads, too
    RenderSettings settings = settings_of(task.configuration, task.samples, settings_.seed);
    settings.threads = threads;
    RenderResult result = render_once(settings, task.configuration);
    if (!result.is_complete) return false;
    if (!first) first = result.picture;
    probes.push_back({.threads = threads,
                      .round = task.round,
                      .seconds = seconds_of(result),
                      .is_same = result.picture.pixels == first->pixels});
  }
  prepared_.clear();
  ledger_.threads.insert(ledger_.threads.end(), probes.begin(), probes.end());
  return true;
}

bool Study::run_task(const StudyTask& task) {
  switch (task.kind) {
    case StudyTask::Kind::Reference: return run_reference(task);
    case StudyTask::Kind::Point:
    case StudyTask::Kind::Repeat: return run_point(task);
    case StudyTask::Kind::Depths: return run_depths(task);
    case StudyTask::Kind::Precisions: return run_precisions(task);
    case StudyTask::Kind::Threads: return run_threads(task);
  }
  return false;
}

void Study::notify(const std::string& what) const {
  if (!observer_.on_task) return;
  const double spent = options_.budget_seconds - seconds_left();
  observer_.on_task(what, std::min(spent / options_.budget_seconds, 1.0));
}

double Study::expected_seconds(const StudyTask& task) const {
  const double factor = predicted_ > 0 ? taken_ / predicted_ : 1;
  return factor * ledger_.plan->seconds_of(task);
}

bool Study::run_and_account(const StudyTask& task) {
  notify(describe(task));
  const auto start = Clock::now();
  if (!run_task(task)) return false;
  predicted_ += ledger_.plan->seconds_of(task);
  taken_ += seconds_since(start);
  account();
  return true;
}

void Study::run(std::optional<ReferencePicture> reference) {
  reference_ = std::move(reference);
  if (!ledger_.plan) {
    notify("short trials of every configuration");
    make_plan();
    if (monitor_.cancel.load()) return;
    account();
  }
  const std::vector<StudyTask> tasks = ledger_.plan->tasks;
  for (const StudyTask& task : tasks) {
    const bool is_reference = task.kind == StudyTask::Kind::Reference;
    if (is_done(task) || (!is_reference && expected_seconds(task) > seconds_left())) continue;
    if (!run_and_account(task)) return;
  }
  // A finished study that is run again with the same budget measures nothing more.
  if (options_.budget_seconds <= ledger_.finished_budget_seconds) return;
  run_recommended();
  run_longer();
  run_again();
  if (monitor_.cancel.load()) return;
  ledger_.finished_budget_seconds = options_.budget_seconds;
  account();
}

void Study::run_longer() {
  // Only as long as the reference is better.
  while (!monitor_.cancel.load()) {
    int max_samples = 0;
    for (const Point& point : ledger_.points) {
      if (point.configuration == own_) max_samples = std::max(max_samples, point.samples);
    }
    // Double the samples.
    int samples = static_cast<int>(kMinReplicatedSamples);
    while (samples <= max_samples) samples *= 2;
    const StudyTask task{.configuration = own_, .samples = samples};
    const bool is_known = max_samples > 0 && 2 * samples <= ledger_.plan->reference_samples;
    if (!is_known || 1.2 * expected_seconds(task) > seconds_left()) return;
    if (!run_and_account(task)) return;
  }
}

void Study::run_again() {
  constexpr std::size_t kTimings = 5;
  constexpr double kUnused = 0.1;
  while (!monitor_.cancel.load() && seconds_left() > kUnused * options_.budget_seconds) {
    const Point* next = nullptr;
    StudyTask task;
    for (const Point& point : ledger_.points) {
      const StudyTask repeat{.kind = StudyTask::Kind::Repeat,
                             .configuration = point.configuration,
                             .samples = point.samples,
                             .round = static_cast<int>(point.timings.size())};
      const bool is_next = next == nullptr || point.timings.size() < next->timings.size();
      if (!is_next || point.timings.size() >= kTimings) continue;
      if (1.2 * expected_seconds(repeat) > seconds_left()) continue;
      next = &point;
      task = repeat;
    }
    if (next == nullptr || !run_and_account(task)) return;
  }
}

void Study::run_recommended() {
  // If a point misses its goal, try again with more samples.
  constexpr int kTries = 3;
  const std::size_t count = measurement().recommendations.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (int attempt = 0; attempt < kTries; ++attempt) {
      const Measurement now = measurement();
      if (i >= now.recommendations.size() || now.recommendations[i].is_measured) break;
      const Recommendation& next = now.recommendations[i];
      const StudyTask task{.configuration = next.configuration, .samples = next.samples};
      if (is_done(task) || expected_seconds(task) > seconds_left()) break;
      if (!run_and_account(task)) return;
    }
  }
}

Measurement Study::measurement() const { return measurement_of(ledger_, settings_, options_); }

}  // namespace sdlc::render
