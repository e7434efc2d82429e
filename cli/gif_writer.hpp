#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "cli/video_writer.hpp"
#include "render/image/codec.hpp"

namespace sdlc::cli {

/// GIF without ffmpeg: each frame has its own palette, and is dithered. The encoded file is kept in
/// memory until it is whole.
class GifWriter final : public VideoWriter {
 public:
  GifWriter(std::filesystem::path path, const VideoSettings& settings);

  void add(std::span<const std::uint8_t> frame) override;
  void finish() override;
  /// The delays of GIF are whole hundredths of a second.
  double frames_per_second() const noexcept override { return 100.0 / delay_; }

 private:
  std::filesystem::path path_;
  int delay_;  // in 1/100 s
  std::unique_ptr<render::GifEncoder> encoder_;
};

}  // namespace sdlc::cli
