#include "render/image/codec.hpp"

#include <algorithm>
#include <array>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace sdlc::render {
namespace {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// OpenImageIO takes the format by name but still requires a file name.
constexpr const char* kNoFileName = "picture";

/// A fixed date for formats that require one; otherwise OpenImageIO writes the current time.
constexpr const char* kNoDate = "1970:01:01 00:00:00";

constexpr int kMaxChannels = 1024;

const char* plugin_of(ImageFormat format) noexcept {
  switch (format) {
    case ImageFormat::Png: return "png";
    case ImageFormat::Exr: return "openexr";
    case ImageFormat::Hdr: return "hdr";
    case ImageFormat::Tiff: return "tiff";
    case ImageFormat::Jpeg: return "jpeg";
    case ImageFormat::WebP: return "webp";
    case ImageFormat::Ppm: return "pnm";
    case ImageFormat::Gif: return "gif";
  }
  return "";
}

ImageSpec spec_of(const EncodeRequest& request) {
  const TypeDesc type = request.radiance.empty() ? TypeDesc::UINT8 : TypeDesc::FLOAT;
  ImageSpec spec(request.width, request.height, 3, type);
  if (!request.software.empty()) spec.attribute("Software", request.software);
  for (const auto& [key, value] : request.metadata) spec.attribute(key, value);
  switch (request.format) {
    case ImageFormat::Tiff: spec.attribute("DateTime", kNoDate); break;
    case ImageFormat::Jpeg:
      spec.attribute("Compression", "jpeg:95");
      // The default halves the colour resolution, which smears the edges of coloured objects.
      spec.attribute("jpeg:subsampling", "4:4:4");
      break;
    case ImageFormat::WebP: spec.attribute("Compression", "webp:100"); break;
    default: break;
  }
  return spec;
}

/// Stores the codec's message in `error`, on one line, and returns false.
bool fail(std::string& error, std::string words) {
  while (!words.empty() && words.back() == '\n') words.pop_back();
  std::replace(words.begin(), words.end(), '\n', ';');
  error = words.empty() ? "OpenImageIO gives no reason" : std::move(words);
  return false;
}

bool write_pixels(ImageOutput& output, const EncodeRequest& request) {
  if (!request.radiance.empty()) {
    return output.write_image(TypeDesc::FLOAT, request.radiance.data());
  }
  return output.write_image(TypeDesc::UINT8, request.codes.data());
}

bool encode_with_oiio(const EncodeRequest& request, std::vector<std::byte>& file,
                      std::string& error) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  {
    // In its own scope: some formats write their trailer only when the writer is destroyed.
    const std::unique_ptr<ImageOutput> output = ImageOutput::create(plugin_of(request.format));
    if (!output) return fail(error, OIIO::geterror());
    if (!output->set_ioproxy(&memory))
      return fail(error, "this format cannot be written to memory");
    if (!output->open(kNoFileName, spec_of(request))) return fail(error, output->geterror());
    if (!write_pixels(*output, request)) return fail(error, output->geterror());
    if (!output->close()) return fail(error, output->geterror());
  }
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  file.assign(first, first + bytes.size());
  return true;
}

/// For these formats OpenImageIO accepts a file that lacks its end.
bool has_end_mark(ImageFormat format, std::span<const std::byte> file) {
  constexpr std::string_view kPngEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  constexpr std::string_view kGifEnd(";");
  const std::string_view end = format == ImageFormat::Png   ? kPngEnd
                               : format == ImageFormat::Gif ? kGifEnd
                                                            : std::string_view();
  return std::string_view(reinterpret_cast<const char*>(file.data()), file.size()).ends_with(end);
}

/// Reads the stored codes. By default OpenImageIO would convert them to fractions, rounding twice.
template <typename Value>
bool read_values(ImageInput& input, const ImageSpec& spec, TypeDesc type, DecodedImage& image) {
  std::vector<Value> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input.read_image(0, 0, 0, spec.nchannels, type, values.data())) return false;
  image.values.assign(values.begin(), values.end());
  image.has_codes = std::is_integral_v<Value>;
  if (image.has_codes) image.white = static_cast<float>(std::numeric_limits<Value>::max());
  return true;
}

bool read_values(ImageInput& input, const ImageSpec& spec, DecodedImage& image) {
  if (spec.format == TypeDesc::UINT8) {
    return read_values<std::uint8_t>(input, spec, TypeDesc::UINT8, image);
  }
  if (spec.format == TypeDesc::UINT16) {
    return read_values<std::uint16_t>(input, spec, TypeDesc::UINT16, image);
  }
  return read_values<float>(input, spec, TypeDesc::FLOAT, image);
}

std::vector<std::pair<std::string, std::string>> own_metadata(const ImageSpec& spec) {
  std::vector<std::pair<std::string, std::string>> metadata;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (!attribute.name().string().starts_with("sdlc:")) continue;
    metadata.emplace_back(attribute.name().string(), attribute.get_string());
  }
  return metadata;
}

/// Must be called last: some readers cannot seek back.
int count_pictures(ImageInput& input) {
  int count = 1;
  while (input.seek_subimage(count, 0)) ++count;
  input.geterror();  // clears the error about the missing next picture
  return count;
}

bool decode_with_oiio(ImageFormat format, std::span<const std::byte> file, std::int64_t max_pixels,
                      DecodedImage& image, std::string& error) {
  if (!has_end_mark(format, file)) return fail(error, "it is truncated or not of its format");
  // The reader does not write to what it is given, though its parameter is not const.
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(file.data()), file.size());
  const std::unique_ptr<ImageInput> input = ImageInput::create(plugin_of(format));
  if (!input) return fail(error, OIIO::geterror());
  if (!input->set_ioproxy(&memory)) return fail(error, "this format cannot be read from memory");
  ImageSpec spec;
  if (!input->open(kNoFileName, spec)) return fail(error, input->geterror());
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.nchannels > kMaxChannels) {
    return fail(error, "it has no pixels");
  }
  if (spec.deep) return fail(error, "it holds samples at several depths, not a picture");
  if (spec.depth > 1) return fail(error, "it is a volume, not a picture");
  if (std::int64_t{spec.width} * spec.height > max_pixels) {
    return fail(error, "it has more than " + std::to_string(max_pixels) + " pixels");
  }
  image.width = spec.width;
  image.height = spec.height;
  image.channels = spec.channelnames;
  image.metadata = own_metadata(spec);
  if (format == ImageFormat::Exr) {
    image.data = {spec.x, spec.y, spec.width, spec.height};
    image.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  }
  const bool is_read = read_values(*input, spec, image);
  // JPEG reports success together with an error if the file ends early.
  if (!is_read || input->has_error()) return fail(error, input->geterror());
  image.pictures = count_pictures(*input);
  return true;
}

/// The end of the sub-blocks that begin at `at`.
std::size_t end_of_blocks(std::span<const std::byte> file, std::size_t at) {
  while (at < file.size() && file[at] != std::byte{0}) {
    at += 1 + std::to_integer<std::size_t>(file[at]);
  }
  return at + 1;
}

/// The size in bytes of the table of colours that the flags of a GIF block announce.
std::size_t table_bytes(std::byte flags) {
  const auto bits = std::to_integer<unsigned>(flags);
  return (bits & 0x80U) != 0 ? std::size_t{6} << (bits & 7U) : 0;
}

/// Writes the delays of the frames into their graphic control extensions; OpenImageIO has one for
/// the whole file. The blocks of GIF89a: https://www.w3.org/Graphics/GIF/spec-gif89a.txt. Returns
/// whether the file has a frame for each.
bool set_delays(std::span<std::byte> file, std::span<const std::uint16_t> delays) {
  constexpr std::byte kExtension{0x21}, kControl{0xF9}, kImage{0x2C};
  constexpr std::size_t kHeader = 13, kImageHeader = 10;
  if (file.size() < kHeader) return false;
  std::size_t frame = 0;
  for (std::size_t at = kHeader + table_bytes(file[10]); at + kImageHeader < file.size();) {
    if (file[at] == kExtension) {
      if (file[at + 1] == kControl && frame < delays.size()) {
        file[at + 4] = static_cast<std::byte>(delays[frame] & 0xFFU);
        file[at + 5] = static_cast<std::byte>(delays[frame] >> 8U);
        ++frame;
      }
      at = end_of_blocks(file, at + 2);
    } else if (file[at] == kImage) {
      at = end_of_blocks(file, at + kImageHeader + table_bytes(file[at + 9]) + 1);
    } else {
      return false;
    }
  }
  return frame == delays.size();
}

class OpenImageIoGif final : public GifEncoder {
 public:
  OpenImageIoGif(int width, int height)
      : spec_(width, height, 3, TypeDesc::UINT8), output_(ImageOutput::create("gif")) {}

  bool add(std::span<const std::uint8_t> codes, std::uint16_t delay,
           std::string& error) noexcept override try {
    delays_.push_back(delay);
    if (!output_) return fail(error, OIIO::geterror());
    if (!has_frames_ && !output_->set_ioproxy(&memory_)) return fail(error, output_->geterror());
    const auto mode = has_frames_ ? ImageOutput::AppendSubimage : ImageOutput::Create;
    has_frames_ = true;
    return (output_->open(kNoFileName, spec_, mode) &&
            output_->write_image(TypeDesc::UINT8, codes.data())) ||
           fail(error, output_->geterror());
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }

  bool finish(std::vector<std::byte>& file, std::string& error) noexcept override try {
    if (output_ && !output_->close()) return fail(error, output_->geterror());
    const auto* first = reinterpret_cast<const std::byte*>(bytes_.data());
    file.assign(first, first + bytes_.size());
    return set_delays(file, delays_) ||
           fail(error, "OpenImageIO has written other blocks than expected");
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }

 private:
  ImageSpec spec_;
  std::vector<std::uint16_t> delays_;
  std::vector<unsigned char> bytes_;
  OIIO::Filesystem::IOVecOutput memory_{bytes_};
  std::unique_ptr<ImageOutput> output_;  // writes to memory_
  bool has_frames_ = false;
};

class OpenImageIoCodec final : public ImageCodec {
 public:
  OpenImageIoCodec() {
    // Encoding is a small part of a render and must not compete with it for the cores. The second
    // setting is that of the EXR library, which ignores the first; -1 disables its own threads.
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  }

  bool encode(const EncodeRequest& request, std::vector<std::byte>& file,
              std::string& error) noexcept override try {
    return encode_with_oiio(request, file, error);
  } catch (const std::exception& exception) {
    return fail(error, exception.what());
  }

  std::unique_ptr<GifEncoder> make_gif_encoder(int width, int height) noexcept override try {
    return std::make_unique<OpenImageIoGif>(width, height);
  } catch (const std::exception&) {
    return nullptr;
  }

  Decoding decode(ImageFormat format, std::span<const std::byte> file, std::int64_t max_pixels,
                  DecodedImage& image, std::string& error) noexcept override try {
    const bool is_decoded = decode_with_oiio(format, file, max_pixels, image, error);
    return is_decoded ? Decoding::Done : Decoding::Failed;
  } catch (const std::exception& exception) {
    fail(error, exception.what());
    return Decoding::Failed;
  }
};

}  // namespace
}  // namespace sdlc::render

extern "C" __attribute__((visibility("default"))) sdlc::render::ImageCodecEntry
sdlc_image_codec() noexcept {
  // Never destroyed: other threads may still use it when the process ends.
  // NOLINTNEXTLINE(bugprone-unhandled-exception-at-new): nothing could go on without this memory
  static auto* const codec = new sdlc::render::OpenImageIoCodec;
  return {sdlc::render::kImageCodecVersion, codec};
}
