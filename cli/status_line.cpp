#include "cli/status_line.hpp"

namespace sdlc::cli {

StatusLine::StatusLine(std::ostream& terminal) : std::ostream(nullptr), buffer_(terminal) {
  rdbuf(&buffer_);
}

void StatusLine::Buffer::show(std::string_view text) {
  const std::lock_guard lock(mutex_);
  terminal_ << '\r' << text << "\x1b[K" << std::flush;
  is_shown_ = true;
}

StatusLine::Buffer::int_type StatusLine::Buffer::overflow(int_type c) {
  const std::lock_guard lock(mutex_);
  erase();
  if (c != traits_type::eof()) terminal_.put(static_cast<char>(c));
  return traits_type::not_eof(c);
}

std::streamsize StatusLine::Buffer::xsputn(const char* text, std::streamsize size) {
  const std::lock_guard lock(mutex_);
  erase();
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
