#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "render/image/standard/formats.hpp"

namespace sdlc::render::standard {
namespace {

/// Messages of the library name it.
constexpr const char* kNoFileName = "the file";
constexpr int kMaxChannels = 1024;
constexpr std::array<const char*, 3> kColors{"R", "G", "B"};

class MemoryOutput final : public Imf::OStream {
 public:
  MemoryOutput() : OStream(kNoFileName) {}

  void write(const char bytes[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    if (file_.size() < at_ + count) file_.resize(at_ + count);
    std::memcpy(file_.data() + at_, bytes, count);
    at_ += count;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  std::vector<std::byte> take() { return std::move(file_); }

 private:
  std::vector<std::byte> file_;
  std::size_t at_ = 0;
};

class MemoryInput final : public Imf::IStream {
 public:
  explicit MemoryInput(std::span<const std::byte> file) : IStream(kNoFileName), file_(file) {}

  bool read(char bytes[], int size) override {
    const auto count = static_cast<std::size_t>(size);
    if (at_ > file_.size() || file_.size() - at_ < count)
      throw std::runtime_error("it is truncated");
    std::memcpy(bytes, file_.data() + at_, count);
    at_ += count;
    return at_ < file_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::span<const std::byte> file_;
  std::size_t at_ = 0;
};

/// The slice of rows of `width` floats, `stride` floats from pixel to pixel, whose first pixel is
/// at the corner of `window`. The library takes the address of the pixel at (0, 0).
Imf::Slice slice_of(const float* values, std::size_t stride, const Imath::Box2i& window) {
  const std::size_t step = stride * sizeof(float);
  const std::size_t row = step * static_cast<std::size_t>(window.max.x - window.min.x + 1);
  return Imf::Slice::Make(Imf::FLOAT, const_cast<float*>(values), window, step, row);
}

Imath::Box2i window_of(int x, int y, int width, int height) {
  return {{x, y}, {x + width - 1, y + height - 1}};
}

PixelWindow window_of(const Imath::Box2i& box) {
  return {box.min.x, box.min.y, box.max.x - box.min.x + 1, box.max.y - box.min.y + 1};
}

}  // namespace

std::vector<std::byte> encode_exr(const EncodeRequest& request) {
  const bool is_part = request.display.pixels() > 0;
  const Imath::Box2i data =
      window_of(is_part ? -request.display.x : 0, is_part ? -request.display.y : 0, request.width,
                request.height);
  const Imath::Box2i display =
      is_part ? window_of(0, 0, request.display.width, request.display.height) : data;
  Imf::Header header(display, data);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer pixels;
  const auto add = [&](const std::string& name, const float* values, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    pixels.insert(name, slice_of(values, stride, data));
  };
  for (std::size_t c = 0; c < kColors.size(); ++c) add(kColors[c], &request.radiance[c], 3);
  for (const EncodeChannel& channel : request.channels) {
    add(std::string(channel.name), channel.values.data(), 1);
  }
  if (!request.software.empty()) {
    header.insert("Software", Imf::StringAttribute(request.software));
  }
  for (const auto& [key, value] : request.metadata) {
    header.insert(key, Imf::StringAttribute(value));
  }
  MemoryOutput memory;
  {
    // In its own scope: the table of rows is written at the end. No threads: encoding is a small
    // part of a render and must not compete with it for the cores.
    Imf::OutputFile file(memory, header, 0);
    file.setFrameBuffer(pixels);
    file.writePixels(request.height);
  }
  return memory.take();
}

DecodedImage decode_exr(std::span<const std::byte> file, std::int64_t max_pixels) {
  {
    MemoryInput memory(file);
    const Imf::MultiPartInputFile parts(memory, 0);
    if (parts.parts() != 1 || Imf::isDeepData(parts.header(0).type())) throw ForeignFile();
  }
  MemoryInput memory(file);
  Imf::InputFile input(memory, 0);
  const Imf::Header& header = input.header();
  DecodedImage image;
  image.data = window_of(header.dataWindow());
  image.display = window_of(header.displayWindow());
  check_size(image.data.width, image.data.height, max_pixels);
  image.width = image.data.width;
  image.height = image.data.height;

  // Colours first.
  for (const char* const color : kColors) {
    if (header.channels().findChannel(color) == nullptr) throw ForeignFile();
    image.channels.emplace_back(color);
  }
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    const Imf::Channel& kind = channel.channel();
    if (kind.type == Imf::UINT || kind.xSampling != 1 || kind.ySampling != 1) throw ForeignFile();
    if (std::ranges::find(kColors, std::string_view(channel.name())) == kColors.end()) {
      image.channels.emplace_back(channel.name());
    }
  }
  if (image.channels.size() > kMaxChannels) {
    throw std::runtime_error("it has more than " + std::to_string(kMaxChannels) + " channels");
  }
  if (!input.isComplete()) throw std::runtime_error("it is truncated");

  const std::size_t count = image.channels.size();
  image.values.resize(image.data.pixels() * count);
  Imf::FrameBuffer pixels;
  for (std::size_t c = 0; c < count; ++c) {
    pixels.insert(image.channels[c], slice_of(&image.values[c], count, header.dataWindow()));
  }
  input.setFrameBuffer(pixels);
  input.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);

  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    if (text != nullptr && std::string_view(attribute.name()).starts_with("sdlc:")) {
      image.metadata.emplace_back(attribute.name(), text->value());
    }
  }
  return image;
}

}  // namespace sdlc::render::standard
