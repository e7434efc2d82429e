#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <png.h>

#include "render/image/standard/formats.hpp"

namespace sdlc::render::standard {
namespace {

/// What the callbacks of libpng share. libpng leaves them, and the functions with setjmp, by
/// longjmp: they must not have objects with destructors.
struct State {
  std::span<const std::byte> input = {};
  std::vector<std::byte> output = {};
  std::string error = {};
};

State& state_of(png_structp png) { return *static_cast<State*>(png_get_error_ptr(png)); }

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  state_of(png).error = message;
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

/// Whether there was memory. No exception may leave a callback, and no longjmp a handler.
bool append(std::vector<std::byte>& file, std::span<const std::byte> bytes) noexcept {
  try {
    file.insert(file.end(), bytes.begin(), bytes.end());
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

void write(png_structp png, png_bytep bytes, png_size_t size) {
  const auto* first = reinterpret_cast<const std::byte*>(bytes);
  if (!append(state_of(png).output, {first, size})) png_error(png, "there is not enough memory");
}
void flush(png_structp) {}

void read(png_structp png, png_bytep bytes, png_size_t size) {
  State& state = state_of(png);
  if (state.input.size() < size) png_error(png, "it is truncated");
  std::memcpy(bytes, state.input.data(), size);
  state.input = state.input.subspan(size);
}

/// The chunks that say that the codes follow the sRGB curve: gAMA and cHRM are for programs that do
/// not know sRGB (section 11.3.2.5 of the PNG specification).
void put_srgb(png_structp png, png_infop info) {
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
}

/// One call of libpng's for each step: false after an error.
bool write_file(png_structp png, png_infop info, const EncodeRequest& request, png_textp texts,
                int text_count, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): of libpng
  png_set_IHDR(png, info, static_cast<png_uint_32>(request.width),
               static_cast<png_uint_32>(request.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (request.is_srgb) put_srgb(png, info);
  png_set_text(png, info, texts, text_count);
  png_set_rows(png, info, rows);
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  return true;
}

struct Header {
  png_uint_32 width = 0, height = 0;
  int channels = 0, bits = 0;
  bool has_alpha = false;
};

/// Reads what comes before the pixels.
bool read_header(png_structp png, png_infop info, Header& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): of libpng
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_read_info(png, info);
  header.width = png_get_image_width(png, info);
  header.height = png_get_image_height(png, info);
  header.has_alpha = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) != 0 ||
                     png_get_valid(png, info, PNG_INFO_tRNS) != 0;
  return true;
}

/// Asks for 8 or 16 bits, grey or RGB. Allocates memory for rows.
bool choose_form(png_structp png, png_infop info, Header& header) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): of libpng
  png_set_expand(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  header.channels = png_get_channels(png, info);
  header.bits = png_get_bit_depth(png, info);
  return true;
}

/// Reads all rows, and the texts after them.
bool read_pixels(png_structp png, png_infop end, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp): of libpng
  png_read_image(png, rows);
  png_read_end(png, end);
  return true;
}

void take_texts(png_structp png, png_infop info, DecodedImage& image) {
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) {
    if (std::string_view(texts[i].key).starts_with("sdlc:")) {
      image.metadata.emplace_back(texts[i].key, texts[i].text);
    }
  }
}

struct Writer {
  State state;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);

  Writer() {
    if (info == nullptr) throw std::bad_alloc();
    png_set_write_fn(png, nullptr, write, flush);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

struct Reader {
  State state;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  png_infop end = png == nullptr ? nullptr : png_create_info_struct(png);

  explicit Reader(std::span<const std::byte> file) : state{.input = file} {
    if (info == nullptr || end == nullptr) throw std::bad_alloc();
    png_set_read_fn(png, nullptr, read);
  }
  ~Reader() { png_destroy_read_struct(&png, &info, &end); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
};

}  // namespace

std::vector<std::byte> encode_png(const EncodeRequest& request) {
  Writer writer;
  std::vector<std::pair<std::string, std::string>> entries;
  if (!request.software.empty()) entries.emplace_back("Software", request.software);
  entries.insert(entries.end(), request.metadata.begin(), request.metadata.end());
  std::vector<png_text> texts;
  for (auto& [key, value] : entries) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = value.data();
    text.text_length = value.size();
    texts.push_back(text);
  }
  std::vector<png_bytep> rows;
  for (int y = 0; y < request.height; ++y) {
    const std::size_t begin =
        3 * static_cast<std::size_t>(y) * static_cast<std::size_t>(request.width);
    // libpng does not write to it.
    rows.push_back(const_cast<png_bytep>(request.codes.data() + begin));
  }
  if (!write_file(writer.png, writer.info, request, texts.data(), static_cast<int>(texts.size()),
                  rows.data())) {
    throw std::runtime_error(writer.state.error);
  }
  return std::move(writer.state.output);
}

/// Throws unless the file consists of whole chunks up to its end mark: libpng allocates what the
/// length of a chunk claims.
void check_chunks(std::span<const std::byte> file) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, name and checksum
  for (std::size_t at = kSignature; at + kFrame <= file.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      length = length << 8U | std::to_integer<std::size_t>(file[at + i]);
    }
    if (length > file.size() - at - kFrame) break;
    if (std::memcmp(&file[at + 4], "IEND", 4) == 0) return;
    at += kFrame + length;
  }
  throw std::runtime_error("it is truncated");
}

DecodedImage decode_png(std::span<const std::byte> file, std::int64_t max_pixels) {
  check_chunks(file);
  Reader reader(file);
  const auto check = [&](bool is_done) {
    if (!is_done) throw std::runtime_error(reader.state.error);
  };
  Header header;
  check(read_header(reader.png, reader.info, header));
  check_size(header.width, header.height, max_pixels);
  if (header.has_alpha) throw ForeignFile();
  check(choose_form(reader.png, reader.info, header));

  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  // Deflate makes at most 1032 bytes of one, and a palette at most 24 of those.
  constexpr std::size_t kMaxGrowth = std::size_t{1032} * 24;
  if (row_bytes * header.height / kMaxGrowth > file.size()) {
    throw std::runtime_error("it is truncated");
  }
  std::vector<png_byte> bytes(row_bytes * header.height);
  std::vector<png_bytep> rows;
  for (std::size_t y = 0; y < header.height; ++y) rows.push_back(bytes.data() + y * row_bytes);
  check(read_pixels(reader.png, reader.end, rows.data()));

  DecodedImage image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  image.channels = header.channels == 1 ? std::vector<std::string>{"Y"}
                                        : std::vector<std::string>{"R", "G", "B"};
  image.has_codes = true;
  image.white = header.bits == 16 ? 65535 : 255;
  image.values.reserve(bytes.size() / (header.bits == 16 ? 2 : 1));
  if (header.bits == 16) {
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
      image.values.push_back(static_cast<float>(bytes[i] << 8 | bytes[i + 1]));
    }
  } else {
    image.values.assign(bytes.begin(), bytes.end());
  }
  take_texts(reader.png, reader.info, image);
  take_texts(reader.png, reader.end, image);
  return image;
}

}  // namespace sdlc::render::standard
