#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "render/denoise/cross_filter.hpp"
#include "render/kernel/path_kernel.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// A model of the time per ray, in nanoseconds on one thread. The constants are fitted to a ground
/// with 8 to 250 spheres on it, on an AMD EPYC with AVX-512.
struct SearchCost {
  double all = 0, per_sphere = 0;  ///< Search::All
  double bvh = 0, per_level = 0;   ///< Search::Bvh

  double of(Search search, std::size_t spheres) const noexcept;
};

/// The kernels, built for one instruction set. Backends exist once, so their addresses identify
/// them. The only other code that depends on instruction sets is that of the kernels, and of
/// render/denoise.
struct Backend {
  std::string_view name;
  std::size_t vector_bytes = 0;
  /// Sums of products are rounded once (fused multiply-add). Backends that agree in this give the
  /// same bytes.
  bool is_fused = false;
  bool has_float = false;                     ///< Precision::Float and Mixed, too
  bool allows_camera_on_surfaces = false;     ///< several at once, with Search::Bvh
  bool (*is_available)() noexcept = nullptr;  ///< on this machine
  ChooseKernel<float>* kernel_in_float = nullptr;
  ChooseKernel<double>* kernel_in_double = nullptr;
  CrossFilter* filter = nullptr;
  SearchCost cost_in_float{}, cost_in_double{};

  std::size_t lanes(Precision precision) const noexcept {
    return vector_bytes / (precision == Precision::Double ? sizeof(double) : sizeof(float));
  }
  const SearchCost& cost(Precision precision) const noexcept {
    return precision == Precision::Double ? cost_in_double : cost_in_float;
  }
};

/// All backends of this build: the portable one, then vectors in ascending order of speed.
std::span<const Backend> backends() noexcept;

/// For every machine, in double: the kernel `scalar`.
inline const Backend& portable_backend() noexcept { return backends().front(); }
/// The others.
inline std::span<const Backend> vector_backends() noexcept { return backends().subspan(1); }

/// The vector backends that this machine can run. Empty if it can run none.
std::span<const Backend* const> available_vectors() noexcept;
/// The last of them, or the portable one.
const Backend& best_backend() noexcept;

}  // namespace sdlc::render
