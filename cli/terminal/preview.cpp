#include "cli/terminal/preview.hpp"

#include <chrono>
#include <cstddef>
#include <vector>

#include <unistd.h>

#include "render/image/image.hpp"
#include "render/image/resize.hpp"

namespace sdlc::cli {

Preview::Preview(StatusLine& line)
    // So that pictures of the programs before, which have other numbers, stay.
    : line_(line), terminal_(ask_terminal()), id_(static_cast<std::uint32_t>(::getpid()) << 8U) {}

void Preview::begin() {
  ++id_;
  is_new_ = true;
  next_ = {};
}

void Preview::show(const render::Film& film, int width, const render::ToneMapping& mapping) {
  if (render::Clock::now() < next_ || film.size() == 0) return;
  render::Picture picture(width, static_cast<int>(film.size() / static_cast<std::size_t>(width)));
  for (std::size_t i = 0; i < film.size(); ++i) picture.pixels[i] = film.mean(i);
  show(picture, mapping);
}

void Preview::show(const render::Picture& picture, const render::ToneMapping& mapping) {
  constexpr int kFreeRows = 3;  // for the prompt and messages
  constexpr std::chrono::milliseconds kPause(100);
  // The old picture may have been torn: the next one appears below.
  if (update_size(terminal_)) is_new_ = true;
  const PixelSize size = fitting_size(terminal_, picture.width, picture.height, kFreeRows);
  const render::Picture small = shrunk(picture, size.width, size.height);
  const std::vector<std::uint8_t> codes = codes_of(small, mapping);
  const TerminalPicture shown{.width = small.width, .height = small.height, .codes = codes};
  line_.show_picture(drawing_of(terminal_, shown, id_), rows_of(terminal_, small.height), is_new_);
  is_new_ = false;
  next_ = render::Clock::now() + kPause;
}

}  // namespace sdlc::cli
