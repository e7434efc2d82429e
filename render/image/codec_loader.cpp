#include "render/image/codec_loader.hpp"

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <mutex>
#include <string>
#include <string_view>
#include <system_error>

#include <dlfcn.h>
#include <fmt/format.h>

#include "render/image/io_error.hpp"
#include "render/parallel/thread_probe.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;

struct ModuleInfo {
  std::string_view file;
  std::string_view use;  ///< what it is for
  int threads;           ///< that its libraries start while they are loaded
};

const ModuleInfo& describe(CodecModule module) noexcept {
  static constexpr std::array<ModuleInfo, 2> kModules{
      {{"sdlc_image_codec.so", "reads and writes PNG, EXR and PPM", 0},
       {"sdlc_openimageio.so",
        "reads and writes the other formats, and reads unusual PNG, EXR and PPM files (with alpha, "
        "for example)",
        kCodecThreads}}};
  return kModules[static_cast<std::size_t>(module)];
}

/// Relative to the folder of the program, both installed and in a build tree.
constexpr const char* kModuleFolder = "../lib/sdlc";
constexpr const char* kModulePathVariable = "SDLC_MODULE_PATH";

/// The folder of the module: the one that the environment names, otherwise the one beside the
/// running program (its resolved path, so that a link in /usr/local/bin works too).
fs::path module_folder(const ModuleInfo& info) {
  if (const char* folder = std::getenv(kModulePathVariable); folder != nullptr && *folder != '\0') {
    return folder;
  }
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) {
    throw IoError("find", info.file,
                  fmt::format("/proc/self/exe cannot be read ({}); set {} to the folder it is in",
                              error.message(), kModulePathVariable));
  }
  return (program.parent_path() / kModuleFolder).lexically_normal();
}

fs::path find_module(const ModuleInfo& info) {
  fs::path module = module_folder(info) / info.file;
  std::error_code error;
  if (!fs::is_regular_file(module, error)) {
    throw IoError(
        "load", module,
        fmt::format(
            "this module, which {}, is missing; install it, or set {} to the folder of the modules",
            info.use, kModulePathVariable));
  }
  return module;
}

/// Throws IoError if the system cannot start the threads that loading the module needs.
void check_threads(const ModuleInfo& info, const fs::path& module) {
  const int startable = startable_threads(info.threads);
  if (startable == info.threads) return;
  throw IoError("load", module,
                fmt::format("its libraries need {1} threads, and only {0} more can be started "
                            "(`ulimit -u`, or a limit of the container)",
                            startable, info.threads));
}

/// Loads the module for the rest of the process: OpenImageIO keeps threads and plugins that do not
/// survive unloading.
ImageCodec* load_codec(const fs::path& module) {
  // RTLD_LOCAL: the libraries it depends on (260 for OpenImageIO) must not export symbols to the
  // program.
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
  explicit Loader(CodecModule module) : info_(describe(module)) {}
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
        const fs::path module = find_module(info_);
        check_threads(info_, module);
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
    const fs::path module = find_module(info_);
    check_threads(info_, module);
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
  const ModuleInfo& info_;
  std::mutex mutex_;
  std::condition_variable wanted_;
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

CodecModule module_of(ImageFormat format) noexcept {
  switch (format) {
    case ImageFormat::Png:
    case ImageFormat::Exr:
    case ImageFormat::Ppm: return CodecModule::Standard;
    default: return CodecModule::OpenImageIo;
  }
}

ImageCodec& image_codec(CodecModule module) { return loader_of(module).codec(); }

void preload_image_codec(ImageFormat format, Preload when) {
  loader_of(module_of(format)).start(when);
}

}  // namespace sdlc::render
