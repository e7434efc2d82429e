#pragma once

#include <span>

#include "lang/value/builtins.hpp"

/// The tables of built-in functions by topic, which all_builtins() joins.
namespace sdlc::lang {

std::span<const Builtin> number_functions() noexcept;
std::span<const Builtin> motion_functions() noexcept;
std::span<const Builtin> angle_functions() noexcept;
std::span<const Builtin> vector_functions() noexcept;
std::span<const Builtin> list_functions() noexcept;
std::span<const Builtin> text_functions() noexcept;
std::span<const Builtin> random_functions() noexcept;

}  // namespace sdlc::lang
