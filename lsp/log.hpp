#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string_view>

namespace sdlc::lsp {

/// How much of the protocol is written to the log.
enum class Trace : std::uint8_t { Off, Messages, Verbose };

/// The file of `--log`: what the server does, with times, and by the trace level the messages. Used
/// by every thread.
class Log {
 public:
  /// Without a file, the log is dropped.
  Log() = default;
  /// Appends to the file. Throws render::IoError if it cannot be opened.
  explicit Log(const std::filesystem::path& file);

  void set_trace(Trace trace) noexcept { trace_ = trace; }
  void write(std::string_view line);
  /// The JSON of a message.
  void sent(std::string_view message) { trace("sent", message); }
  void received(std::string_view message) { trace("received", message); }

 private:
  void trace(std::string_view direction, std::string_view message);

  std::mutex mutex_;
  std::ofstream out_;
  std::atomic<Trace> trace_ = Trace::Off;
};

}  // namespace sdlc::lsp
