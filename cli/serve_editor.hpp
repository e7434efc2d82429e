#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "cli/serve_outline.hpp"

namespace sdlc::cli {

/// The editor of `sdlc serve --editor`, which sends a JSON object a line on standard input, as
/// docs/serve.md describes.
class ServeEditor {
 public:
  /// Called on a thread of its own.
  struct Handlers {
    /// nullopt: the file on disk counts again.
    std::function<void(std::filesystem::path path, std::optional<std::string> text)> changed;
    std::function<void(TextPlace cursor)> moved;
    std::function<void()> ended;  ///< the end of the input
  };

  explicit ServeEditor(Handlers handlers);
  ServeEditor(const ServeEditor&) = delete;
  ServeEditor& operator=(const ServeEditor&) = delete;

  /// The most bytes of a line; a longer one is ignored.
  static constexpr std::size_t kMaxLine = std::size_t{256} << 20;

 private:
  void run(const std::stop_token& stop);
  void take(std::string_view line);

  Handlers handlers_;
  std::jthread thread_;
};

}  // namespace sdlc::cli
