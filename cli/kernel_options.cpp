#include "cli/kernel_options.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "cli/words.hpp"
#include "render/wide/isa.hpp"

namespace sdlc::cli {
namespace {

using render::Isa;
using render::KernelKind;
using render::Precision;

constexpr std::array<std::string_view, 3> kKernelWords{"auto", "scalar", "wide"};
constexpr std::array<std::string_view, 3> kPrecisionWords{"auto", "float", "double"};
constexpr std::array<Isa, 3> kIsas{Isa::Sse4, Isa::Avx2, Isa::Avx512};

}  // namespace

void add_kernel_options(CLI::App& command, render::KernelRequest& request) {
  command
      .add_option_function<std::string>(
          "--kernel",
          [&request](const std::string& word) {
            if (word == "scalar") request.kind = KernelKind::Scalar;
            if (word == "wide") request.kind = KernelKind::Wide;
          },
          "How paths are traced: one at a time, or one in every lane of a vector")
      ->check(one_of(kKernelWords));
  command
      .add_option_function<std::string>(
          "--precision",
          [&request](const std::string& word) {
            if (word == "float") request.precision = Precision::Float;
            if (word == "double") request.precision = Precision::Double;
          },
          "Of the numbers of the paths; auto: float where rounding cannot be seen")
      ->check(one_of(kPrecisionWords));
  command
      .add_option_function<std::string>(
          "--isa",
          [&request](const std::string& word) {
            const auto found = std::find(kIsaWords.begin(), kIsaWords.end(), word);
            request.isa = kIsas[static_cast<std::size_t>(found - kIsaWords.begin())];
          },
          "The instruction set; default: the best of the machine")
      ->check(one_of(kIsaWords));
}

render::Kernel chosen_kernel(const render::Scene& scene, const render::RenderSettings& settings,
                             const render::KernelRequest& request) {
  render::Kernel kernel = render::choose_kernel(scene, settings, request);
  if (!kernel.refusal.empty()) throw UsageError(kernel.refusal);
  return kernel;
}

std::string_view instruction_set(const render::Kernel& kernel) noexcept {
  return kernel.isa ? name_of(*kernel.isa) : std::string_view(kInstructionSet);
}

}  // namespace sdlc::cli
