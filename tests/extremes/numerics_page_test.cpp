#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/docs/markdown.hpp"
#include "tests/extremes/cases.hpp"
#include "tests/support/temporary_folder.hpp"

// The table of docs/numerics.md contains the measurements of this program. SDLC_UPDATE=1 rewrites
// it.
namespace sdlc::test {
namespace {

using render::LinearRgb;

const std::filesystem::path kPage = std::filesystem::path(SDLC_SOURCE_DIR) / "docs/numerics.md";

std::string shown(LinearRgb c, int digits) {
  const auto number = [&](double v) { return fmt::format("{:.{}g}", v, digits); };
  if (number(c.r) == number(c.g) && number(c.g) == number(c.b)) return number(c.r);
  return fmt::format("{} {} {}", number(c.r), number(c.g), number(c.b));
}

/// One row per variant, with the automatically chosen kernel and precision.
std::string table() {
  std::string text =
      "| case | | expected | got | standard error | |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const ExtremeCase& extreme : extreme_cases()) {
    std::string name = extreme.name;
    for (const ExtremeVariant& variant : extreme.variants) {
      const render::Kernel kernel = choose_kernel(variant.scene, settings_of(variant));
      const Form form{kernel.search,
                      kernel.precision == render::Precision::Double ? render::Precision::Double
                                                                    : render::Precision::Float,
                      kernel.backend};
      const Measured measured = measure(variant, form);
      const LinearRgb error = measured.estimate.standard_error;
      text += fmt::format("| {} | {} | {} | {} | {:.1g} | {} {} |\n", name, variant.what,
                          shown(variant.expected, 6), shown(measured.estimate.mean, 6),
                          std::max({error.r, error.g, error.b}), name_of(kernel),
                          name_of(kernel.precision));
      name.clear();
    }
  }
  return text;
}

TEST(NumericsPage, ShowsWhatIsMeasured) {
  if (!render::best_backend().is_fused) {
    GTEST_SKIP() << "the page shows what a machine with fused multiply-add computes";
  }
  const GeneratedPart measured{"extremes", table()};
  const std::string page = content_of(kPage);
  if (std::getenv("SDLC_UPDATE") != nullptr) {
    return write_text(kPage, replace_generated_part(page, measured));
  }
  const auto parts = generated_parts_of(page);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].text, measured.text) << "SDLC_UPDATE=1 rewrites " << kPage;
}

}  // namespace
}  // namespace sdlc::test
