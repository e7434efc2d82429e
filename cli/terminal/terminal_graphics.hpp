#pragma once

#include <cstdint>
#include <span>
#include <string>

/// Pictures in a terminal.
namespace sdlc::cli {

enum class TerminalGraphics : std::uint8_t {
  HalfBlocks,  ///< two pixels a character, in colours of 24 bits
  Sixel,       ///< https://vt100.net/docs/vt3xx-gp/chapter14.html
  Kitty,       ///< https://sw.kovidgoyal.net/kitty/graphics-protocol/
};

struct Terminal {
  TerminalGraphics graphics = TerminalGraphics::HalfBlocks;
  int columns = 80, rows = 24;
  int cell_width = 8, cell_height = 16;  ///< of a character, in pixels
};

/// What the terminal of this process is. It is asked, and has a second to answer; one that says
/// nothing gets half blocks, and so do tmux and screen.
Terminal ask_terminal();

/// Asks again for what a user may change: the size. Returns whether it is another.
bool update_size(Terminal& terminal);

/// What the answers to the questions of ask_terminal() say of the terminal.
void read_answers(const std::string& answers, Terminal& terminal);

/// Codes of red, green and blue of each pixel, row by row from the top.
struct TerminalPicture {
  int width = 0, height = 0;
  std::span<const std::uint8_t> codes = {};
};

/// The size in pixels at which a picture fits into the terminal, with its aspect, and no larger
/// than it is. `free_rows` rows remain for text.
struct PixelSize {
  int width = 0, height = 0;
};
PixelSize fitting_size(const Terminal& terminal, int width, int height, int free_rows);

/// The rows of characters that a picture of this height takes.
int rows_of(const Terminal& terminal, int height);

/// What draws the picture from the place of the cursor on. `id`: of the picture, for terminals that
/// replace one by the next of the same number; not 0.
std::string drawing_of(const Terminal& terminal, const TerminalPicture& picture, std::uint32_t id);

}  // namespace sdlc::cli
