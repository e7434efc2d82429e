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
#include "render/image/thread_probe.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModuleName = "sdlc_image_codec.so";
/// Seen from the folder of the program, in an installation as in a build tree.
constexpr const char* kModuleFolder = "../lib/sdlc";
constexpr const char* kModulePathVariable = "SDLC_MODULE_PATH";

/// The folder that holds the module: the one the environment names, else the one beside the program
/// that is running (its real place, so that a link to it in /usr/local/bin works too).
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
                  fmt::format("pictures are read and written by this module, and it is not there; "
                              "install it or set {} to its folder",
                              kModulePathVariable));
  }
  return module;
}

/// Throws IoError where the module cannot be loaded in good order.
void check_threads(const fs::path& module) {
  const int startable = startable_threads(kCodecThreads);
  if (startable == kCodecThreads) return;
  throw IoError("load", module,
                fmt::format("its libraries start threads, and the system lets {} more start where "
                            "{} are needed (`ulimit -u`, or a limit of the container)",
                            startable, kCodecThreads));
}

/// Loads the module for the rest of the process: OpenImageIO keeps threads and plugins that do not
/// survive an unloading.
ImageCodec* load_codec(const fs::path& module) {
  // Local: the 260 libraries behind it lend their symbols to nobody else.
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

/// Loads once, in the thread that comes first or in the background.
class Loader {
 public:
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

  /// Waits a little, or until the module is wanted: loading takes a quarter of a second of a core,
  /// which a picture that takes no longer is better traced with.
  void start() {
    const std::lock_guard lock(mutex_);
    if (loading_.valid()) return;
    const fs::path module = find_module();
    check_threads(module);
    const auto wait_and_load = [this, module] {
      constexpr std::chrono::seconds kPatience(2);
      std::unique_lock waiting(mutex_);
      wanted_.wait_for(waiting, kPatience, [this] { return is_wanted_; });
      waiting.unlock();
      return load_codec(module);
    };
    try {
      loading_ = std::async(std::launch::async, wait_and_load).share();
    } catch (const std::system_error&) {
      // There is no further thread: it is loaded when it is wanted.
    }
  }

 private:
  std::mutex mutex_;
  std::condition_variable wanted_;
  bool is_wanted_ = false;
  std::shared_future<ImageCodec*> loading_;
};

Loader& loader() {
  static Loader instance;
  return instance;
}

}  // namespace

ImageCodec& image_codec() { return loader().codec(); }

void preload_codec() { loader().start(); }

}  // namespace sdlc::render
