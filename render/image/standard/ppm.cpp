#include <charconv>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "render/image/standard/formats.hpp"

// The formats: https://netpbm.sourceforge.net/doc/ppm.html
namespace sdlc::render::standard {
namespace {

bool is_space(char c) noexcept { return (c >= '\t' && c <= '\r') || c == ' '; }

/// The numbers of a file.
class Numbers {
 public:
  explicit Numbers(std::string_view text) : text_(text) {}

  /// The next decimal number, after white space and comments.
  std::int64_t next() {
    skip_space();
    std::int64_t number = -1;
    const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
    if (error != std::errc() || number < 0) throw std::runtime_error("it is truncated or damaged");
    text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
    return number;
  }
  /// What follows the white space, or the comment, after the last number.
  std::string_view rest() const {
    const std::size_t end = text_.starts_with('#') ? text_.find('\n') : 0;
    if (end >= text_.size() || !is_space(text_[end])) throw std::runtime_error("it is damaged");
    return text_.substr(end + 1);
  }

 private:
  void skip_space() {
    while (!text_.empty() && (is_space(text_[0]) || text_[0] == '#')) {
      const std::size_t end = text_[0] == '#' ? text_.find('\n') : 0;
      text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    }
  }

  std::string_view text_;
};

}  // namespace

std::vector<std::byte> encode_ppm(const EncodeRequest& request) {
  std::string text = request.ppm_text ? "P3\n" : "P6\n";
  text += std::to_string(request.width) + " " + std::to_string(request.height) + "\n255\n";
  if (request.ppm_text) {
    // No line may be longer than 70 characters.
    for (const std::uint8_t code : request.codes) text += std::to_string(code) + "\n";
  } else {
    text.append(request.codes.begin(), request.codes.end());
  }
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

DecodedImage decode_ppm(std::span<const std::byte> file, std::int64_t max_pixels) {
  const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
  const char kind = text.size() < 2 ? '\0' : text[1];
  if (kind == '1' || kind == '4') throw ForeignFile();
  const bool is_text = kind == '2' || kind == '3', is_grey = kind == '2' || kind == '5';
  Numbers numbers(text.substr(2));
  const std::int64_t width = numbers.next(), height = numbers.next(), white = numbers.next();
  check_size(width, height, max_pixels);
  if (white != 0xFF && white != 0xFFFF) throw ForeignFile();
  DecodedImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.channels =
      is_grey ? std::vector<std::string>{"Y"} : std::vector<std::string>{"R", "G", "B"};
  image.has_codes = true;
  image.white = static_cast<float>(white);
  const std::size_t count = static_cast<std::size_t>(width * height) * image.channels.size();
  if (is_text) {
    // Each value has at least a digit and a space.
    if (numbers.rest().size() + 1 < 2 * count) throw std::runtime_error("it is truncated");
    image.values.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t value = numbers.next();
      if (value > white) throw std::runtime_error("a value is larger than its white");
      image.values.push_back(static_cast<float>(value));
    }
    return image;
  }
  const std::string_view bytes = numbers.rest();
  const std::size_t size = white == 0xFF ? 1 : 2;
  if (bytes.size() < count * size) throw std::runtime_error("it is truncated");
  image.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
    image.values.push_back(
        static_cast<float>(size == 1 ? byte(i) : byte(2 * i) << 8 | byte(2 * i + 1)));
  }
  return image;
}

}  // namespace sdlc::render::standard
