#pragma once

#include <mutex>
#include <ostream>
#include <streambuf>
#include <string_view>

namespace sdlc::cli {

/// The stream of a terminal with one line below all other output, which show() replaces. Threads
/// may write and show() at the same time.
class StatusLine final : public std::ostream {
 public:
  explicit StatusLine(std::ostream& terminal);
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  void show(std::string_view text) { buffer_.show(text); }

 private:
  class Buffer final : public std::streambuf {
   public:
    explicit Buffer(std::ostream& terminal) : terminal_(terminal) {}
    ~Buffer() override { erase(); }
    void show(std::string_view text);

   private:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;
    void erase();

    std::mutex mutex_;
    std::ostream& terminal_;
    bool is_shown_ = false;
  };

  Buffer buffer_;
};

}  // namespace sdlc::cli
