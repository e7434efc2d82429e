#include "cli/scene_pack.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "cli/outputs.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {

std::shared_ptr<const lang::Document> ScenePack::read_scene() {
  // The limits were checked when the pack was read.
  std::error_code error;
  return workspace_.load(scene(), std::numeric_limits<std::uint64_t>::max() - 1, error);
}

void ScenePack::confine(lang::ProgramOptions& program) {
  program.workspace = &workspace_;
  // Otherwise a scene could not read the files of the pack that are above its own folder.
  program.is_sandboxed = false;
}

std::shared_ptr<ScenePack> open_pack(const std::string& file, const lang::Limits& limits,
                                     const lang::Workspace& workspace) {
  constexpr std::uint64_t kBeginning = 4;
  if (file == kStandardStream || workspace.is_special(file)) return nullptr;
  std::error_code error;
  const auto beginning = workspace.read(file, kBeginning - 1, error);
  const bool is_pack = beginning && lang::is_zip(*beginning);
  if (!is_pack && !file.ends_with(kPackExtension)) return nullptr;
  const auto bytes = workspace.read(file, limits.any_file(), error);
  if (!bytes) throw render::IoError("read", file, error.message());
  if (bytes->size() > limits.any_file()) {
    throw render::IoError(
        "read", file,
        fmt::format("it has more than {} bytes; `--limit data=N` allows more", limits.any_file()));
  }
  try {
    return std::make_shared<ScenePack>(file, lang::read_pack(*bytes, limits));
  } catch (const lang::ZipError& reason) {
    throw render::IoError("read", file, reason.what());
  }
}

}  // namespace sdlc::cli
