#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "lang/compile/compile.hpp"
#include "lang/convert/convert.hpp"
#include "lang/format/format.hpp"
#include "render/scene/digest.hpp"
#include "render/session/render.hpp"
#include "tests/support/configs/config_generator.hpp"

// Properties of every config: it converts to a scene and back to a config with the same meaning,
// and all three render the same picture. The generated ones have fixed seeds.
namespace sdlc::lang {
namespace {

constexpr int kConfigs = 500;

std::optional<std::string> converted(const std::string& name, const std::string& text) {
  const Document file(name, text);
  DiagnosticSink sink;
  Conversion conversion(file, {}, sink);
  return conversion.run({});
}

std::optional<LoweredScene> lowered(const std::string& name, const std::string& text) {
  const Document file(name, text);
  DiagnosticSink sink;
  return compile(file, {}, sink);
}

/// This many generated configs are valid as a whole.
std::vector<std::string> generated_configs(test::ConfigGenerator& generator) {
  std::vector<std::string> configs;
  int tries = 0;
  while (configs.size() < kConfigs && ++tries < 4 * kConfigs) {
    std::string config = generator.next();
    if (lowered("config.json", config)) configs.push_back(std::move(config));
  }
  return configs;
}

std::vector<std::string> generated_configs() {
  test::ConfigGenerator generator(2026);
  return generated_configs(generator);
}

std::vector<std::string> read_reference_configs() {
  std::vector<std::string> configs;
  for (const auto& path : test::reference_configs()) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    configs.push_back(text.str());
  }
  return configs;
}

void expect_same_lowering(const LoweredScene& a, const LoweredScene& b) {
  EXPECT_EQ(render::digest_of(a.scene), render::digest_of(b.scene));
  EXPECT_EQ(a.settings.width, b.settings.width);
  EXPECT_EQ(a.settings.height, b.settings.height);
  EXPECT_EQ(a.settings.samples, b.settings.samples);
  EXPECT_EQ(a.settings.depth, b.settings.depth);
  EXPECT_EQ(a.settings.seed, b.settings.seed);
  EXPECT_EQ(a.output.output, b.output.output);
  EXPECT_EQ(a.output.mapping, b.output.mapping);
}

void expect_round_trip(const std::string& config) {
  const auto scene = converted("config.json", config);
  ASSERT_TRUE(scene) << config;
  const auto again = converted("config.scene", *scene);
  ASSERT_TRUE(again) << *scene;
  EXPECT_EQ(test::without_what_has_no_effect(nlohmann::json::parse(*again)),
            test::without_what_has_no_effect(nlohmann::json::parse(config)))
      << *scene;

  const auto of_config = lowered("config.json", config), of_scene = lowered("a.scene", *scene);
  ASSERT_TRUE(of_config && of_scene) << *scene;
  SCOPED_TRACE(config + "\n" + *scene);
  expect_same_lowering(*of_config, *of_scene);
}

TEST(RoundTrip, ReachesEveryKeyEveryMaterialAndEverySpelling) {
  test::ConfigGenerator generator(2026);
  ASSERT_EQ(generated_configs(generator).size(), kConfigs);
  EXPECT_THAT(generator.reached(), testing::ContainerEq(test::ConfigGenerator::everything()));
}

TEST(RoundTrip, GivesTheSameConfigAndTheSameSceneForGeneratedConfigs) {
  for (const std::string& config : generated_configs()) {
    expect_round_trip(config);
    if (HasFailure()) return;  // one is enough to read
  }
}

TEST(RoundTrip, GivesTheSameConfigAndTheSameSceneForRealConfigs) {
  const std::vector<std::string> configs = read_reference_configs();
  if (configs.empty()) GTEST_SKIP() << "the reference configs are not here";
  for (const std::string& config : configs) expect_round_trip(config);
}

TEST(RoundTrip, GivesScenesInTheCanonicalLayoutWithoutWarnings) {
  for (const std::string& config : generated_configs()) {
    const auto scene = converted("config.json", config);
    ASSERT_TRUE(scene) << config;
    const Document file("config.scene", *scene);
    DiagnosticSink sink;
    EXPECT_EQ(format_file(file, sink), *scene);
    EXPECT_FALSE(sink.has_errors());
  }
}

TEST(RoundTrip, RendersToTheSameBytes) {
  int rendered = 0;
  std::vector<std::string> configs = generated_configs();
  configs.resize(60);
  for (const std::string& config : configs) {
    auto of_config = lowered("config.json", config);
    auto of_scene = lowered("a.scene", *converted("config.json", config));
    ASSERT_TRUE(of_config && of_scene);
    if (of_config->settings.width > 64 || of_config->scene.spheres.empty()) continue;
    of_config->settings.samples = of_scene->settings.samples = 2;
    render::RenderMonitor monitor;
    const auto a = render::render(of_config->scene, of_config->settings, monitor);
    const auto b = render::render(of_scene->scene, of_scene->settings, monitor);
    EXPECT_TRUE(a.picture.pixels == b.picture.pixels) << config;
    ++rendered;
  }
  EXPECT_GT(rendered, 10);
}

}  // namespace
}  // namespace sdlc::lang
