#include "cli/film_request.hpp"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "render/session/shards.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

/// Chooses samples or tiles.
render::ShardCut choose_cut(std::uint32_t count, std::optional<ShardBy> by,
                            const render::RenderSettings& settings) {
  using render::ShardCut;
  const auto is_possible = [&](ShardCut cut) { return max_shards(settings, cut) >= count; };
  if (by == ShardBy::Frames) {
    throw UsageError("--shard-by frames: the scene has no `animation`");
  }
  ShardCut cut = is_possible(ShardCut::Samples) ? ShardCut::Samples : ShardCut::Tiles;
  if (by) {
    cut = *by == ShardBy::Samples ? ShardCut::Samples : ShardCut::Tiles;
  }
  if (is_possible(cut)) return cut;
  throw UsageError(fmt::format(
      "--shard: {} can be divided into at most {} shards{}",
      cut == ShardCut::Samples
          ? fmt::format("{} samples", settings.samples)
          : fmt::format("{} x {} pixels", settings.window().width, settings.window().height),
      max_shards(settings, cut),
      cut == ShardCut::Samples && is_possible(ShardCut::Tiles) ? "; use --shard-by tiles" : ""));
}

void check_shard(const std::vector<Output>& outputs, const render::RenderSettings& settings) {
  if (settings.has_goal()) {
    throw UsageError(fmt::format(
        "--shard: --{} decides on the whole picture, which a shard does not have; use --samples",
        settings.error ? "error" : "time"));
  }
  if (settings.is_denoised) {
    throw UsageError("--shard: --denoise needs the whole picture, which a shard does not have");
  }
  for (const Output& output : outputs) {
    if (output.is_film) continue;
    throw UsageError(fmt::format(
        "a shard of a picture is a film: use -o NAME.film instead of `{}`, and `sdlc merge`",
        lang::printable(output.path.string())));
  }
}

/// Throws UsageError, because --resume would use the checkpoint.
[[noreturn]] void refuse_to_replace(const fs::path& checkpoint, std::string_view state) {
  throw UsageError(
      fmt::format("`{}` exists{}; use --resume to go on from it, or remove it to begin again",
                  lang::printable(checkpoint.string()), state));
}

/// The checkpoint of the context, otherwise the one beside the first picture.
fs::path choose_checkpoint(const std::vector<Output>& outputs, const FilmContext& context) {
  if (!context.checkpoint.empty()) return context.checkpoint;
  const auto named = std::ranges::find(outputs, false, &Output::is_stdout);
  if (named == outputs.end()) {
    throw UsageError("--checkpoint and --resume require a file to write, such as -o NAME.png");
  }
  fs::path checkpoint = fs::path(named->path).replace_extension(".film");
  if (named->may_make_folders && context.sandbox && !context.sandbox->resolve(checkpoint)) {
    throw UsageError(fmt::format(
        "`{}` is outside the scene's folder, which --sandbox refuses; use -o to choose another "
        "place",
        lang::printable(checkpoint.string())));
  }
  InputSet(context.inputs).check_not_in(checkpoint.string());
  return checkpoint;
}

}  // namespace

std::optional<FilmRequest> choose_films(const RenderOptions& options,
                                        const std::vector<Output>& outputs,
                                        const render::RenderSettings& settings,
                                        const FilmContext& context) {
  FilmRequest request{.outputs = {},
                      .checkpoint = {},
                      .checkpoint_seconds = options.checkpoint_seconds,
                      .resumes = options.resumes,
                      .shard = context.shard};
  if (context.shard) {
    check_shard(outputs, settings);
    request.cut = choose_cut(context.shard->count, options.shard_by, settings);
  }
  for (const Output& output : outputs) {
    if (output.is_film) request.outputs.push_back(output.path);
  }
  if (!request.outputs.empty()) {
    request.checkpoint = request.outputs.front();
    if (options.checkpoint_seconds && !options.resumes &&
        film_state(request.checkpoint) == FilmState::Unfinished) {
      refuse_to_replace(request.checkpoint, " and is not finished");
    }
    return request;
  }
  if (!options.checkpoint_seconds && !options.resumes) return std::nullopt;
  request.checkpoint = choose_checkpoint(outputs, context);
  request.is_of_video = !context.checkpoint.empty();
  std::error_code error;
  if (!options.resumes && fs::exists(request.checkpoint, error)) {
    refuse_to_replace(request.checkpoint, "");
  }
  return request;
}

}  // namespace sdlc::cli
