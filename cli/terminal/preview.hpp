#pragma once

#include <cstdint>

#include "cli/terminal/status_line.hpp"
#include "cli/terminal/terminal_graphics.hpp"
#include "render/film/film.hpp"
#include "render/image/picture.hpp"
#include "render/image/tone.hpp"
#include "render/math/clock.hpp"

namespace sdlc::cli {

/// `render --preview`: the picture in the terminal, while it is rendered.
class Preview {
 public:
  /// Asks the terminal what it can show.
  explicit Preview(StatusLine& line);

  /// The next picture appears below the ones before.
  void begin();
  /// Shows the picture so far, at the present size of the terminal, at most ten times a second.
  /// `width`: of the picture.
  void show(const render::Film& film, int width, const render::ToneMapping& mapping);
  void show(const render::Picture& picture, const render::ToneMapping& mapping);

 private:
  StatusLine& line_;
  Terminal terminal_;
  std::uint32_t id_;
  bool is_new_ = true;
  render::Clock::time_point next_{};
};

}  // namespace sdlc::cli
