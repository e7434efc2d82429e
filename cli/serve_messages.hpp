#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/json_values.hpp"
#include "cli/serve_picture.hpp"
#include "cli/serve_render.hpp"
#include "cli/serve_scene.hpp"
#include "lang/compile/compile.hpp"
#include "lang/source/source.hpp"
#include "render/kernel/tracer.hpp"

/// The messages of `sdlc serve` to its pages, which docs/serve.md describes.
namespace sdlc::cli {

/// A place in a text, for people and editors.
Json place_json(const lang::Location& where);

/// What a scene is: its choices, findings and camera. `shown`: the last correct one, which may be
/// the same; null if there is none. `command`: what renders it.
/// `has_editor`: places are opened by an editor that runs the program.
Json scene_json(std::uint64_t number, const ServedScene& scene, const ServedScene* shown,
                const ServeChoices& choices, const std::string& command, bool has_editor);

Json progress_json(const ServeRender::Progress& progress);

/// How much of a picture is shown.
struct PictureView {
  ServedChannel channel = ServedChannel::Color;
  double exposure = 0;  ///< in stops

  friend bool operator==(const PictureView&, const PictureView&) = default;
};
/// A binary message: the length of a JSON text as 4 bytes, little-endian; the text; the codes.
std::string picture_message(const ServedPicture& picture, const PictureView& view);

/// The values of a pixel of the finished picture's size.
Json pixel_json(const ServedPicture& picture, int x, int y);

/// The sphere at a pixel, and where the text makes it. `origin` is null for an instanced one.
Json sphere_json(const render::Scene& scene, const render::PickedSphere& picked,
                 const lang::Origin* origin);

/// The arguments of `sdlc render` for what the arguments of `sdlc serve` and the choices show.
std::string render_command(std::span<const std::string> arguments, const ServeChoices& choices);

}  // namespace sdlc::cli
