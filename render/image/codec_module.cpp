#include "render/image/codec_module.hpp"

#include <array>
#include <cstdlib>
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
  std::string_view package;  ///< of Debian
  std::string_view use;      ///< what it is for
  int threads;               ///< that its libraries start while they are loaded
};

const ModuleInfo& describe(CodecModule module) noexcept {
  static constexpr std::array<ModuleInfo, 2> kModules{
      {{"sdlc_image_codec.so", "sdlc", "reads and writes PNG, EXR and PPM", 0},
       {"sdlc_openimageio.so", "sdlc-openimageio",
        "reads and writes the other formats, and reads unusual PNG, EXR and PPM files (with alpha, "
        "for example)",
        kCodecThreads}}};
  return kModules[static_cast<std::size_t>(module)];
}

/// Relative to the folder of the program, both installed and in a build tree.
constexpr const char* kModuleFolder = "../" SDLC_MODULE_DIR;
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
            "this module, which {}, is missing; install it (Debian package {}), or set {} to the "
            "folder of the modules",
            info.use, info.package, kModulePathVariable));
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

}  // namespace

CodecModule module_of(ImageFormat format) noexcept {
  switch (format) {
    case ImageFormat::Png:
    case ImageFormat::Exr:
    case ImageFormat::Ppm: return CodecModule::Standard;
    default: return CodecModule::OpenImageIo;
  }
}

fs::path find_codec(CodecModule module) {
  const ModuleInfo& info = describe(module);
  fs::path file = find_module(info);
  check_threads(info, file);
  return file;
}

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

}  // namespace sdlc::render
