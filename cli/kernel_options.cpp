#include "cli/kernel_options.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/words.hpp"
#include "render/scene/instances.hpp"
#include "render/wide/isa.hpp"

namespace sdlc::cli {
namespace {

using render::Isa;
using render::KernelKind;

constexpr std::string_view kAuto = "auto";
constexpr std::array kKinds{KernelKind::Scalar, KernelKind::Wide, KernelKind::Bvh};

/// Adds an option with the values `auto` and the names of `choices`; the given one is stored in
/// `chosen`.
template <typename T, std::size_t N>
void add_choice(CLI::App& command, const char* flag, const std::array<T, N>& choices,
                std::optional<T>& chosen, const char* help) {
  static const std::array<std::string_view, N + 1> words = [&] {
    std::array<std::string_view, N + 1> names{kAuto};
    std::ranges::transform(choices, names.begin() + 1, [](T choice) { return name_of(choice); });
    return names;
  }();
  const auto choose = [&chosen, &choices](const std::string& word) {
    const auto found = std::ranges::find(choices, word, [](T choice) { return name_of(choice); });
    chosen = found == choices.end() ? std::nullopt : std::optional(*found);
  };
  command.add_option_function<std::string>(flag, choose, help)->check(one_of(words));
}

}  // namespace

void add_kernel_options(CLI::App& command, render::KernelRequest& request) {
  add_choice(command, "--kernel", kKinds, request.kind,
             "How paths are traced: one at a time, or one per vector lane; with all spheres tested "
             "per ray, or with a BVH");
  add_choice(command, "--isa", render::kIsas, request.isa,
             "The instruction set of the wide kernels; auto: the best available");
}

lang::Instancing instancing_for(const render::KernelRequest& flags,
                                const lang::Overrides& overrides) {
  const bool are_supported = flags.kind.value_or(KernelKind::Bvh) == KernelKind::Bvh &&
                             overrides.word(lang::render_property::kPrecision) != "float";
  if (overrides.instancing == lang::Instancing::Auto && !are_supported) {
    return lang::Instancing::Never;
  }
  return overrides.instancing;
}

render::Kernel choose_kernel(const render::KernelRequest& flags, const lang::Overrides& overrides,
                             lang::LoweredScene& lowered, lang::Compiler& compiler) {
  render::KernelRequest request = flags;
  request.precision = lowered.precision;
  // A precision in the scene is a preference; one from a flag is required.
  request.may_take_double = !overrides.has(lang::render_property::kPrecision);
  render::Kernel kernel = render::choose_kernel(lowered.scene, lowered.settings, request);
  // Instances were not requested explicitly, and most scenes fit into memory without them.
  constexpr std::uint64_t kMaxPlainSpheres = 100'000'000;
  if (!kernel.refusal.empty() && overrides.instancing == lang::Instancing::Auto &&
      !lowered.scene.instances.empty() && count_spheres(lowered.scene) <= kMaxPlainSpheres) {
    lowered.scene = without_instances(std::move(lowered.scene));
    kernel = render::choose_kernel(lowered.scene, lowered.settings, request);
  }
  if (kernel.refusal.empty() && lowered.camera) {
    compiler.warn_of_precision(lowered, kernel.precision, kernel.bounds);
  }
  return kernel;
}

void check_not_refused(const render::Kernel& kernel) {
  if (!kernel.refusal.empty()) throw UsageError(kernel.refusal);
}

std::string_view instruction_set(const render::Kernel& kernel) noexcept {
  return kernel.isa ? name_of(*kernel.isa) : std::string_view(kInstructionSet);
}

}  // namespace sdlc::cli
