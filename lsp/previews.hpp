#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"
#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

/// A text of the editor that is not saved, or may not be.
struct PreviewText {
  std::filesystem::path path;
  std::shared_ptr<const std::string> text;
};

/// Pages that show scenes as they are in the editor: each is a child process `sdlc serve --editor`.
/// Used by the thread of the session.
class Previews {
 public:
  struct Place {
    std::filesystem::path path;
    lang::Position position = {};
  };
  /// A place was clicked. Called on a thread of the preview.
  using OnOpen = std::function<void(const Place& place)>;

  /// `program`: the path of `sdlc`.
  Previews(std::string program, OnOpen on_open);
  /// Ends all.
  ~Previews();
  Previews(const Previews&) = delete;
  Previews& operator=(const Previews&) = delete;

  /// The address of the page of a scene, whose preview is started if there is none. Throws
  /// RequestError if it cannot be started.
  std::string url_of(const std::filesystem::path& scene, const std::vector<PreviewText>& texts,
                     bool is_sandboxed, int threads);
  /// Ends the preview of a scene, if there is one.
  void end(const std::filesystem::path& scene);
  /// null: the file on disk counts again.
  void change(const std::filesystem::path& path, const std::string* text);
  /// The cursor of the editor has moved.
  void move(const Place& cursor);

 private:
  class Preview;

  /// Ends those that do not read any more.
  void send(const Json& message);

  std::string program_;
  OnOpen on_open_;
  std::list<std::unique_ptr<Preview>> previews_;
};

}  // namespace sdlc::lsp
