#include "lsp/log.hpp"

#include <cerrno>
#include <chrono>
#include <cstring>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "render/image/io_error.hpp"

namespace sdlc::lsp {

Log::Log(const std::filesystem::path& file) : out_(file, std::ios::app) {
  if (!out_) throw render::IoError("write", file, std::strerror(errno));
}

void Log::write(std::string_view line) {
  if (!out_.is_open()) return;
  const auto now = std::chrono::system_clock::now();
  const auto milliseconds =
      std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count() % 1000;
  const std::string text =
      fmt::format("{:%H:%M:%S}.{:03} {}\n", fmt::localtime(now), milliseconds, line);
  const std::scoped_lock lock(mutex_);
  out_ << text << std::flush;
}

void Log::trace(std::string_view direction, std::string_view message) {
  const Trace trace = trace_;
  if (trace == Trace::Off || !out_.is_open()) return;
  constexpr std::size_t kShown = 200;
  const bool is_cut = trace == Trace::Messages && message.size() > kShown;
  write(fmt::format("{} {}{}", direction, is_cut ? message.substr(0, kShown) : message,
                    is_cut ? " …" : ""));
}

}  // namespace sdlc::lsp
