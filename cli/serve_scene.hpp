#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/environment.hpp"
#include "cli/scene_options.hpp"
#include "cli/serve_choices.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"
#include "render/kernel/kernel.hpp"
#include "render/scene/scene.hpp"
#include "render/session/prepared_scene.hpp"

namespace sdlc::cli {

/// The command line of `sdlc serve`.
struct ServeOptions {
  SceneOptions scene;
  lang::Overrides overrides;
  render::KernelRequest kernel;
  int port = 0;             ///< 0: any that is free
  bool has_editor = false;  ///< an editor talks over the standard streams
};

/// A param of the scene.
struct ServedParam {
  std::string name;
  std::string type;           ///< as in the language: "length"
  std::string default_value;  ///< as --set takes it; empty if it has none
  std::string hex;            ///< of a colour: the nearest `#rrggbb`; may be empty
  std::string documentation;
};

/// A finding about the scene.
struct ServedFinding {
  bool is_error = true;
  std::string_view code;
  std::string message;
  std::vector<std::string> help;
  std::string text;  ///< the whole finding with its excerpt, as `sdlc lint` prints it
  lang::Location where;
};

/// The scene at one state of its text and of the choices, ready to be rendered if it is correct.
/// Used by one thread at a time, `prepared` by any number.
struct ServedScene {
  std::shared_ptr<const lang::StopRequest> stop;
  std::shared_ptr<const lang::Document> source;  ///< null: it could not be read
  lang::DiagnosticSink sink;
  std::optional<lang::Compiler> compiler;
  std::optional<lang::Animation> animation;
  std::vector<ServedParam> params;
  std::vector<std::string> cameras;  ///< the names of all, of a scene
  std::vector<ServedFinding> findings;
  std::size_t errors = 0;
  std::string failure;  ///< why it cannot be rendered, beside errors in the text; may be empty
  /// The rest only if `prepared` is not null.
  lang::LoweredScene lowered;  ///< with the pose of the choices
  bool has_pose = false;
  std::shared_ptr<const render::PreparedScene> prepared;

  explicit ServedScene(std::shared_ptr<const lang::StopRequest> request)
      : stop(std::move(request)), sink(stop.get()) {}
};

/// Called once a scene is known to be correct, before it is prepared, which takes all processors.
/// May return one that has been prepared for an equal scene.
using OnCorrect =
    std::function<std::shared_ptr<const render::PreparedScene>(const lang::LoweredScene& lowered)>;

/// Compiles and prepares the scene. Choices that the text does not have any more are removed from
/// `choices`. Throws lang::StopRequested.
std::unique_ptr<ServedScene> serve_scene(const ServeOptions& options, ServeChoices& choices,
                                         std::shared_ptr<const lang::StopRequest> stop,
                                         const OnCorrect& on_correct, Environment& env);

/// Whether both names are of one file.
bool are_same_file(const std::filesystem::path& a, const std::filesystem::path& b);
/// Whether the scene is, or reads, this file.
bool reads(const ServedScene& scene, const std::filesystem::path& path);

/// The text of the camera, with the pose of the choices: its declaration if that is in the file,
/// else only the pose. Precondition: the scene is prepared.
std::string camera_text(const ServedScene& scene);

}  // namespace sdlc::cli
