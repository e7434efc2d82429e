#include "cli/videos.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/frames.hpp"
#include "cli/picture_outputs.hpp"
#include "cli/report_failure.hpp"
#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "render/image/atomic_file.hpp"
#include "render/image/image.hpp"
#include "render/image/io_error.hpp"
#include "render/image/resize.hpp"

namespace sdlc::cli {

namespace fs = std::filesystem;

std::vector<std::string> Videos::take_from(std::vector<std::string>& outputs, std::size_t frames) {
  const auto is_video = [frames](const std::string& output) {
    const std::optional<VideoFormat> format = video_format_of(output);
    return format && !has_frame_mark(output) && (is_only_video(*format) || frames > 1);
  };
  const auto videos =
      std::ranges::stable_partition(outputs, [&](const auto& output) { return !is_video(output); });
  std::vector<std::string> names(videos.begin(), videos.end());
  outputs.erase(videos.begin(), videos.end());
  return names;
}

Videos::Videos(const std::vector<std::string>& names, VideoFrames frames,
               const RenderOptions& options, const std::atomic<bool>& interrupted, Environment& env)
    : frames_(std::move(frames)),
      crf_(options.crf),
      zoom_(options.zoom),
      interrupted_(&interrupted),
      resumes_(options.resumes) {
  for (const std::string& name : names) {
    std::error_code error;
    if (options.skips_existing && fs::file_size(name, error) > 0 && !error) {
      if (!options.quiet) {
        env.err << fmt::format("`{}` is there already\n", lang::printable(name));
      }
      continue;
    }
    videos_.push_back({.path = name, .format = *video_format_of(name), .writer = nullptr});
  }
  if (empty() || (!options.checkpoint_seconds && !options.resumes)) return;
  kept_.emplace(names.front(), options.zoom);
  if (std::error_code ignored; options.resumes || !fs::exists(kept_->folder(), ignored)) return;
  throw UsageError(
      fmt::format("`{}` exists; use --resume to go on from it, or remove it to begin "
                  "again",
                  lang::printable(kept_->folder().string())));
}

void Videos::check(const InputSet& inputs, OutputSet& outputs, bool keeps_existing) const {
  for (const Video& video : videos_) {
    check_video_writer(video.format, video.path);
    inputs.check_not_in(video.path);
    outputs.add(video.path);
    render::check_writable(video.path);
    if (std::error_code error;
        fs::exists(video.path, error) && !fs::is_regular_file(video.path, error)) {
      throw render::IoError("write", video.path, "it is not a regular file, as a video has to be");
    }
    if (keeps_existing) check_absent(video.path);
  }
}

fs::path Videos::checkpoint(int frame) const { return kept_ ? kept_->film(frame) : fs::path(); }

bool Videos::add_kept(int frame, const render::StoredFilm& film, Environment& env) {
  if (!kept_ || !resumes_) return false;
  std::optional<std::vector<std::uint8_t>> codes;
  try {
    codes = kept_->find(frame, film);
  } catch (const render::IoError& error) {
    warn(error, env);
  }
  if (!codes) return false;
  encode(*codes, film.origin.crop.width * zoom_, film.origin.crop.height * zoom_);
  return true;
}

void Videos::add(int frame, const render::Picture& picture, const render::ToneMapping& mapping,
                 const render::StoredFilm* film, Environment& env) {
  const render::Picture large = enlarged(picture, zoom_);
  if (kept_ && film != nullptr) {
    try {
      kept_->keep(frame, *film, large, mapping);
    } catch (const render::IoError& error) {  // the videos may still be finished
      warn(error, env);
    }
  }
  encode(codes_of(large, mapping), large.width, large.height);
}

void Videos::encode(std::span<const std::uint8_t> codes, int width, int height) {
  for (Video& video : videos_) {
    if (!video.writer) {
      video.writer = open_video(video.path, video.format,
                                {.width = width,
                                 .height = height,
                                 .frames = frames_.numbers.size(),
                                 .frames_per_second = frames_.per_second,
                                 .crf = crf_,
                                 .interrupted = interrupted_});
    }
    video.writer->add(codes);
  }
  ++encoded_;
}

ExitCode Videos::finish(bool are_frames_finished, bool is_quiet, Environment& env) {
  ExitCode code = ExitCode::Success;
  const std::size_t count = frames_.numbers.size();
  for (Video& video : videos_) {
    const std::string shown = lang::printable(video.path);
    if (encoded_ == count) {
      try_to_write(code, env, [&] {
        video.writer->finish();
        if (is_quiet) return;
        env.err << fmt::format("{}: {} {}, {} per second\n", shown, count,
                               count == 1 ? "frame" : "frames", video.writer->frames_per_second());
      });
    } else {
      env.err << fmt::format("error: `{}` was not written, because it has {} of {} frames\n", shown,
                             encoded_, count);
    }
    video.writer.reset();
  }
  if (!kept_) return code;
  if (code == ExitCode::Success && are_frames_finished && encoded_ == count) {
    kept_->remove(frames_.numbers);
  } else if (std::error_code ignored; fs::exists(kept_->folder(), ignored)) {
    env.err << fmt::format("--resume goes on from the frames in `{}`\n",
                           lang::printable(kept_->folder().string()));
  }
  return code;
}

}  // namespace sdlc::cli
