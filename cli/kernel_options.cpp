#include "cli/kernel_options.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "render/kernel/backend.hpp"
#include "render/scene/instances.hpp"

namespace sdlc::cli {
namespace {

using render::KernelObstacle;
using render::KernelRefusal;
using render::Search;

constexpr std::string_view kAuto = "auto";
constexpr std::string_view kScalar = "scalar";

/// The part of a request, or of a scene, as its flag.
std::string_view flag_of(KernelRefusal::Subject subject) {
  switch (subject) {
    case KernelRefusal::Subject::Search: return "--kernel";
    case KernelRefusal::Subject::Precision: return "--precision";
    case KernelRefusal::Subject::Backend: return "--isa";
    default: return "--instances";
  }
}

std::string describe(const KernelRefusal& refusal) {
  const std::string obstacle = describe(refusal.obstacle);
  const std::string flag(flag_of(refusal.subject));
  switch (refusal.obstacle) {
    case KernelObstacle::OtherMachine:
      return fmt::format("{}: this machine has no {}", flag, refusal.backend->name);
    case KernelObstacle::PortableInDouble:
      return fmt::format("{}: {}; omit --precision", flag, obstacle);
    case KernelObstacle::TooManySpheres:
      return fmt::format("{}: not with {}; use --kernel bvh", flag, obstacle);
    case KernelObstacle::InstancesByBvh:
    case KernelObstacle::InstancesInDouble:
      return fmt::format("{}: {}; --instances never expands them", flag, obstacle);
    default: break;
  }
  if (refusal.subject == KernelRefusal::Subject::Instances) {
    return fmt::format("{}: not if {}; --instances never expands them", flag, obstacle);
  }
  return fmt::format("{}: not with the wide kernels: {}", flag, obstacle);
}

}  // namespace

void add_kernel_options(Command& command, render::KernelRequest& request) {
  static constexpr std::array<std::string_view, 4> kKernels{kAuto, kScalar, "wide", "bvh"};
  command
      .add_text(
          "--kernel",
          [&request](const std::string& word) {
            if (word == kScalar) request.backend = &render::portable_backend();
            if (word == "wide") request.search = Search::All;
            if (word == "bvh") request.search = Search::Bvh;
          },
          "How paths are traced: on every machine alike, or with its vectors; with all spheres "
          "tested per ray, or with a BVH")
      .one_of(kKernels);

  static const std::vector<std::string_view> isas = [] {
    std::vector<std::string_view> names{kAuto};
    for (const render::Backend& backend : render::vector_backends()) names.push_back(backend.name);
    return names;
  }();
  command
      .add_text(
          "--isa",
          [&request](const std::string& word) {  // after that of --kernel
            if (word == kAuto) return;
            if (request.backend != nullptr) {
              throw UsageError(
                  "--isa: the scalar kernel has no other instruction sets; omit --isa");
            }
            const auto all = render::vector_backends();
            request.backend = &*std::ranges::find(all, word, &render::Backend::name);
          },
          "The instruction set of the wide kernels; auto: the best available")
      .one_of(isas);
}

lang::Instancing instancing_for(const render::KernelRequest& flags,
                                const lang::Overrides& overrides) {
  const bool are_supported = flags.search.value_or(Search::Bvh) == Search::Bvh &&
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
  if (kernel.refusal && overrides.instancing == lang::Instancing::Auto &&
      !lowered.scene.instances.empty() && count_spheres(lowered.scene) <= kMaxPlainSpheres) {
    lowered.scene = without_instances(std::move(lowered.scene));
    kernel = render::choose_kernel(lowered.scene, lowered.settings, request);
  }
  if (!kernel.refusal && lowered.camera) {
    compiler.warn_of_precision(lowered, kernel.precision, kernel.bounds);
  }
  return kernel;
}

void check_not_refused(const render::Kernel& kernel) {
  if (kernel.refusal) throw UsageError(describe(*kernel.refusal));
}

std::string reason_for(const render::Kernel& kernel) {
  std::string reason =
      kernel.obstacle ? render::describe(*kernel.obstacle) : kernel.precision_reason;
  if (!kernel.ray_times) return reason;
  return fmt::format("{}; model: {:.0f} ns per ray with every sphere, {:.0f} with a BVH", reason,
                     kernel.ray_times->all, kernel.ray_times->bvh);
}

std::string_view instruction_set(const render::Kernel& kernel) noexcept {
  return kernel.is_portable() ? std::string_view(kInstructionSet) : kernel.backend->name;
}

}  // namespace sdlc::cli
