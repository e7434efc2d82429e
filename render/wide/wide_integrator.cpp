#include "render/wide/wide_integrator.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "render/camera/pinhole.hpp"
#include "render/film/sample_sum.hpp"
#include "render/sampler/sampler.hpp"
#include "render/scene/rebase.hpp"
#include "render/scene/touching.hpp"
#include "render/wide/path_kernel.hpp"
#include "render/wide/wide_scene.hpp"

namespace sdlc::render {
namespace {

// What a lane works on alone is a block of samples. Some thousands of them at a time keep all lanes
// busy to the end, and their sums in the cache.
constexpr std::uint64_t kBlocksAtATime = 4096;

template <typename T>
std::array<T, 3> rounded(Vec3 v) {
  return {static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
}

}  // namespace

class WideIntegrator::Tracer {
 public:
  virtual ~Tracer() = default;
  virtual bool render(std::uint64_t first, std::span<LinearRgb> means,
                      const std::atomic<bool>& cancel, const Report& report) const = 0;
  virtual std::size_t memory_bytes() const noexcept = 0;
};

/// The tracer in numbers of type T.
template <typename T>
class WideIntegrator::TracerIn final : public Tracer {
 public:
  TracerIn(const Scene& rebased, const Pinhole& pinhole, const RenderSettings& settings,
           const Options& options)
      : scene_(rebased, settings.depth, options.search, options.exact_spheres, options.lights),
        kernel_(wide_kernel<T>(options.isa, {.motion = scene_.has_motion,
                                             .exact_spheres = scene_.exact_spheres > 0,
                                             .bvh = options.search == Search::Bvh,
                                             .instances = !scene_.instances.empty(),
                                             .lights = scene_.lights.nodes > 0})),
        width_(static_cast<std::uint64_t>(settings.width)),
        height_(static_cast<std::uint64_t>(settings.height)),
        samples_(static_cast<std::uint64_t>(settings.samples)),
        seed_(settings.seed),
        corner_(pinhole.place(0, 1)),
        right_(pinhole.across() / settings.width),
        down_(-pinhole.upwards() / settings.height) {
    view_.sampler = settings.sampler;
    view_.emitters = options.emitters;
    if (samples_ == 1) {  // a picture of one sample a pixel looks through the middle of each
      corner_ = corner_ + (right_ - down_) * 0.5;
      return;
    }
    view_.right = rounded<T>(right_);
    view_.up = rounded<T>(-down_);
  }

  bool render(std::uint64_t first, std::span<LinearRgb> means, const std::atomic<bool>& cancel,
              const Report& report) const override {
    const std::uint64_t pixels = means.size();
    const std::uint64_t blocks = (samples_ + SampleSum::kBlock - 1) / SampleSum::kBlock;
    const std::uint64_t blocks_a_pass =
        std::clamp<std::uint64_t>(kBlocksAtATime / pixels, 1, blocks);
    std::vector<SampleSum> sums(blocks > 1 ? pixels : 0);
    std::vector<SampleBlock<T>> pass;
    std::vector<LinearRgb> pass_sums(pixels * blocks_a_pass);
    for (std::uint64_t block = 0; block < blocks; block += blocks_a_pass) {
      const std::uint64_t end = std::min(blocks, block + blocks_a_pass);
      pass.clear();
      for (std::uint64_t i = 0; i < pixels; ++i) add_blocks(first + i, block, end, pass);
      WideCounts counts;
      kernel_(scene_, view_, pass, pass_sums, counts, cancel);
      if (cancel.load(std::memory_order_relaxed)) return false;
      for (std::size_t i = 0; i < pass.size() && blocks > 1; ++i) {
        sums[i / (end - block)].add_block(pass_sums[i], pass[i].count);
      }
      report(pixels * (std::min(samples_, end * SampleSum::kBlock) - block * SampleSum::kBlock),
             counts);
    }
    for (std::uint64_t i = 0; i < pixels; ++i) {
      const LinearRgb sum = blocks > 1 ? sums[i].total() : pass_sums[i];
      means[i] = sum / static_cast<double>(samples_);
    }
    return true;
  }

  std::size_t memory_bytes() const noexcept override { return scene_.memory_bytes(); }

 private:
  void add_blocks(std::uint64_t pixel, std::uint64_t from, std::uint64_t to,
                  std::vector<SampleBlock<T>>& blocks) const {
    const auto x = static_cast<double>(pixel % width_);
    const auto y = static_cast<double>(pixel / width_ + 1);  // of the pixel's lower side
    SampleBlock<T> block{.corner = rounded<T>(corner_ + right_ * x + down_ * y),
                         .stream_key = PathSampler::stream_key(seed_, pixel, 0)};
    for (std::uint64_t i = from; i < to; ++i) {
      const std::uint64_t sample = i * SampleSum::kBlock;
      block.first = static_cast<std::uint32_t>(sample);
      block.count = static_cast<std::uint32_t>(std::min(SampleSum::kBlock, samples_ - sample));
      blocks.push_back(block);
    }
  }

  WideScene<T> scene_;
  TraceBlocks<T>* kernel_;
  std::uint64_t width_, height_, samples_, seed_;
  Vec3 corner_;        // of the picture, above and to the left
  Vec3 right_, down_;  // a pixel's sides
  WideView<T> view_{};
};

WideIntegrator::WideIntegrator(Scene scene, const RenderSettings& settings,
                               const Options& options) {
  const Pinhole pinhole(scene.camera);
  rebase_to_camera(scene, options.exact_spheres);
  part_touching(scene, options.precision, options.exact_spheres, options.near_pairs);
  if (options.precision == Precision::Double) {
    tracer_ = std::make_unique<TracerIn<double>>(scene, pinhole, settings, options);
  } else {
    tracer_ = std::make_unique<TracerIn<float>>(scene, pinhole, settings, options);
  }
}

WideIntegrator::~WideIntegrator() = default;

bool WideIntegrator::render(std::uint64_t first, std::span<LinearRgb> means,
                            const std::atomic<bool>& cancel, const Report& report) const {
  return tracer_->render(first, means, cancel, report);
}

std::size_t WideIntegrator::memory_bytes() const noexcept { return tracer_->memory_bytes(); }

}  // namespace sdlc::render
