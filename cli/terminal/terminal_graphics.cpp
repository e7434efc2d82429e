#include "cli/terminal/terminal_graphics.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>
#include <zlib.h>

#include "cli/report/html.hpp"

namespace sdlc::cli {
namespace {

// A picture of one pixel that is only checked; the size of a character; what the terminal is. All
// terminals answer the last.
constexpr std::string_view kQuestions =
    "\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\"
    "\x1b[16t"
    "\x1b[c";

/// The controlling terminal, without echo and line editing.
class RawTerminal {
 public:
  RawTerminal() : file_(::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    if (file_ < 0 || ::tcgetattr(file_, &before_) != 0) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    is_raw_ = ::tcsetattr(file_, TCSANOW, &raw) == 0;
  }
  ~RawTerminal() {
    if (is_raw_) ::tcsetattr(file_, TCSANOW, &before_);
    if (file_ >= 0) ::close(file_);
  }
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  /// The answers so far, when the last one has come or a second is over.
  std::string ask(std::string_view questions) const {
    constexpr int kMilliseconds = 1000;
    std::string answers;
    if (!is_raw_ || ::write(file_, questions.data(), questions.size()) < 0) return answers;
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(kMilliseconds);
    while (!is_last_there(answers)) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          end - std::chrono::steady_clock::now());
      pollfd ready{.fd = file_, .events = POLLIN, .revents = 0};
      if (left.count() <= 0 || ::poll(&ready, 1, static_cast<int>(left.count())) <= 0) break;
      std::array<char, 256> bytes{};
      const ssize_t size = ::read(file_, bytes.data(), bytes.size());
      if (size <= 0) break;
      answers.append(bytes.data(), static_cast<std::size_t>(size));
    }
    return answers;
  }

 private:
  static bool is_last_there(std::string_view answers) {
    const std::size_t start = answers.find("\x1b[?");
    return start != std::string_view::npos && answers.find('c', start) != std::string_view::npos;
  }

  int file_;
  termios before_{};
  bool is_raw_ = false;
};

void put_size(Terminal& terminal) {
  winsize size{};
  const int file = ::open("/dev/tty", O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (file < 0) return;
  const bool is_known = ::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0;
  ::close(file);
  if (!is_known) return;
  terminal.columns = size.ws_col;
  terminal.rows = size.ws_row;
  if (size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row) {
    terminal.cell_width = size.ws_xpixel / size.ws_col;
    terminal.cell_height = size.ws_ypixel / size.ws_row;
  }
}

/// The numbers between `begin` and `end`, separated by semicolons; none without them.
std::vector<int> numbers_between(std::string_view text, std::string_view begin, char end) {
  std::vector<int> numbers;
  const std::size_t start = text.find(begin);
  if (start == std::string_view::npos) return numbers;
  text.remove_prefix(start + begin.size());
  const std::size_t stop = text.find(end);
  if (stop == std::string_view::npos) return numbers;
  const char* at = text.data();
  const char* const last = at + stop;
  while (at < last) {
    int number = 0;
    const auto [next, error] = std::from_chars(at, last, number);
    if (error != std::errc()) break;
    numbers.push_back(number);
    at = next + 1;
  }
  return numbers;
}

std::string half_blocks(const TerminalPicture& picture) {
  std::string text;
  const auto color = [&](int x, int y) {
    return picture.codes.subspan(3 * (static_cast<std::size_t>(y) * picture.width + x), 3);
  };
  for (int y = 0; y < picture.height; y += 2) {
    std::string colors;  // of the character before
    for (int x = 0; x < picture.width; ++x) {
      const auto top = color(x, y);
      std::string next = fmt::format("\x1b[38;2;{};{};{}", top[0], top[1], top[2]);
      if (y + 1 < picture.height) {
        const auto bottom = color(x, y + 1);
        next += fmt::format(";48;2;{};{};{}m", bottom[0], bottom[1], bottom[2]);
      } else {
        next += ";49m";
      }
      if (next != colors) text += next;
      colors = std::move(next);
      text += "▀";
    }
    text += "\x1b[0m\r\n";
  }
  return text;
}

std::string kitty(const TerminalPicture& picture, std::uint32_t id) {
  constexpr std::size_t kChunk = 4096;
  uLongf size = ::compressBound(picture.codes.size());
  std::string packed(size, '\0');
  // Level 1: the picture goes over a socket, perhaps to another machine.
  ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, picture.codes.data(),
              picture.codes.size(), 1);
  packed.resize(size);
  const std::string data = base64(packed);
  std::string text;
  for (std::size_t at = 0; at < data.size(); at += kChunk) {
    // C=1: the cursor stays. q=2: no answer.
    const std::string keys = at == 0 ? fmt::format("a=T,f=24,o=z,s={},v={},i={},p=1,C=1,q=2,",
                                                   picture.width, picture.height, id)
                                     : std::string();
    text += fmt::format("\x1b_G{}m={};{}\x1b\\", keys, at + kChunk < data.size() ? 1 : 0,
                        std::string_view(data).substr(at, kChunk));
  }
  return text;
}

/// A palette of 6 x 7 x 6 colours, and ordered dithering.
class SixelPalette {
 public:
  static constexpr int kRed = 6, kGreen = 7, kBlue = 6, kSize = kRed * kGreen * kBlue;

  static int index(std::span<const std::uint8_t> color, int x, int y) {
    const int threshold = kBayer[static_cast<std::size_t>(4 * (y % 4) + x % 4)];
    const auto level = [threshold](int code, int levels) {
      return (code * (levels - 1) * 16 + threshold * 255) / (255 * 16);
    };
    return (level(color[0], kRed) * kGreen + level(color[1], kGreen)) * kBlue +
           level(color[2], kBlue);
  }
  /// The definition of all colours.
  static std::string text() {
    std::string text;
    for (int i = 0; i < kSize; ++i) {
      text += fmt::format("#{};2;{};{};{}", i, i / (kGreen * kBlue) * 100 / (kRed - 1),
                          i / kBlue % kGreen * 100 / (kGreen - 1), i % kBlue * 100 / (kBlue - 1));
    }
    return text;
  }

 private:
  static constexpr std::array kBayer{0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
};

std::string sixel(const TerminalPicture& picture) {
  constexpr int kBand = 6;  // rows of pixels that a character holds
  constexpr char kNone = '?';
  const auto width = static_cast<std::size_t>(picture.width);
  std::string text =
      fmt::format("\x1bP7;1q\"1;1;{};{}", picture.width, picture.height) + SixelPalette::text();
  std::vector<std::string> layers(SixelPalette::kSize);
  for (int band = 0; band < picture.height; band += kBand) {
    for (std::string& layer : layers) layer.clear();
    for (int y = band; y < std::min(band + kBand, picture.height); ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        std::string& layer = layers[static_cast<std::size_t>(
            SixelPalette::index(picture.codes.subspan(3 * pixel, 3), x, y))];
        if (layer.empty()) layer.assign(width, kNone);
        layer[static_cast<std::size_t>(x)] =
            static_cast<char>(layer[static_cast<std::size_t>(x)] + (1 << (y - band)));
      }
    }
    for (std::size_t i = 0; i < layers.size(); ++i) {
      if (layers[i].empty()) continue;
      text += fmt::format("#{}", i);
      for (std::size_t x = 0; x < width;) {
        const std::size_t end = std::min(layers[i].find_first_not_of(layers[i][x], x), width);
        text += end - x > 3 ? fmt::format("!{}{}", end - x, layers[i][x])
                            : layers[i].substr(x, end - x);
        x = end;
      }
      text += '$';
    }
    text += '-';
  }
  return text + "\x1b\\";
}

}  // namespace

void read_answers(const std::string& answers, Terminal& terminal) {
  constexpr int kHasSixel = 4;
  const std::vector<int> cell = numbers_between(answers, "\x1b[6;", 't');
  if (cell.size() == 2 && cell[0] > 0 && cell[1] > 0) {
    terminal.cell_height = cell[0];
    terminal.cell_width = cell[1];
  }
  if (answers.find("\x1b_Gi=31;OK") != std::string::npos) {
    terminal.graphics = TerminalGraphics::Kitty;
  } else if (std::ranges::count(numbers_between(answers, "\x1b[?", 'c'), kHasSixel) > 0) {
    terminal.graphics = TerminalGraphics::Sixel;
  }
}

bool update_size(Terminal& terminal) {
  const Terminal before = terminal;
  put_size(terminal);
  return terminal.columns != before.columns || terminal.rows != before.rows;
}

Terminal ask_terminal() {
  Terminal terminal;
  const RawTerminal tty;
  put_size(terminal);
  // The console of Linux would show the first question; tmux and screen take it as a title.
  const char* const value = std::getenv("TERM");
  const std::string_view name = value != nullptr ? value : "";
  for (const std::string_view other : {"linux", "tmux", "screen"}) {
    if (name.starts_with(other)) return terminal;
  }
  read_answers(tty.ask(kQuestions), terminal);
  return terminal;
}

PixelSize fitting_size(const Terminal& terminal, int width, int height, int free_rows) {
  const bool has_cells = terminal.graphics == TerminalGraphics::HalfBlocks;
  const double columns = terminal.columns, rows = std::max(terminal.rows - free_rows, 1);
  const double most_width = has_cells ? columns : columns * terminal.cell_width;
  const double most_height = has_cells ? 2 * rows : rows * terminal.cell_height;
  const double scale = std::min({1.0, most_width / width, most_height / height});
  return {.width = std::max(static_cast<int>(width * scale), 1),
          .height = std::max(static_cast<int>(height * scale), 1)};
}

int rows_of(const Terminal& terminal, int height) {
  const int of_row =
      terminal.graphics == TerminalGraphics::HalfBlocks ? 2 : std::max(terminal.cell_height, 1);
  return (height + of_row - 1) / of_row;
}

std::string drawing_of(const Terminal& terminal, const TerminalPicture& picture, std::uint32_t id) {
  switch (terminal.graphics) {
    case TerminalGraphics::HalfBlocks: return half_blocks(picture);
    case TerminalGraphics::Sixel: return sixel(picture);
    case TerminalGraphics::Kitty: return kitty(picture, id);
  }
  return {};
}

}  // namespace sdlc::cli
