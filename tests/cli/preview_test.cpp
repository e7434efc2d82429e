#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "cli/terminal/terminal_graphics.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using cli::drawing_of;
using cli::Terminal;
using cli::TerminalGraphics;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Terminal, IsWhatItsAnswersSay) {
  const auto graphics_of = [](const char* answers) {
    Terminal terminal;
    read_answers(answers, terminal);
    return terminal.graphics;
  };
  EXPECT_EQ(graphics_of(""), TerminalGraphics::HalfBlocks);
  EXPECT_EQ(graphics_of("\x1b[?1;2c"), TerminalGraphics::HalfBlocks);
  EXPECT_EQ(graphics_of("\x1b[?62;14;22c"), TerminalGraphics::HalfBlocks) << "14 is not 4";
  EXPECT_EQ(graphics_of("\x1b[?62;4;22c"), TerminalGraphics::Sixel);
  EXPECT_EQ(graphics_of("\x1b_Gi=31;OK\x1b\\\x1b[?62;4c"), TerminalGraphics::Kitty);
  EXPECT_EQ(graphics_of("\x1b_Gi=31;ENOTSUPPORTED\x1b\\\x1b[?62c"), TerminalGraphics::HalfBlocks);
  Terminal terminal;
  read_answers("\x1b[6;20;9t\x1b[?62c", terminal);
  EXPECT_EQ(terminal.cell_height, 20);
  EXPECT_EQ(terminal.cell_width, 9);
  read_answers("\x1b[6;0;0t\x1b[6;x\x1b[?", terminal);
  EXPECT_EQ(terminal.cell_height, 20);
}

TEST(Terminal, ShowsAPictureAsLargeAsItFits) {
  Terminal terminal{.columns = 80, .rows = 24, .cell_width = 10, .cell_height = 20};
  const auto size = [&](int width, int height) {
    const cli::PixelSize fit = fitting_size(terminal, width, height, 4);
    return std::pair(fit.width, fit.height);
  };
  EXPECT_EQ(size(800, 200), std::pair(80, 20)) << "as wide as the terminal";
  EXPECT_EQ(size(800, 800), std::pair(40, 40)) << "as high as the terminal, less four rows";
  EXPECT_EQ(size(20, 10), std::pair(20, 10)) << "no larger than it is";
  EXPECT_EQ(size(100000, 1), std::pair(80, 1));
  EXPECT_EQ(rows_of(terminal, 5), 3);
  terminal.graphics = TerminalGraphics::Kitty;
  EXPECT_EQ(size(1600, 400), std::pair(800, 200));
  EXPECT_EQ(rows_of(terminal, 41), 3);
}

TEST(TerminalGraphics, HalfBlocksHaveTwoPixelsACharacter) {
  const std::vector<std::uint8_t> codes{1, 2, 3, 1, 2, 3, 4, 5, 6, 4, 5, 6, 7, 8, 9, 7, 8, 9};
  EXPECT_EQ(drawing_of({}, {.width = 2, .height = 3, .codes = codes}, 1),
            "\x1b[38;2;1;2;3;48;2;4;5;6m▀▀\x1b[0m\r\n"
            "\x1b[38;2;7;8;9;49m▀▀\x1b[0m\r\n");
}

/// The bytes that a text in base 64 means.
std::string decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<unsigned>(digits.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count);
  }
  return bytes;
}

std::vector<std::uint8_t> ramp(int width, int height) {
  std::vector<std::uint8_t> codes;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      codes.push_back(static_cast<std::uint8_t>(255 * x / (width - 1)));
      codes.push_back(static_cast<std::uint8_t>(255 * y / (height - 1)));
      codes.push_back(static_cast<std::uint8_t>((x * 7 + y * 31) % 256));
    }
  }
  return codes;
}

TEST(TerminalGraphics, KittyGetsTheExactCodes) {
  constexpr int kWidth = 120, kHeight = 90;
  const std::vector<std::uint8_t> codes = ramp(kWidth, kHeight);
  std::string text = drawing_of({.graphics = TerminalGraphics::Kitty},
                                {.width = kWidth, .height = kHeight, .codes = codes}, 7);
  EXPECT_THAT(text, StartsWith("\x1b_Ga=T,f=24,o=z,s=120,v=90,i=7,p=1,C=1,q=2,m=1;"));
  std::string data;
  int chunks = 0;
  for (std::size_t at = 0; (at = text.find(';', at)) != std::string::npos; ++chunks) {
    const std::size_t end = text.find("\x1b\\", at);
    const std::string chunk = text.substr(at + 1, end - at - 1);
    EXPECT_LE(chunk.size(), 4096U);
    data += chunk;
    at = end;
  }
  EXPECT_GT(chunks, 1);
  EXPECT_THAT(text.substr(text.rfind("\x1b_G")), StartsWith("\x1b_Gm=0;")) << "the last one";
  const std::string packed = decoded(data);
  std::vector<std::uint8_t> unpacked(codes.size());
  uLongf size = unpacked.size();
  ASSERT_EQ(::uncompress(unpacked.data(), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
            Z_OK);
  EXPECT_EQ(unpacked, codes);
}

/// The picture that a text of sixels shows.
std::vector<std::uint8_t> shown_sixels(const std::string& text, int width, int height) {
  std::vector<std::uint8_t> codes(static_cast<std::size_t>(3 * width * height));
  std::vector<std::vector<int>> palette;
  std::size_t at = text.find('q') + 1;
  int x = 0, band = 0, color = 0;
  const auto number = [&] {
    int value = 0;
    while (text[at] >= '0' && text[at] <= '9') value = 10 * value + (text[at++] - '0');
    return value;
  };
  while (text[at] != '\x1b') {
    const char c = text[at++];
    if (c == '"') {
      for (int i = 0; i < 4; ++i, at += i < 4 ? 1 : 0) number();
    } else if (c == '#') {
      color = number();
      if (text[at] != ';') continue;
      std::vector<int>& entry = palette.emplace_back();
      while (text[at] == ';') {
        ++at;
        entry.push_back(number());
      }
    } else if (c == '$' || c == '-') {
      x = 0;
      if (c == '-') band += 6;
    } else {
      const int count = c == '!' ? number() : 1;
      const int bits = (c == '!' ? text[at++] : c) - '?';
      for (int end = x + count; x < end; ++x) {
        for (int row = 0; row < 6; ++row) {
          if ((bits >> row & 1) == 0) continue;
          for (int channel = 0; channel < 3; ++channel) {
            codes.at(static_cast<std::size_t>(3 * ((band + row) * width + x) + channel)) =
                static_cast<std::uint8_t>(palette[static_cast<std::size_t>(color)]
                                                 [static_cast<std::size_t>(channel + 1)] *
                                          255 / 100);
          }
        }
      }
    }
  }
  return codes;
}

TEST(TerminalGraphics, SixelsHaveTheColorsOnAverage) {
  constexpr int kWidth = 64, kHeight = 50;
  for (const int code : {0, 1, 60, 128, 200, 254, 255}) {
    const std::vector<std::uint8_t> codes(3 * kWidth * kHeight, static_cast<std::uint8_t>(code));
    const std::string text = drawing_of({.graphics = TerminalGraphics::Sixel},
                                        {.width = kWidth, .height = kHeight, .codes = codes}, 1);
    EXPECT_THAT(text, StartsWith("\x1bP7;1q\"1;1;64;50#0;2;0;0;0"));
    EXPECT_THAT(text, EndsWith("-\x1b\\"));
    const std::vector<std::uint8_t> shown = shown_sixels(text, kWidth, kHeight);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      double sum = 0;
      for (std::size_t i = channel; i < shown.size(); i += 3) sum += shown[i];
      // The pattern has 16 thresholds between two of six levels, and the palette whole percent.
      EXPECT_NEAR(sum / (kWidth * kHeight), code, 255.0 / 5 / 16 + 2.55) << code;
    }
  }
}

/// Whether run_in_terminal() can work: some containers have no /dev/pts.
bool has_terminals() {
  return run_shell(TemporaryFolder().path(), "script -qec true /dev/null").exit_code == 0;
}

/// Runs a command with a terminal, which gives these answers.
ProgramResult run_in_terminal(const TemporaryFolder& folder, const std::string& answers,
                              const std::string& command) {
  write_text(folder / "answers", answers);
  write_text(folder / "command", command);
  return run_shell(folder.path(),
                   "export SDLC TERM=xterm; (cat answers; sleep 2) | "
                   "script -qec 'stty cols 40 rows 20; . ./command' /dev/null");
}

TEST(Preview, ShowsThePictureInTheTerminal) {
  if (!has_terminals()) GTEST_SKIP() << "needs script, and pseudo-terminals";
  const TemporaryFolder folder;
  write_text(folder / "a.scene",
             "scene 1\n"
             "camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
             "background { color: rgb(10, 20, 30) }\n"
             "render { width: 160, height: 80, samples: 64 }\n");
  const std::string render = "\"$SDLC\" render a.scene -o a.ppm --preview";
  const std::string blocks = run_in_terminal(folder, "", render).out;
  EXPECT_THAT(blocks, HasSubstr("\x1b[38;2;10;20;30;48;2;10;20;30m▀▀"));
  EXPECT_THAT(blocks, HasSubstr("\x1b[10A\r")) << "40 x 20 pixels are ten rows";
  EXPECT_THAT(blocks, HasSubstr("a.ppm: 160 x 80 pixels, 64 samples"));
  const std::string with_preview = content_of(folder / "a.ppm");
  const std::string kitty = run_in_terminal(folder, "\x1b_Gi=31;OK\x1b\\\x1b[?62c", render).out;
  EXPECT_THAT(kitty, HasSubstr("a=T,f=24,o=z,s=160,v=80"));
  EXPECT_THAT(kitty, Not(HasSubstr("▀")));
  EXPECT_THAT(run_in_terminal(folder, "\x1b[?62;4c", render).out, HasSubstr("\x1bP7;1q"));
  ASSERT_EQ(run_shell(folder.path(), "\"$SDLC\" render a.scene -o b.ppm").exit_code, 0);
  EXPECT_EQ(content_of(folder / "b.ppm"), with_preview) << "the same picture";
}

TEST(Preview, NeedsATerminal) {
  if (!has_terminals()) GTEST_SKIP() << "needs script, and pseudo-terminals";
  const TemporaryFolder folder;
  write_text(folder / "a.scene", "scene 1\ncamera main { from: (0, 0, 9), at: (0, 0, 0) }\n");
  const ProgramResult result =
      run_shell(folder.path(), "\"$SDLC\" render a.scene -o a.ppm --preview");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(
      run_in_terminal(folder, "", "TERM=dumb \"$SDLC\" render a.scene -o a.ppm --preview").out,
      HasSubstr("no terminal that can show a picture"));
  EXPECT_THAT(result.err, HasSubstr("standard error is no terminal that can show a picture"));
}

}  // namespace
}  // namespace sdlc::test
