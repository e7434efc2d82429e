#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

#include "lsp/json_rpc.hpp"

namespace sdlc::lsp {

/// A render that the user asks for.
struct RenderOrder {
  std::filesystem::path scene = {};                   ///< absolute
  std::shared_ptr<const std::string> text = nullptr;  ///< unsaved; null: the file
  std::string camera = {};                            ///< empty: the scene's choice
  std::optional<int> frame = {};                      ///< of an animation
  int threads = 0;                                    ///< 0: the scene's choice, else all
  bool is_sandboxed = false;
};

/// Renders scenes with the program itself, as child processes, and shows their progress and the
/// pictures in the editor. A scene has one render at a time: a new one replaces it. Pictures are
/// written to a temporary folder, which is removed at the end. All functions may be called by every
/// thread and return at once.
class RenderRuns {
 public:
  /// Send messages to the client. Called on the thread of the renders.
  using Notify = std::function<void(std::string_view method, Json params)>;
  /// `on_result` may be called on any thread, or never; a null pointer for an error.
  using Request = std::function<void(std::string_view method, Json params,
                                     std::function<void(const Json*)> on_result)>;
  /// What the client can do.
  struct Abilities {
    bool has_progress = false;     ///< window.workDoneProgress
    bool shows_documents = false;  ///< window.showDocument
  };

  /// `program`: the path of `sdlc`. Throws std::system_error.
  RenderRuns(std::string program, Notify notify, Request request);
  /// Kills all renders.
  ~RenderRuns();
  RenderRuns(const RenderRuns&) = delete;
  RenderRuns& operator=(const RenderRuns&) = delete;

  void start(RenderOrder order, const Abilities& abilities);
  /// `window/workDoneProgress/cancel`: stops the render with this token, if there is one.
  void cancel(const Json& token);

 private:
  class Runner;
  class Jobs;

  std::shared_ptr<Jobs> jobs_;  // also held by results that the client still owes
  std::thread thread_;
};

}  // namespace sdlc::lsp
