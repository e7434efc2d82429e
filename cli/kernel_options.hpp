#pragma once

#include <string_view>

#include <CLI/CLI.hpp>

#include "lang/compile/compile.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"
#include "render/tiles/kernel.hpp"

namespace sdlc::cli {

/// Whether a scene may have instances: `auto` makes none where the kernel or the precision that is
/// asked for cannot take them.
lang::Instancing instancing_for(const render::KernelRequest& flags,
                                const lang::Overrides& overrides);

/// Adds --kernel and --isa, which force what is otherwise chosen by itself.
void add_kernel_options(CLI::App& command, render::KernelRequest& request);

/// The kernel that flags and scene ask for together. Where its precision does not resolve the scene
/// that `compiler` lowered last, there is a warning of that. Instances that nobody asked for, and
/// that no kernel can take, become spheres of their own.
render::Kernel choose_kernel(const render::KernelRequest& flags, const lang::Overrides& overrides,
                             lang::LoweredScene& lowered, lang::Compiler& compiler);

/// Throws UsageError if the requested kernel was refused.
void check_not_refused(const render::Kernel& kernel);

/// The instruction set, for messages.
std::string_view instruction_set(const render::Kernel& kernel) noexcept;

}  // namespace sdlc::cli
