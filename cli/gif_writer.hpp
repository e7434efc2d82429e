#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "cli/video_writer.hpp"
#include "render/image/codec.hpp"

namespace sdlc::cli {

/// GIF without ffmpeg: each frame has its own palette, and is dithered. The delays of GIF are whole
/// hundredths of a second, at least 2; they differ where that keeps the time of all frames. The
/// encoded file is kept in memory until it is whole.
class GifWriter final : public VideoWriter {
 public:
  /// The rate is one that open_video() allows.
  GifWriter(std::filesystem::path path, const VideoSettings& settings);

  void add(std::span<const std::uint8_t> frame) override;
  void finish() override;
  double frames_per_second() const noexcept override { return frames_per_second_; }

 private:
  std::filesystem::path path_;
  double frames_per_second_;
  std::uint64_t frames_ = 0;
  std::unique_ptr<render::GifEncoder> encoder_;
};

}  // namespace sdlc::cli
