#include "render/image/codec_loader.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <mutex>
#include <string>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "render/image/io_error.hpp"
#include "render/parallel/thread_probe.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleName = "sdlc_image_codec.so";
/// Relative to the folder of the program, both installed and in a build tree.
constexpr const char* kModuleFolder = "../lib/sdlc";
constexpr const char* kModulePathVariable = "SDLC_MODULE_PATH";

/// The folder of the module: the one that the environment names, otherwise the one beside the
/// running program (its resolved path, so that a link in /usr/local/bin works too).
fs::path module_folder() {
  if (const char* folder = std::getenv(kModulePathVariable); folder != nullptr && *folder != '\0') {
    return folder;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) {
    throw IoError("find", kModuleName,
                  fmt::format("/proc/self/exe cannot be read ({}); set {} to the folder it is in",
                              error.message(), kModulePathVariable));
  }
  return (program.parent_path() / kModuleFolder).lexically_normal();
}

fs::path find_module() {
  fs::path module = module_folder() / kModuleName;
  std::error_code error;
  if (!fs::is_regular_file(module, error)) {
    throw IoError("load", module,
                  fmt::format("this module, which reads and writes pictures, is missing; install "
                              "it or set {} to its folder",
                              kModulePathVariable));
  }
  return module;
}

/// Throws IoError if the system cannot start the threads that loading the module needs.
void check_threads(const fs::path& module) {
  const int startable = startable_threads(kCodecThreads);
  if (startable == kCodecThreads) return;
  throw IoError("load", module,
                fmt::format("its libraries need {1} threads, and only {0} more can be started "
                            "(`ulimit -u`, or a limit of the container)",
                            startable, kCodecThreads));
}

/// Loads the module for the rest of the process: OpenImageIO keeps threads and plugins that do not
/// survive unloading.
ImageCodec* load_codec(const fs::path& module) {
  // RTLD_LOCAL: the 260 libraries it depends on must not export symbols to the program.
  void* library = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw IoError("load", module, ::dlerror());
  void* symbol = ::dlsym(library, kImageCodecSymbol);
  if (symbol == nullptr) throw IoError("load", module, "it is not a picture module of sdlc");
  const ImageCodecEntry entry = reinterpret_cast<ImageCodecEntryFunction*>(symbol)();
  if (entry.version != kImageCodecVersion) {
    throw IoError("load", module,
                  fmt::format("it was built for another sdlc (interface {}, this program has {})",
                              entry.version, kImageCodecVersion));
  }
  return entry.codec;
}

/// Loads the codec once, in the first thread that needs it or in the background.
class Loader {
 public:
  ~Loader() {
    {
      const std::lock_guard lock(mutex_);
      is_abandoned_ = true;
    }
    wanted_.notify_all();  // else the process would wait for a codec that it does not need
  }

  ImageCodec& codec() {
    std::shared_future<ImageCodec*> loading;
    {
      const std::lock_guard lock(mutex_);
      is_wanted_ = true;
      if (!loading_.valid()) {
        const fs::path module = find_module();
        check_threads(module);
        loading_ = std::async(std::launch::deferred, load_codec, module).share();
      }
      loading = loading_;
    }
    wanted_.notify_all();
    return *loading.get();
  }

  void start(Preload when) {
    const std::lock_guard lock(mutex_);
    if (loading_.valid()) return;
    const fs::path module = find_module();
    check_threads(module);
    const auto wait_and_load = [this, module, when] {
      if (when == Preload::Late) {
        constexpr std::chrono::seconds kPatience(2);
        std::unique_lock waiting(mutex_);
        wanted_.wait_for(waiting, kPatience, [this] { return is_wanted_ || is_abandoned_; });
        if (is_abandoned_) return static_cast<ImageCodec*>(nullptr);
      }
      return load_codec(module);
    };
    try {
      loading_ = std::async(std::launch::async, wait_and_load).share();
    } catch (const std::system_error&) {
      // No thread is available: load on first use.
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable wanted_;
  bool is_wanted_ = false;
  bool is_abandoned_ = false;
  std::shared_future<ImageCodec*> loading_;
};

Loader& loader() {
  static Loader instance;
  return instance;
}

}  // namespace

ImageCodec& image_codec() { return loader().codec(); }

void preload_codec(Preload when) { loader().start(when); }

}  // namespace sdlc::render
