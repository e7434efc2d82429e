#include "cli/gif_writer.hpp"

#include <algorithm>
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
namespace {

int delay_of(double frames_per_second) {
  // Browsers play shorter delays as 10. The field has 16 bits.
  constexpr double kMin = 2, kMax = 65535;
  return static_cast<int>(std::clamp(std::round(100 / frames_per_second), kMin, kMax));
}

}  // namespace

GifWriter::GifWriter(std::filesystem::path path, const VideoSettings& settings)
    : path_(std::move(path)),
      delay_(delay_of(settings.frames_per_second)),
      encoder_(render::image_codec().make_gif_encoder(settings.width, settings.height, delay_)) {
  if (!encoder_) throw std::bad_alloc();
}

void GifWriter::add(std::span<const std::uint8_t> frame) {
  std::string error;
  if (!encoder_->add(frame, error)) throw render::IoError("write", path_, error);
}

void GifWriter::finish() {
  std::string error;
  std::vector<std::byte> file;
  if (!encoder_->finish(file, error)) throw render::IoError("write", path_, error);
  render::write_file_atomically(path_, file);
}

}  // namespace sdlc::cli
