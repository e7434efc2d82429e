#pragma once

#include <string>
#include <string_view>

#include "cli/command_line.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"
#include "render/kernel/kernel.hpp"

namespace sdlc::cli {

/// Whether a scene may have instances: with `auto`, not if the requested kernel or precision does
/// not support them.
lang::Instancing instancing_for(const render::KernelRequest& flags,
                                const lang::Overrides& overrides);

/// Adds --kernel and --isa, which override the automatic choice.
void add_kernel_options(Command& command, render::KernelRequest& request);

/// Chooses the kernel for the flags and the scene, which `compiler` lowered last. Warns if its
/// precision does not resolve the scene. Expands automatic instances if no kernel supports them.
render::Kernel choose_kernel(const render::KernelRequest& flags, const lang::Overrides& overrides,
                             lang::LoweredScene& lowered, lang::Compiler& compiler);

/// Throws UsageError if the requested kernel was refused.
void check_not_refused(const render::Kernel& kernel);

/// Why this kernel was chosen, as clauses.
std::string reason_for(const render::Kernel& kernel);

/// The instruction set, for messages.
std::string_view instruction_set(const render::Kernel& kernel) noexcept;

}  // namespace sdlc::cli
