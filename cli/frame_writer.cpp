#include "cli/frame_writer.hpp"

#include <algorithm>
#include <future>
#include <ranges>
#include <sstream>
#include <string>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/accuracy_report.hpp"
#include "cli/aov_option.hpp"
#include "cli/numbers/format_numbers.hpp"
#include "cli/progress.hpp"
#include "cli/report_failure.hpp"
#include "lang/text/display_width.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/threads.hpp"

namespace sdlc::cli {
namespace {

/// What an interrupted render has left, as clauses.
std::string describe_saved(const Written& written) {
  std::vector<std::string> saved;
  if (!written.names.empty()) {
    saved.push_back(
        fmt::format("the partial picture was {} {}",
                    written.names.front() == kStandardOutput ? "written to" : "saved as",
                    fmt::join(written.names, ", ")));
  }
  if (!written.films.empty()) {
    saved.push_back(fmt::format("--resume goes on from {}", written.films.front()));
  }
  return saved.empty() ? "nothing was saved" : fmt::to_string(fmt::join(saved, "; "));
}

/// "512 samples, 1.2 s (…)": what was rendered.
std::string describe_render(const render::RenderResult& result, const FilmJob* film) {
  const std::string rate =
      fmt::format("{} ({} samples/s)", format_seconds(result.render_seconds),
                  format_count(static_cast<double>(result.new_samples) / result.render_seconds));
  if (film != nullptr && film->is_shard()) {
    return fmt::format("{}, {} samples, {}", film->name_of_shard(),
                       format_count(static_cast<double>(result.camera_samples)), rate);
  }
  return fmt::format("{}, {}{}{}", describe_samples(result), rate, describe_error(result),
                     describe_light_choice(result.kernel));
}

/// Prints the final line and returns the status of the command. `film` may be null.
ExitCode conclude(const RenderOptions& options, const render::RenderSettings& settings,
                  const render::RenderResult& result, const FilmJob* film, const Written& written,
                  Environment& env) {
  // The scene is at fault, with a warning about it (W501).
  const bool is_too_bright = result.kernel.bounds[render::PrecisionClause::Radiance].share > 1;
  if (result.nonfinite_samples > 0) {
    env.err << fmt::format("error: {} samples are not finite and were left out{}\n",
                           result.nonfinite_samples,
                           is_too_bright ? ": colors or intensities are beyond the precision" : "");
  }
  if (!result.is_complete) {
    const std::uint64_t total = film != nullptr ? film->samples() : total_samples(settings);
    const std::string of =
        settings.has_goal() ? "" : fmt::format(" of {}", format_count(static_cast<double>(total)));
    env.err << fmt::format("interrupted after {}{} samples; {}\n",
                           format_count(static_cast<double>(result.camera_samples)), of,
                           describe_saved(written));
    return graver(ExitCode::Interrupted, written.code);
  }
  if (film == nullptr || !film->is_shard()) {
    for (const std::string& warning : accuracy_warnings(settings, result)) {
      env.err << "warning: " << warning << "\n";
    }
  }
  if (const int wanted = render::wanted_threads(settings.threads); result.threads < wanted) {
    env.err << fmt::format("warning: {} of {} threads could be started\n", result.threads, wanted);
  }
  const std::vector<std::string> names = written.all();
  if (!options.is_quiet() && !names.empty()) {
    env.err << fmt::format("{}: {} x {} pixels, {}\n", fmt::join(names, ", "),
                           settings.window().width, settings.window().height,
                           describe_render(result, film));
  }
  const ExitCode of_samples = result.nonfinite_samples == 0 ? ExitCode::Success
                              : is_too_bright               ? ExitCode::Findings
                                                            : ExitCode::Defect;
  return graver(of_samples, written.code);
}

/// Whether some such pictures fit into memory, and may be written in any order.
bool is_small(std::size_t pixels, int zoom, const std::vector<Output>& outputs) {
  constexpr std::size_t kMaxPixels = std::size_t{1} << 18;
  const auto factor = static_cast<std::size_t>(zoom);
  return pixels * factor * factor <= kMaxPixels &&
         std::ranges::none_of(outputs, &Output::is_stdout);
}

}  // namespace

ExitCode write_frame(const RenderOptions& options, RenderedFrame& frame, FilmJob* film,
                     Environment& env) {
  const render::RenderResult& result = frame.result;
  if (result.camera_samples == 0) return conclude(options, frame.settings, result, film, {}, env);
  if (!result.is_complete && !std::ranges::all_of(frame.outputs, &Output::is_film)) {
    env.err << "interrupted; saving the partial picture" << std::endl;
  }
  const auto start = render::Clock::now();
  Written written;
  if (film == nullptr || !film->is_shard()) {
    const std::vector<render::Layer> layers =
        picture_layers(options.aovs, frame.settings, result, env.err);
    written = write_pictures(frame.outputs, frame.form, frame.settings, result, layers, env);
  }
  if (film != nullptr) {
    const bool is_picture_written = result.is_complete && written.code == ExitCode::Success;
    for (const auto& path : film->finish(result.is_complete, is_picture_written)) {
      try_to_write(written.code, env, [&] {
        film->write(path);
        written.films.push_back(lang::printable(path.string()));
      });
    }
  }
  frame.statistics.write_seconds += render::seconds_since(start);
  frame.is_written = result.is_complete && written.code == ExitCode::Success;
  return conclude(options, frame.settings, result, film, written, env);
}

struct PendingFrames::Pending {
  RenderedFrame frame = {};
  Render render = {};
  render::RenderMonitor monitor = {};
  std::ostringstream messages = {};
  std::future<ExitCode> code = {};  // last: it uses the others
};

PendingFrames::PendingFrames(const RenderOptions& options, Environment& env)
    : options_(options), env_(env) {}

PendingFrames::~PendingFrames() { cancel(); }

bool PendingFrames::may_wait(const RenderedFrame& frame) {
  return frame.result.is_complete &&
         is_small(frame.result.picture.pixels.size(), frame.form.zoom, frame.outputs);
}

bool PendingFrames::may_render(const render::RenderSettings& settings, const render::Scene& scene,
                               const std::vector<Output>& outputs, int zoom) {
  // So that an interrupted render ends within seconds.
  constexpr std::size_t kMaxSamples = std::size_t{1} << 22;
  // Each has its own scene in memory.
  constexpr std::size_t kMaxSpheres = std::size_t{1} << 14;
  const std::size_t pixels = settings.window().pixels();
  std::size_t spheres = scene.spheres.size() + scene.instances.size();
  for (const render::Prototype& prototype : scene.prototypes) spheres += prototype.spheres.size();
  return !settings.has_goal() && !settings.is_denoised && is_small(pixels, zoom, outputs) &&
         pixels * static_cast<std::size_t>(settings.samples) <= kMaxSamples &&
         spheres <= kMaxSpheres;
}

void PendingFrames::add(RenderedFrame frame) { add(std::move(frame), {}, 0); }

void PendingFrames::add(RenderedFrame frame, Render render, int threads) {
  Pending& pending = *frames_.emplace_back(std::make_unique<Pending>());
  pending.frame = std::move(frame);
  pending.render = std::move(render);
  const auto write = [this, &pending, threads] {
    Environment env = env_.with_err(pending.messages);
    return report_failure(env, [&] {
      if (pending.render) {
        this->render(pending, threads);
        if (!pending.frame.result.is_complete) return ExitCode::Interrupted;
      }
      return write_frame(options_, pending.frame, nullptr, env);
    });
  };
  try {
    pending.code = std::async(std::launch::async, write);
  } catch (const std::system_error&) {  // no thread: when it is waited for
    pending.code = std::async(std::launch::deferred, write);
  }
}

void PendingFrames::render(Pending& pending, int threads) {
  const auto leave = [this] {
    const std::lock_guard lock(mutex_);
    --rendering_;
    wake_.notify_one();
  };
  {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [&] { return rendering_ < threads; });
    ++rendering_;
  }
  try {
    if (!is_canceled_) pending.render(pending.frame, pending.monitor);
  } catch (...) {
    leave();
    throw;
  }
  leave();
  pending.render = {};  // frees the scene
}

std::size_t PendingFrames::first() const { return frames_.front()->frame.index; }

bool PendingFrames::wait(std::chrono::milliseconds time) const {
  return frames_.front()->code.wait_for(time) != std::future_status::timeout;
}

void PendingFrames::cancel() {
  is_canceled_ = true;
  // The last first: when one ends, the next must not begin.
  for (const auto& pending : frames_ | std::views::reverse) pending->monitor.cancel = true;
}

std::pair<RenderedFrame, ExitCode> PendingFrames::take() {
  const std::unique_ptr<Pending> pending = std::move(frames_.front());
  frames_.pop_front();
  const ExitCode code = pending->code.get();
  env_.err << pending->messages.str() << std::flush;
  return {std::move(pending->frame), code};
}

}  // namespace sdlc::cli
