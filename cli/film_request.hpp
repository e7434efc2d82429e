#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/outputs.hpp"
#include "cli/render_options.hpp"
#include "cli/shard_option.hpp"
#include "lang/source/sandbox.hpp"
#include "render/film/picture_record.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::cli {

/// What the film of a render is for.
struct FilmRequest {
  std::vector<std::filesystem::path> outputs;  ///< the film files to write in the end
  /// The first of them. If there is none, a file that is removed in the end.
  std::filesystem::path checkpoint;
  std::optional<double> checkpoint_seconds;  ///< between two of them
  bool resumes = false;                      ///< goes on from the checkpoint if it is there
  bool is_of_video = false;                  ///< the checkpoint is in the folder of kept frames
  std::optional<Shard> shard;                ///< of the samples or pixels, by `cut`
  render::ShardCut cut{};
};

/// What a choice depends on besides options and outputs.
struct FilmContext {
  std::optional<Shard> shard;              ///< unless it is one of frames
  const std::vector<std::string>& inputs;  ///< files, which must not be replaced
  const lang::Sandbox* sandbox = nullptr;  ///< contains what the scene names
  std::filesystem::path checkpoint = {};   ///< if it is not beside a picture
};

/// Which films a render of the outputs has; nullopt if none. Throws UsageError for what cannot be,
/// and for a checkpoint that would be lost.
std::optional<FilmRequest> choose_films(const RenderOptions& options,
                                        const std::vector<Output>& outputs,
                                        const render::RenderSettings& settings,
                                        const FilmContext& context);

}  // namespace sdlc::cli
