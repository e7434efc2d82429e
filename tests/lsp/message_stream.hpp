#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <streambuf>
#include <string>
#include <string_view>

namespace sdlc::test {

/// A pipe within the process: what one thread writes, another reads, and waits for.
class MessageStream final : public std::streambuf {
 public:
  void write(std::string_view text) {
    const std::scoped_lock lock(mutex_);
    pending_ += text;
    arrived_.notify_all();
  }
  /// Readers reach the end of the stream.
  void close() {
    const std::scoped_lock lock(mutex_);
    is_closed_ = true;
    arrived_.notify_all();
  }

 protected:
  int_type underflow() override {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [this] { return !pending_.empty() || is_closed_; });
    if (pending_.empty()) return traits_type::eof();
    current_ = std::move(pending_);
    pending_.clear();
    setg(current_.data(), current_.data(), current_.data() + current_.size());
    return traits_type::to_int_type(current_.front());
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    write({text, static_cast<std::size_t>(size)});
    return size;
  }
  int_type overflow(int_type c) override {
    if (!traits_type::eq_int_type(c, traits_type::eof())) {
      const char byte = traits_type::to_char_type(c);
      write({&byte, 1});
    }
    return traits_type::not_eof(c);
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::string pending_, current_;
  bool is_closed_ = false;
};

}  // namespace sdlc::test
