#pragma once

#include <cstddef>
#include <ostream>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/outputs.hpp"
#include "render/aov/aov.hpp"
#include "render/scene/scene.hpp"
#include "render/tiles/render.hpp"

/// `sdlc render --aov`: auxiliary channels in EXR files.
namespace sdlc::cli {

void add_aov_option(CLI::App& command, render::Aovs& aovs);

/// Throws UsageError where what is asked for cannot be had; before anything is rendered.
void check_aovs(const render::Aovs& aovs, const std::vector<Output>& outputs,
                const render::Scene& scene, const render::RenderSettings& settings);

/// What the channels take while the picture is encoded, and what they are made from.
std::size_t aov_bytes(const render::Aovs& aovs, std::size_t pixels) noexcept;

/// Adds to `layers`, those of the first surfaces, the ones that came about with the picture. What
/// is not known is left out, and `err` told so: of fewer than 8 samples a pixel the variance, and
/// of a render that was interrupted without a goal all that depends on which pixels it reached.
void add_picture_layers(const render::Aovs& aovs, const render::RenderSettings& settings,
                        const render::RenderResult& result, std::vector<render::Layer>& layers,
                        std::ostream& err);

}  // namespace sdlc::cli
