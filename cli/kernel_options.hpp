#pragma once

#include <string_view>

#include <CLI/CLI.hpp>

#include "lang/lower/scene_builder.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::cli {

/// --kernel and --isa, which force what is otherwise chosen by itself.
void add_kernel_options(CLI::App& command, render::KernelRequest& request);

/// What flags and scene ask for together.
render::KernelRequest kernel_request(const render::KernelRequest& flags,
                                     const lang::LoweredScene& lowered,
                                     const lang::Overrides& overrides);

/// The kernel for a scene; throws UsageError where it cannot be the one that is asked for.
render::Kernel chosen_kernel(const lang::LoweredScene& lowered,
                             const render::KernelRequest& request);

/// What the kernel runs on, as users are told.
std::string_view instruction_set(const render::Kernel& kernel) noexcept;

}  // namespace sdlc::cli
