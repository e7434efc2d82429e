#include "render/image/codec_loader.hpp"

#include <array>
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <future>
#include <mutex>
#include <system_error>

#include "render/image/codec_module.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

/// Loads the codec once, in the first thread that needs it or in the background.
class Loader {
 public:
  explicit Loader(CodecModule module) : module_(module) {}
  ~Loader() {
    {
      const std::lock_guard lock(mutex_);
      is_abandoned_ = true;
    }
    wanted_.notify_all();  // else the process would wait for a codec that it does not need
  }
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  ImageCodec& codec() {
    std::shared_future<ImageCodec*> loading;
    {
      const std::lock_guard lock(mutex_);
      is_wanted_ = true;
      if (!loading_.valid()) {
        const fs::path file = find_codec(module_);
        loading_ = std::async(std::launch::deferred, load_codec, file).share();
      }
      loading = loading_;
    }
    wanted_.notify_all();
    return *loading.get();
  }

  void check() {
    const std::lock_guard lock(mutex_);
    if (is_found_ || loading_.valid()) return;
    find_codec(module_);
    is_found_ = true;
  }

  void start(Preload when) {
    const std::lock_guard lock(mutex_);
    if (loading_.valid()) return;
    const fs::path file = find_codec(module_);
    const auto wait_and_load = [this, file, when] {
      if (when == Preload::Late) {
        constexpr std::chrono::seconds kPatience(2);
        std::unique_lock waiting(mutex_);
        wanted_.wait_for(waiting, kPatience, [this] { return is_wanted_ || is_abandoned_; });
        if (is_abandoned_) return static_cast<ImageCodec*>(nullptr);
      }
      return load_codec(file);
    };
    try {
      loading_ = std::async(std::launch::async, wait_and_load).share();
    } catch (const std::system_error&) {
      // No thread is available: load on first use.
    }
  }

 private:
  CodecModule module_;
  std::mutex mutex_;
  std::condition_variable wanted_;
  bool is_found_ = false;
  bool is_wanted_ = false;
  bool is_abandoned_ = false;
  std::shared_future<ImageCodec*> loading_;
};

Loader& loader_of(CodecModule module) {
  static std::array<Loader, 2> instances{Loader(CodecModule::Standard),
                                         Loader(CodecModule::OpenImageIo)};
  return instances[static_cast<std::size_t>(module)];
}

}  // namespace

ImageCodec& image_codec(CodecModule module) { return loader_of(module).codec(); }

void check_image_codec(ImageFormat format) { loader_of(module_of(format)).check(); }

void preload_image_codec(ImageFormat format, Preload when) {
  loader_of(module_of(format)).start(when);
}

}  // namespace sdlc::render
