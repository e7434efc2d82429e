#include "cli/gif_writer.hpp"

#include <cmath>
#include <cstddef>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "render/image/atomic_file.hpp"
#include "render/image/codec_loader.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::cli {

GifWriter::GifWriter(std::filesystem::path path, const VideoSettings& settings)
    : path_(std::move(path)),
      frames_per_second_(settings.frames_per_second),
      encoder_(render::image_codec(render::ImageFormat::Gif)
                   .make_gif_encoder(settings.width, settings.height)) {
  if (!encoder_) throw std::bad_alloc();
}

void GifWriter::add(std::span<const std::uint8_t> frame) {
  const auto time = [&](std::uint64_t index) {
    return std::round(100 * static_cast<double>(index) / frames_per_second_);
  };
  const auto delay = static_cast<std::uint16_t>(time(frames_ + 1) - time(frames_));
  ++frames_;
  std::string error;
  if (!encoder_->add(frame, delay, error)) throw render::IoError("write", path_, error);
}

void GifWriter::finish() {
  std::string error;
  std::vector<std::byte> file;
  if (!encoder_->finish(file, error)) throw render::IoError("write", path_, error);
  render::write_file_atomically(path_, file);
}

}  // namespace sdlc::cli
