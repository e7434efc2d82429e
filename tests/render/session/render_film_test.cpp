#include "render/session/render_film.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "render/film/film_file.hpp"
#include "render/math/fnv.hpp"
#include "render/scene/digest.hpp"
#include "tests/support/statistics/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::render {
namespace {

constexpr std::uint32_t kBlock = SampleSum::kBlock;

/// Every material, a lamp, motion, and a ground that is computed in double when the rest is float.
Scene room(double sky = 0.1) {
  Scene scene = test::beam_scene({0, 1, 4}, {0, 0, 0}, LinearRgb{sky});
  scene.camera.aspect = 1.5;
  scene.camera.plane_height = 1.2;
  test::add_sphere(scene, {0, -1e4 - 0.5, 0}, 1e4, test::diffuse({0.5, 0.6, 0.3}));
  test::add_sphere(scene, {-1, 0, 0}, 0.5, test::specular({0.8, 0.8, 0.6}, 0.2));
  test::add_sphere(scene, {0, 0, 0}, 0.5, test::transmissive({1, 1, 1}, 1.5));
  test::add_sphere(scene, {1, 0, 0}, 0.5, test::diffuse({0.9, 0.2, 0.1}));
  test::add_sphere(scene, {0.5, 1.5, -1}, 0.3, test::emissive({1, 0.9, 0.8}, 5));
  scene.shifts.assign(scene.spheres.size(), Vec3{});
  scene.shifts[3] = {0, 0.4, 0};
  return scene;
}

std::string bytes_of(const Picture& picture) {
  return {reinterpret_cast<const char*>(picture.pixels.data()),
          picture.pixels.size() * sizeof(LinearRgb)};
}

/// The parts of a picture that is cut at random pixels and blocks.
std::vector<FilmPart> random_parts(std::minstd_rand& random, std::size_t pixels,
                                   std::uint32_t replicates, std::size_t count) {
  const auto below = [&](std::size_t end) {
    return static_cast<std::uint32_t>(random() / 1024 % end);
  };
  std::vector<FilmPart> parts{{.extent = {.pixels = pixels, .replicates = replicates}}};
  for (int attempt = 0; attempt < 40 && parts.size() < count; ++attempt) {
    FilmPart& part = parts[below(parts.size())];
    FilmPart other = part;
    if (below(2) == 0 && part.extent.pixels > 1) {
      part.extent.pixels = 1 + below(part.extent.pixels - 1);
      other.extent.first_pixel += part.extent.pixels;
      other.extent.pixels -= part.extent.pixels;
    } else {
      const std::uint32_t at = kBlock * (1 + below(4));
      if (at <= part.extent.first_sample || at >= part.end_sample) continue;
      part.end_sample = other.extent.first_sample = at;
    }
    parts.push_back(other);
  }
  std::ranges::shuffle(parts, random);
  return parts;
}

/// The same with instances of two of its balls.
Scene room_with_instances(double sky) {
  Scene scene = room(sky);
  scene.prototypes.push_back({.spheres = {scene.spheres[1], scene.spheres[2]}, .shifts = {}});
  for (const double x : {-0.5, 0.3, 1.2}) {
    Instance& instance = scene.instances.emplace_back();
    instance.placement.translate = {x, 0.4, 0.8};
    instance.placement.scale = 0.3;
    instance.shift = {0, x / 4, 0};
  }
  return scene;
}

struct Case {
  std::string name;
  KernelRequest kernel;
  RenderSettings settings;
  bool has_instances = false, has_lens = false;

  Scene scene() const {
    // In the dark every pixel takes the most samples.
    const double sky = settings.is_adaptive ? 1 : 0.1;
    Scene scene = has_instances ? room_with_instances(sky) : room(sky);
    if (has_lens) scene.camera.aperture = 0.2, scene.camera.focus = 3;
    return scene;
  }
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

std::vector<Case> cases() {
  std::vector<Case> cases;
  const RenderSettings settings{.width = 30, .height = 20, .depth = 8, .seed = 3, .threads = 2};
  const auto add = [&](const std::string& name, const KernelRequest& kernel,
                       bool has_instances = false) {
    for (const SamplerKind sampler : {SamplerKind::Sobol, SamplerKind::Independent}) {
      for (const LightSampling lights :
           {LightSampling::On, LightSampling::Off, LightSampling::Caustics}) {
        Case one{name, kernel, settings, has_instances};
        one.settings.sampler = sampler;
        one.settings.light_sampling = lights;
        one.name += sampler == SamplerKind::Sobol ? "_sobol" : "_independent";
        if (lights != LightSampling::Off) {
          one.name += lights == LightSampling::On ? "_lights" : "_caustics";
        }
        for (const int samples : {5, 700, 1024}) {
          one.settings.samples = samples;
          cases.push_back(one);
          cases.back().name += "_" + std::to_string(samples);
          cases.back().has_lens = samples == 700;
        }
        one.settings.samples = 6000;
        one.settings.error = 0.02;
        one.settings.is_adaptive = true;
        cases.push_back(one);
        cases.back().name += "_adaptive";
      }
    }
  };
  add("scalar", {.backend = &portable_backend()});
  add("instances_scalar", {.backend = &portable_backend()}, true);
  for (const Backend* backend : available_vectors()) {
    add("instances_" + std::string(backend->name), {.backend = backend}, true);
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      const std::string name =
          std::string(backend->name) + (precision == Precision::Float ? "_float" : "_double");
      add(name, {.search = Search::All, .precision = precision, .backend = backend});
      add("bvh_" + name, {.search = Search::Bvh, .precision = precision, .backend = backend});
    }
  }
  return cases;
}

std::minstd_rand random_of(const Case& of) {
  Fnv1a hash;
  hash.add(of.name);
  return std::minstd_rand(static_cast<std::uint32_t>(hash.value()));
}

TEST(RandomParts, AreCutAtPixelsAndBlocksIntoOneToNine) {
  std::set<std::size_t> counts;
  std::size_t blocks = 0;
  for (const Case& of : cases()) {
    std::minstd_rand random = random_of(of);
    const auto parts = random_parts(random, 600, kReplicates, 1 + random() / 1024 % 9);
    counts.insert(parts.size());
    for (const FilmPart& part : parts) blocks += part.extent.first_sample > 0 ? 1 : 0;
  }
  EXPECT_EQ(counts.size(), 9u);
  EXPECT_GT(blocks, 100u);
}

class FilmParts : public testing::TestWithParam<Case> {};

TEST_P(FilmParts, GiveTheBytesOfARenderAtOnceHoweverItWasCut) {
  RenderSettings settings = GetParam().settings;
  settings.keeps_first_hits = settings.sampler == SamplerKind::Sobol;
  const Scene scene = GetParam().scene();
  const PreparedScene prepared = prepare(scene, settings, GetParam().kernel);
  if (GetParam().kernel.precision == Precision::Float) {
    EXPECT_EQ(prepared.kernel().precision, Precision::Mixed) << "the ground is computed in double";
  }
  RenderMonitor monitor;
  const RenderResult expected = render(prepared, settings, monitor);
  ASSERT_EQ(expected.samples_of_pixels.empty(), !settings.is_adaptive);
  std::vector<std::uint32_t> samples = expected.samples_of_pixels;
  if (samples.empty()) samples = {static_cast<std::uint32_t>(settings.samples)};

  // Cases differ in their cuts.
  std::minstd_rand random = random_of(GetParam());
  const std::uint32_t replicates =
      settings.samples < static_cast<int>(kMinReplicatedSamples) ? 1 : kReplicates;
  StoredFilm whole = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  for (const FilmPart& part :
       random_parts(random, expected.picture.pixels.size(), replicates, 1 + random() / 1024 % 9)) {
    StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
    EXPECT_TRUE(render_part(prepared, settings, monitor, part, samples, film));
    add_film(whole, film, "part");
  }
  ASSERT_EQ(whole.films.size(), 1u);
  const RenderResult merged = result_of(whole);
  EXPECT_EQ(bytes_of(merged.picture), bytes_of(expected.picture));
  EXPECT_TRUE(merged.features == expected.features);
  EXPECT_EQ(merged.samples_of_pixels, expected.samples_of_pixels);
  EXPECT_EQ(merged.scarce_emitters, expected.scarce_emitters);
  EXPECT_EQ(merged.rare_paths.size(), expected.rare_paths.size());
  EXPECT_EQ(merged.camera_samples, expected.camera_samples);
  ASSERT_EQ(merged.error.has_value(), expected.error.has_value());
  if (merged.error) {
    EXPECT_EQ(merged.error->relative_error, expected.error->relative_error);
    EXPECT_EQ(merged.error->interval.to, expected.error->interval.to);
  }
  EXPECT_EQ(whole.statistics.rays, expected.rays);
  EXPECT_EQ(whole.statistics.truncated_paths, expected.truncated_paths);
  for (std::size_t i = 0; i < expected.features.size(); ++i) {
    const Film& film = whole.films[0];
    ASSERT_EQ(features_of(film.first_hits(i), film.samples(i), prepared.tracer().depth_exponent()),
              expected.features[i]);
  }

  StoredFilm at_once = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  const FilmPart all{
      .extent = {.pixels = expected.picture.pixels.size(), .replicates = replicates}};
  EXPECT_TRUE(render_part(prepared, settings, monitor, all, samples, at_once));
  EXPECT_EQ(at_once.emitters, whole.emitters);
  const test::TemporaryFolder folder;
  write_film_file(folder / "whole", whole);
  write_film_file(folder / "at once", at_once);
  EXPECT_EQ(test::content_of(folder / "whole"), test::content_of(folder / "at once"));
}

INSTANTIATE_TEST_SUITE_P(RenderFilm, FilmParts, testing::ValuesIn(cases()),
                         [](const auto& c) { return c.param.name; });

TEST(RenderFilm, GoesOnWithMoreSamples) {
  RenderSettings settings{.width = 30, .height = 20, .samples = 200, .depth = 8};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  const FilmPart all{.extent = {.pixels = 600}};
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  for (const std::uint32_t samples : {200u, 201u, 900u}) {
    EXPECT_TRUE(render_part(prepared, settings, monitor, all, std::span(&samples, 1), film));
  }
  settings.samples = 900;
  EXPECT_EQ(monitor.samples_done.load(), 600u * 900);
  RenderMonitor again;
  const RenderResult expected = render(prepared, settings, again);
  EXPECT_EQ(bytes_of(result_of(film).picture), bytes_of(expected.picture));
  EXPECT_EQ(film.statistics.rays, expected.rays);
}

TEST(RenderFilm, GoesOnAfterACancelledRender) {
  const RenderSettings settings{.width = 30, .height = 20, .samples = 900, .depth = 8};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  const FilmPart all{.extent = {.pixels = 600}};
  const std::uint32_t samples = 900;
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor cancelled, monitor;
  cancelled.cancel = true;
  EXPECT_FALSE(render_part(prepared, settings, cancelled, all, std::span(&samples, 1), film));
  EXPECT_TRUE(render_part(prepared, settings, monitor, all, std::span(&samples, 1), film));
  const RenderResult expected = render(prepared, settings, monitor);
  EXPECT_EQ(bytes_of(result_of(film).picture), bytes_of(expected.picture));
}

/// Cancels a render whenever it has traced some samples, and starts it again, until it is complete.
/// Returns the last result; `samples` are those of all.
RenderResult render_in_pieces(const PreparedScene& prepared, const RenderSettings& settings,
                              StoredFilm& film, std::uint64_t& samples) {
  RenderResult result;
  for (int attempt = 0; attempt < 1000 && !result.is_complete; ++attempt) {
    RenderMonitor cancelled;
    std::jthread canceller([&](const std::stop_token& stop) {
      while (cancelled.samples_done == 0 && !stop.stop_requested()) std::this_thread::yield();
      cancelled.cancel = true;
    });
    result = render(prepared, settings, cancelled, &film);
    samples += result.new_samples;
  }
  return result;
}

TEST(RenderFilm, HasTheSameContentAfterItWasCancelledAndContinued) {
  const RenderSettings many_tiles{
      .width = 60, .height = 40, .samples = 2000, .depth = 8, .keeps_first_hits = true};
  // A tile is traced in several batches.
  const RenderSettings one_tile{
      .width = 8, .height = 8, .samples = 100'000, .depth = 2, .keeps_first_hits = true};
  for (const RenderSettings& settings : {many_tiles, one_tile}) {
    const Scene scene = room();
    const PreparedScene prepared = prepare(scene, settings);
    StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
    StoredFilm at_once = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
    RenderMonitor monitor;
    render(prepared, settings, monitor, &at_once);
    std::uint64_t samples = 0;
    render_in_pieces(prepared, settings, film, samples);
    const std::size_t pixels = extent_of(settings).pixels;
    EXPECT_EQ(samples, pixels * static_cast<std::uint64_t>(settings.samples));
    EXPECT_TRUE(bytes_of(result_of(film).picture) == bytes_of(result_of(at_once).picture));
    EXPECT_EQ(film.statistics, at_once.statistics);
    for (std::size_t i = 0; i < pixels; ++i) {
      const Film &a = film.films[0], &b = at_once.films[0];
      ASSERT_EQ(features_of(a.first_hits(i), a.samples(i), prepared.tracer().depth_exponent()),
                features_of(b.first_hits(i), b.samples(i), prepared.tracer().depth_exponent()));
    }
  }
}

TEST(RenderFilm, HasTheSamePassesAfterAnAdaptiveRenderWasCancelled) {
  const RenderSettings settings{
      .width = 30, .height = 20, .samples = 4000, .depth = 8, .error = 0.015, .is_adaptive = true};
  const Scene scene = room(1);
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  const RenderResult expected = render(prepared, settings, monitor);
  std::uint64_t samples = 0;
  const RenderResult result = render_in_pieces(prepared, settings, film, samples);
  EXPECT_EQ(samples, expected.camera_samples);
  EXPECT_EQ(result.samples_of_pixels, expected.samples_of_pixels);
  EXPECT_TRUE(bytes_of(result.picture) == bytes_of(expected.picture));
}

// A pass that was cut is no pass: it would be judged by a picture that is half of the one before.
TEST(RenderFilm, KeepsTheSamePassesOfAGoalAfterItWasCancelled) {
  const RenderSettings settings{
      .width = 60, .height = 40, .samples = 4000, .depth = 8, .error = 0.012};
  const Scene scene = room(1);
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  StoredFilm at_once = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  const RenderResult expected = render(prepared, settings, monitor, &at_once);
  std::uint64_t samples = 0;
  const RenderResult result = render_in_pieces(prepared, settings, film, samples);
  EXPECT_EQ(samples, expected.camera_samples);
  EXPECT_EQ(result.error->interval.to, expected.error->interval.to);
  ASSERT_EQ(film.passes.size(), at_once.passes.size());
  ASSERT_GT(film.passes.size(), 4u);
  for (std::size_t i = 0; i < film.passes.size(); ++i) {
    EXPECT_EQ(film.passes[i].samples, at_once.passes[i].samples);
    EXPECT_EQ(film.passes[i].to, at_once.passes[i].to) << i;
    EXPECT_EQ(film.passes[i].is_blind, at_once.passes[i].is_blind);
  }
}

TEST(RenderFilm, KnowsTheSameOfAPictureThatIsFinished) {
  RenderSettings settings{.width = 30, .height = 20, .samples = 64, .depth = 8};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  const RenderResult first = render(prepared, settings, monitor, &film);
  const RenderResult again = render(prepared, settings, monitor, &film);
  ASSERT_TRUE(first.error && again.error);
  EXPECT_EQ(again.error->relative_error, first.error->relative_error);
  EXPECT_EQ(again.scarce_emitters, first.scarce_emitters);
  EXPECT_EQ(again.rare_paths.size(), first.rare_paths.size());
  EXPECT_EQ(film.statistics.rays, first.rays);
}

TEST(RenderFilm, IsRefusedByOtherScenesAndSettings) {
  RenderSettings settings{.width = 30, .height = 20, .samples = 64, .depth = 8};
  const PreparedScene prepared = prepare(room(), settings);
  StoredFilm film = new_film(prepared, {}, "sdlc", settings);
  RenderMonitor monitor;
  settings.seed = 5;
  EXPECT_THROW(render(prepared, settings, monitor, &film), std::invalid_argument);
  settings.seed = 0;
  Scene darker = room();
  darker.spheres.pop_back();
  darker.shifts.pop_back();
  EXPECT_THROW(render(prepare(darker, settings), settings, monitor, &film), std::invalid_argument);
}

/// The picture of a film that was rendered with `first` and then goes on with `settings`.
RenderResult continued(const RenderSettings& first, const RenderSettings& settings,
                       RenderMonitor& monitor) {
  const Scene scene = room(1);
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", first);
  render(prepared, first, monitor, &film);
  return render(prepared, settings, monitor, &film);
}

TEST(RenderFilm, IsContinuedByARenderWithoutAGoal) {
  RenderSettings first{.width = 30, .height = 20, .samples = 70, .depth = 8}, settings = first;
  settings.samples = 300;
  RenderMonitor monitor, again;
  int passes = 0;
  monitor.on_pass = [&](const Film& film, const auto& /*error*/) {
    EXPECT_EQ(film.samples(599), ++passes == 1 ? 70u : 300u);
  };
  const RenderResult result = continued(first, settings, monitor);
  EXPECT_EQ(passes, 2);
  EXPECT_EQ(result.new_samples, 600u * (300 - 70));
  EXPECT_EQ(result.camera_samples, 600u * 300);
  const RenderResult expected = render(room(1), settings, again);
  EXPECT_EQ(bytes_of(result.picture), bytes_of(expected.picture));
  EXPECT_EQ(result.error->relative_error, expected.error->relative_error);
}

TEST(RenderFilm, IsContinuedTowardsAnError) {
  for (const bool is_adaptive : {false, true}) {
    RenderSettings first{.width = 30, .height = 20, .samples = 4000, .depth = 8, .error = 0.03},
        settings = first;
    first.is_adaptive = settings.is_adaptive = is_adaptive;
    settings.error = 0.015;
    RenderMonitor monitor;
    std::uint64_t samples = 0;
    monitor.on_pass = [&](const Film& film, const auto& /*error*/) {
      EXPECT_GE(film.samples(0), samples) << "samples were lost";
      samples = film.samples(0);
    };
    const RenderResult result = continued(first, settings, monitor);
    EXPECT_TRUE(result.has_reached_error);
    EXPECT_LE(result.error->interval.to, 0.015);
    EXPECT_EQ(result.samples_of_pixels.empty(), !is_adaptive);
    if (is_adaptive) continue;
    RenderMonitor again;
    const RenderResult at_once = render(room(1), settings, again);
    EXPECT_EQ(result.max_samples, at_once.max_samples);
    EXPECT_EQ(bytes_of(result.picture), bytes_of(at_once.picture));
    EXPECT_EQ(result.error->interval.to, at_once.error->interval.to);
  }
}

/// Renders with a checkpoint after every tile or so; goes on from each as a new process would, and
/// expects the same result.
void expect_same_from_checkpoints(const RenderSettings& settings) {
  const Scene scene = room(1);
  const PreparedScene prepared = prepare(scene, settings);
  const test::TemporaryFolder folder;
  int checkpoints = 0;
  RenderMonitor monitor;
  monitor.checkpoint_seconds = 0;
  monitor.on_checkpoint = [&](const StoredFilm& film) {
    constexpr int kEvery = 7, kMost = 100;
    if (checkpoints++ % kEvery != 0 || checkpoints > kMost) return;
    write_film_file(folder / std::to_string(checkpoints), film);
  };
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  const RenderResult expected = render(prepared, settings, monitor, &film);
  ASSERT_GT(checkpoints, 10);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    StoredFilm resumed = read_film_file(entry.path());
    RenderMonitor again;
    const RenderResult result = render(prepared, settings, again, &resumed);
    EXPECT_TRUE(bytes_of(result.picture) == bytes_of(expected.picture)) << entry.path();
    EXPECT_EQ(result.rays, expected.rays);
    EXPECT_EQ(result.camera_samples, expected.camera_samples);
    EXPECT_EQ(result.truncated_paths, expected.truncated_paths);
    EXPECT_EQ(result.scarce_emitters, expected.scarce_emitters);
    EXPECT_EQ(resumed.emitters, film.emitters);
    ASSERT_TRUE(result.error && expected.error);
    EXPECT_EQ(result.error->interval.to, expected.error->interval.to);
  }
}

TEST(RenderFilm, HasTheSameResultFromEveryCheckpoint) {
  expect_same_from_checkpoints({.width = 60, .height = 40, .samples = 500, .depth = 8});
}

TEST(RenderFilm, HasTheSameResultFromEveryCheckpointOfARenderTowardsAnError) {
  for (const bool is_adaptive : {false, true}) {
    expect_same_from_checkpoints({.width = 60,
                                  .height = 40,
                                  .samples = 4000,
                                  .depth = 8,
                                  .error = 0.02,
                                  .is_adaptive = is_adaptive});
  }
}

/// The pixels of a window of a picture.
Picture part_of(const Picture& whole, const PixelWindow& window) {
  Picture part(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) part.at(x, y) = whole.at(window.x + x, window.y + y);
  }
  return part;
}

TEST(Crop, HasThePixelsOfTheWholePicture) {
  const RenderSettings plain{.width = 30, .height = 20, .samples = 20, .depth = 8};
  RenderSettings caustics = plain, independent = plain, few = plain;
  caustics.light_sampling = LightSampling::Caustics;
  independent.sampler = SamplerKind::Independent;
  few.samples = 3;
  std::minstd_rand random(7);
  const auto below = [&](int end) { return static_cast<int>(random() / 1024) % end; };
  for (const RenderSettings& settings : {plain, caustics, independent, few}) {
    for (const bool has_lens : {false, true}) {
      Scene scene = room_with_instances(0.1);
      if (settings.light_sampling == LightSampling::Caustics) scene.instances.clear();
      if (has_lens) scene.camera.aperture = 0.2, scene.camera.focus = 3;
      const PreparedScene prepared = prepare(scene, settings);
      RenderMonitor monitor;
      const RenderResult whole = render(prepared, settings, monitor);
      for (int i = 0; i < 4; ++i) {
        RenderSettings cropped = settings;
        const int x = below(30), y = below(20);
        cropped.crop = {.x = x, .y = y, .width = 1 + below(30 - x), .height = 1 + below(20 - y)};
        const RenderResult part = render(prepared, cropped, monitor);
        EXPECT_TRUE(bytes_of(part.picture) == bytes_of(part_of(whole.picture, *cropped.crop)));
        if (settings.samples < 8) EXPECT_FALSE(part.error);
        EXPECT_EQ(part.camera_samples,
                  cropped.crop->pixels() * static_cast<std::uint64_t>(settings.samples));
      }
    }
  }
}

TEST(Crop, IsWhatAGoalAndAFilterAreFor) {
  RenderSettings settings{
      .width = 60, .height = 40, .samples = 4000, .depth = 8, .error = 0.05, .is_denoised = true};
  settings.crop = {.x = 10, .y = 5, .width = 32, .height = 24};
  const Scene scene = room(1);
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  const RenderResult result = render(prepared, settings, monitor, &film);
  EXPECT_TRUE(result.has_reached_error);
  EXPECT_EQ(result.picture.pixels.size(), 32u * 24);
  EXPECT_EQ(settings_of(film).crop, settings.crop);
  RenderSettings other = settings;
  other.crop->x = 11;
  EXPECT_THROW(render(prepared, other, monitor, &film), std::invalid_argument);
}

TEST(RenderFilm, TakesOnlyThePixelsOfACrop) {
  const RenderSettings settings{.width = 30, .height = 20, .samples = 64, .depth = 8};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  // Columns 10 to 14 of the rows 5 to 7.
  std::vector<std::uint32_t> samples(600, 0);
  for (std::size_t y = 5; y < 8; ++y) {
    for (std::size_t x = 10; x < 15; ++x) samples[30 * y + x] = 64;
  }
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  const FilmPart rows{.extent = {.first_pixel = 30 * 5, .pixels = 30 * 3}};
  EXPECT_TRUE(render_part(prepared, settings, monitor, rows, samples, film));
  EXPECT_EQ(monitor.samples_done.load(), 15u * 64);
  const Picture crop = result_of(film).picture, whole = render(prepared, settings, monitor).picture;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    EXPECT_EQ(crop.pixels[i], samples[i] > 0 ? whole.pixels[i] : LinearRgb{}) << i;
  }
}

TEST(RenderFilm, IsContinuedFromPartsOfThePicture) {
  const RenderSettings settings{
      .width = 30, .height = 20, .samples = 900, .depth = 8, .keeps_first_hits = true};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  RenderMonitor monitor;
  std::uint32_t samples = 900;
  const FilmPart top{.extent = {.pixels = 100}};
  const FilmPart middle{.extent = {.first_pixel = 210, .pixels = 90}, .end_sample = 64};
  EXPECT_TRUE(render_part(prepared, settings, monitor, top, std::span(&samples, 1), film));
  EXPECT_TRUE(render_part(prepared, settings, monitor, middle, std::span(&samples, 1), film));
  EXPECT_EQ(film.films.size(), 2u);
  const RenderResult result = render(prepared, settings, monitor, &film);
  EXPECT_EQ(film.films.size(), 1u);
  EXPECT_EQ(monitor.samples_done.load(), 600u * 900);
  const RenderResult expected = render(prepared, settings, monitor);
  EXPECT_TRUE(bytes_of(result.picture) == bytes_of(expected.picture));
  EXPECT_EQ(result.features, expected.features);

  const FilmPart other{.extent = {.first_pixel = 5, .pixels = 10, .first_sample = 64}};
  EXPECT_THROW(render_part(prepared, settings, monitor, other, std::span(&samples, 1), film),
               std::invalid_argument);
}

TEST(RenderFilm, HasTheOriginOfItsPicture) {
  RenderSettings settings{.width = 30, .height = 20, .samples = 64, .depth = 8};
  const Scene scene = room();
  const PreparedScene prepared = prepare(scene, settings);
  const StoredFilm film = new_film(prepared, digest_of_parts(scene), "sdlc", settings);
  settings.depth = 9;
  EXPECT_NE(new_film(prepared, digest_of_parts(scene), "sdlc", settings).origin, film.origin);
  settings.depth = 8;
  settings.samples = 128;  // a render may go on
  EXPECT_EQ(new_film(prepared, digest_of_parts(scene), "sdlc", settings).origin, film.origin);
  Scene other = scene;
  other.spheres[0].radius = 99;
  EXPECT_NE(new_film(prepared, digest_of_parts(other), "sdlc", settings).origin, film.origin);
}

}  // namespace
}  // namespace sdlc::render
