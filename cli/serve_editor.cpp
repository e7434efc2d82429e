#include "cli/serve_editor.hpp"

#include <array>
#include <cstdint>
#include <stop_token>
#include <utility>

#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

namespace sdlc::cli {

ServeEditor::ServeEditor(Handlers handlers)
    : handlers_(std::move(handlers)), thread_([this](const std::stop_token& stop) { run(stop); }) {}

void ServeEditor::run(const std::stop_token& stop) {
  constexpr int kMilliseconds = 100;
  std::string line;
  bool is_too_long = false;
  while (!stop.stop_requested()) {
    pollfd ready{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (::poll(&ready, 1, kMilliseconds) <= 0) continue;
    std::array<char, 1 << 16> bytes{};
    const ssize_t size = ::read(STDIN_FILENO, bytes.data(), bytes.size());
    if (size <= 0) return handlers_.ended();
    for (const char c : std::string_view(bytes.data(), static_cast<std::size_t>(size))) {
      if (c != '\n') {
        is_too_long = is_too_long || line.size() >= kMaxLine;
        if (!is_too_long) line += c;
        continue;
      }
      if (!std::exchange(is_too_long, false)) take(line);
      line.clear();
    }
  }
}

void ServeEditor::take(std::string_view line) {
  const nlohmann::json message = nlohmann::json::parse(line, nullptr, false);
  if (!message.is_object()) return;
  try {
    const std::filesystem::path path = message.value("path", std::string());
    if (path.empty()) return;
    const std::string type = message.value("type", std::string());
    if (type == "text") {
      const auto text = message.find("text");
      const bool is_open = text != message.end() && text->is_string();
      handlers_.changed(path, is_open ? std::optional(text->get<std::string>()) : std::nullopt);
    } else if (type == "cursor") {
      handlers_.moved({.path = path,
                       .position = {.line = message.value("line", std::uint32_t{1}),
                                    .column = message.value("column", std::uint32_t{1})}});
    }
  } catch (const nlohmann::json::exception&) {
    // A value of another type than an editor sends.
  }
}

}  // namespace sdlc::cli
