#include "render/kernel/backend.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <hwy/detect_targets.h>

// The kernels of each instruction set are in path_kernel.cpp, path_kernel_lights_*.cpp and
// portable_kernel.cpp, the filters in render/denoise.
#define SDLC_DECLARE_KERNELS(target)                                            \
  namespace target {                                                            \
  TraceRuns<float>* kernel_for(float type, KernelFeatures features) noexcept;   \
  TraceRuns<double>* kernel_for(double type, KernelFeatures features) noexcept; \
  CrossFilter filter_tile;                                                      \
  }
#define SDLC_CHOOSE_KERNELS(target)                                                           \
  .kernel_in_float = [](KernelFeatures of) noexcept { return target::kernel_for(0.0F, of); }, \
  .kernel_in_double = [](KernelFeatures of) noexcept { return target::kernel_for(0.0, of); }, \
  .filter = target::filter_tile

namespace sdlc::render {

#if HWY_TARGETS & HWY_SSE4
SDLC_DECLARE_KERNELS(N_SSE4)
#endif
#if HWY_TARGETS & HWY_AVX2
SDLC_DECLARE_KERNELS(N_AVX2)
#endif
#if HWY_TARGETS & HWY_AVX3
SDLC_DECLARE_KERNELS(N_AVX3)
#endif
#if HWY_TARGETS & HWY_NEON
SDLC_DECLARE_KERNELS(N_NEON)
#endif
#if HWY_TARGETS & HWY_WASM
SDLC_DECLARE_KERNELS(N_WASM)
#endif

namespace {

// Highway can detect instruction sets too, but loading its library takes 2 ms in every command.
#if HWY_ARCH_X86
bool has_sse4() noexcept { return __builtin_cpu_supports("sse4.2"); }
bool has_avx2() noexcept {
  return has_sse4() && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
bool has_avx512() noexcept {
  return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd");
}
#endif
bool always() noexcept { return true; }

// Measured with SSE4.
[[maybe_unused]] constexpr SearchCost kCostInFloatOf16Bytes{
    .all = 35, .per_sphere = 0.83, .bvh = 60, .per_level = 3.5};
[[maybe_unused]] constexpr SearchCost kCostInDoubleOf16Bytes{
    .all = 64, .per_sphere = 1.43, .bvh = 116, .per_level = 6.2};

constexpr std::array kBackends {
  Backend{.name = "portable",
          .vector_bytes = 16,
          .allows_camera_on_surfaces = true,
          .is_available = always,
          .kernel_in_double = portable_kernel,
          .filter = portable_filter,
          .cost_in_double = {.all = 120, .per_sphere = 1.5, .bvh = 190, .per_level = 4}},
#if HWY_TARGETS & HWY_SSE4
      Backend{.name = "sse4",
              .vector_bytes = 16,
              .has_float = true,
              .is_available = has_sse4,
              SDLC_CHOOSE_KERNELS(N_SSE4),
              .cost_in_float = kCostInFloatOf16Bytes,
              .cost_in_double = kCostInDoubleOf16Bytes},
#endif
#if HWY_TARGETS & HWY_AVX2
      Backend{.name = "avx2",
              .vector_bytes = 32,
              .is_fused = true,
              .has_float = true,
              .is_available = has_avx2,
              SDLC_CHOOSE_KERNELS(N_AVX2),
              .cost_in_float = {.all = 21, .per_sphere = 0.29, .bvh = 40, .per_level = 3.5},
              .cost_in_double = {.all = 37, .per_sphere = 0.49, .bvh = 75, .per_level = 3.6}},
#endif
#if HWY_TARGETS & HWY_AVX3
      Backend{.name = "avx512",
              .vector_bytes = 64,
              .is_fused = true,
              .has_float = true,
              .is_available = has_avx512,
              SDLC_CHOOSE_KERNELS(N_AVX3),
              .cost_in_float = {.all = 14, .per_sphere = 0.24, .bvh = 28, .per_level = 2.5},
              .cost_in_double = {.all = 22, .per_sphere = 0.45, .bvh = 50, .per_level = 5.2}},
#endif
#if HWY_TARGETS & HWY_NEON  // only if all machines of the build have it
      Backend{.name = "neon",
              .vector_bytes = 16,
              .is_fused = true,
              .has_float = true,
              .is_available = always,
              SDLC_CHOOSE_KERNELS(N_NEON),
              .cost_in_float = kCostInFloatOf16Bytes,
              .cost_in_double = kCostInDoubleOf16Bytes},
#endif
#if HWY_TARGETS & HWY_WASM
      Backend{.name = "wasm",
              .vector_bytes = 16,
              .has_float = true,
              .is_available = always,
              SDLC_CHOOSE_KERNELS(N_WASM),
              .cost_in_float = kCostInFloatOf16Bytes,
              .cost_in_double = kCostInDoubleOf16Bytes},
#endif
};

}  // namespace

double SearchCost::of(Search search, std::size_t spheres) const noexcept {
  const auto count = static_cast<double>(std::max<std::size_t>(spheres, 1));
  return search == Search::All ? all + per_sphere * count : bvh + per_level * std::log2(count);
}

std::span<const Backend> backends() noexcept { return kBackends; }

std::span<const Backend* const> available_vectors() noexcept {
  static const std::vector<const Backend*> available = [] {
    std::vector<const Backend*> found;
    for (const Backend& backend : vector_backends()) {
      if (backend.is_available()) found.push_back(&backend);
    }
    return found;
  }();
  return available;
}

const Backend& best_backend() noexcept {
  return available_vectors().empty() ? portable_backend() : *available_vectors().back();
}

}  // namespace sdlc::render
