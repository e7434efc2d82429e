#pragma once

#include <string_view>

#include <CLI/CLI.hpp>

#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::cli {

/// --kernel, --precision and --isa, which force what is otherwise chosen by itself.
void add_kernel_options(CLI::App& command, render::KernelRequest& request);

/// The kernel for a scene; throws UsageError where it cannot be the one that is asked for.
render::Kernel chosen_kernel(const render::Scene& scene, const render::RenderSettings& settings,
                             const render::KernelRequest& request);

/// What the kernel runs on, as users are told.
std::string_view instruction_set(const render::Kernel& kernel) noexcept;

}  // namespace sdlc::cli
