#include "cli/serve_render.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <sstream>
#include <utility>

#include "cli/report_failure.hpp"

namespace sdlc::cli {
namespace {

/// A picture of more pixels than this is first shown with fewer.
constexpr double kFirstLook = 48'000;

/// The settings of a smaller picture of one sample per pixel.
render::RenderSettings first_look_of(render::RenderSettings settings) {
  const double pixels = static_cast<double>(settings.width) * settings.height;
  const double scale = std::sqrt(kFirstLook / pixels);
  settings.width = std::max(1, static_cast<int>(std::lround(settings.width * scale)));
  settings.height = std::max(1, static_cast<int>(std::lround(settings.height * scale)));
  settings.samples = 1;
  settings.error.reset();
  settings.seconds.reset();
  settings.is_adaptive = settings.is_denoised = false;
  settings.keeps_variance = settings.keeps_first_hits = false;
  return settings;
}

std::shared_ptr<ServedPicture> new_picture(const ServeRender::Order& order) {
  auto picture = std::make_shared<ServedPicture>();
  picture->scene = order.scene;
  picture->settings = order.settings;
  picture->mapping = order.mapping;
  picture->seconds = render::seconds_since(order.start);
  return picture;
}

}  // namespace

bool ServeRender::report(const Order& order, const Environment& env,
                         const std::function<void()>& work) {
  std::ostringstream messages;
  Environment quiet = env.with_err(messages);
  ExitCode code = ExitCode::Usage;
  try {
    code = report_failure(quiet, [&] {
      work();
      return ExitCode::Success;
    });
  } catch (const std::exception& error) {  // no thread could be started
    messages << "error: " << error.what() << '\n';
  }
  if (code == ExitCode::Success) return true;
  handlers_.failed(order.scene, messages.str());
  return false;
}

ServeRender::Progress ServeRender::progress_of(const render::RenderSettings& settings,
                                               const render::RenderMonitor& monitor,
                                               double seconds) {
  Progress progress{.is_running = true};
  const double total =
      static_cast<double>(settings.samples) * static_cast<double>(settings.window().pixels());
  progress.share = settings.has_goal()
                       ? monitor.goal_share.load()
                       : std::min(1.0, static_cast<double>(monitor.samples_done.load()) / total);
  progress.seconds_left =
      progress.share > 0 ? seconds * (1 - progress.share) / progress.share : HUGE_VAL;
  return progress;
}

void ServeRender::show_first_look(const Order& order, render::RenderMonitor& monitor) {
  next_ = {};
  const double pixels = static_cast<double>(order.settings.width) * order.settings.height;
  if (pixels <= 2 * kFirstLook) return;
  auto picture = new_picture(order);
  picture->result = render::render(*order.prepared, first_look_of(order.settings), monitor);
  if (monitor.cancel) return;
  monitor.samples_done = monitor.rays_done = 0;
  picture->seconds = render::seconds_since(order.start);
  handlers_.shown(std::move(picture));
}

void ServeRender::show_pass(const Order& order, const render::Film& film,
                            const std::function<render::ErrorSoFar()>& error) {
  constexpr std::chrono::milliseconds kPause(80);
  if (render::Clock::now() < next_) return;
  auto picture = new_picture(order);
  render::RenderResult& result = picture->result;
  result.kernel = order.prepared->kernel();
  result.picture = render::Picture(picture->width(), picture->height());
  for (std::size_t i = 0; i < film.size(); ++i) result.picture.pixels[i] = film.mean(i);
  const render::SampleCounts counts = film.sample_counts();
  result.min_samples = counts.min;
  result.max_samples = counts.max;
  if (counts.min != counts.max) {
    for (std::size_t i = 0; i < film.size(); ++i) {
      result.samples_of_pixels.push_back(static_cast<std::uint32_t>(film.samples(i)));
    }
  }
  const bool has_error = counts.min >= render::kMinReplicatedSamples;
  if (has_error) {
    render::ErrorSoFar known = error();
    result.error = known.error;
    result.rare_paths = std::move(known.rare_paths);
    result.scarce_emitters = std::move(known.scarce_emitters);
  }
  if (wants_channels_) {
    const int depth_exponent = order.prepared->tracer().depth_exponent();
    for (std::size_t i = 0; i < film.size(); ++i) {
      result.features.push_back(
          render::features_of(film.first_hits(i), film.samples(i), depth_exponent));
    }
    if (has_error) {
      result.variance = render::Picture(picture->width(), picture->height());
      for (std::size_t i = 0; i < film.size(); ++i) result.variance.pixels[i] = film.variance(i);
    }
  }
  handlers_.shown(std::move(picture));
  next_ = render::Clock::now() + kPause;
}

void ServeRender::show_finished(const Order& order, render::RenderResult result) {
  auto picture = new_picture(order);
  picture->result = std::move(result);
  picture->is_finished = true;
  handlers_.shown(std::move(picture));
}

}  // namespace sdlc::cli
