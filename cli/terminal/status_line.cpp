#include "cli/terminal/status_line.hpp"

#include <cstddef>
#include <string>

#include <fmt/format.h>

namespace sdlc::cli {

StatusLine::StatusLine(std::ostream& terminal) : std::ostream(nullptr), buffer_(terminal) {
  rdbuf(&buffer_);
}

void StatusLine::Buffer::show(std::string_view text) {
  const std::lock_guard lock(mutex_);
  // The terminal cuts what is too long for a line, however wide it is now.
  terminal_ << "\x1b[?7l\r" << text << "\x1b[K\x1b[?7h" << std::flush;
  is_shown_ = true;
}

void StatusLine::Buffer::show_picture(std::string_view drawing, int rows, bool is_new) {
  const std::lock_guard lock(mutex_);
  erase();
  if (is_new || picture_rows_ != rows) {
    // First the room, which may scroll the screen.
    terminal_ << std::string(static_cast<std::size_t>(rows), '\n');
    picture_rows_ = rows;
  }
  // The cursor is saved, because a picture may leave it anywhere.
  terminal_ << fmt::format(
                   "\x1b[{0}A\r\x1b"
                   "7{1}\x1b"
                   "8\x1b[{0}B\r",
                   rows, drawing)
            << std::flush;
}

StatusLine::Buffer::int_type StatusLine::Buffer::overflow(int_type c) {
  const std::lock_guard lock(mutex_);
  erase();
  picture_rows_ = 0;
  if (c != traits_type::eof()) terminal_.put(static_cast<char>(c));
  return traits_type::not_eof(c);
}

std::streamsize StatusLine::Buffer::xsputn(const char* text, std::streamsize size) {
  const std::lock_guard lock(mutex_);
  erase();
  picture_rows_ = 0;
  terminal_.write(text, size);
  return size;
}

int StatusLine::Buffer::sync() {
  const std::lock_guard lock(mutex_);
  return terminal_.flush() ? 0 : -1;
}

void StatusLine::Buffer::erase() {
  if (is_shown_) terminal_ << "\r\x1b[K" << std::flush;
  is_shown_ = false;
}

}  // namespace sdlc::cli
