#pragma once

#include <mutex>
#include <ostream>
#include <streambuf>
#include <string_view>

namespace sdlc::cli {

/// The stream of a terminal with one line below all other output, which show() replaces, and
/// perhaps a picture above it. Threads may write and show at the same time.
class StatusLine final : public std::ostream {
 public:
  explicit StatusLine(std::ostream& terminal);
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(std::string_view text) { buffer_.show(text); }
  /// Draws a picture of `rows` rows above the line: in the place of the one before, unless there
  /// has been other output, or `is_new`. `drawing` begins at the left of the first row, and may
  /// leave the cursor anywhere.
  void show_picture(std::string_view drawing, int rows, bool is_new) {
    buffer_.show_picture(drawing, rows, is_new);
  }

 private:
  class Buffer final : public std::streambuf {
   public:
    explicit Buffer(std::ostream& terminal) : terminal_(terminal) {}
    ~Buffer() override { erase(); }
    void show(std::string_view text);
    void show_picture(std::string_view drawing, int rows, bool is_new);

   private:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;
    void erase();

    std::mutex mutex_;
    std::ostream& terminal_;
    bool is_shown_ = false;
    int picture_rows_ = 0;  // of the picture directly above the line
  };

  Buffer buffer_;
};

}  // namespace sdlc::cli
