#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/schema/schema.hpp"
#include "render/scene/settings.hpp"
#include "tests/support/compilation/compilation.hpp"

// Precedence of samples, error and time from the scene and the command line.
namespace sdlc::test {
namespace {

using namespace lang::render_property;
using render::RenderSettings;
using testing::ElementsAre;
using testing::IsEmpty;

const std::string kScene =
    "camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 90deg }\n"
    "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n";

RenderSettings settings_of(const std::string& render, const lang::Overrides& overrides = {}) {
  Compilation compilation({.root = kScene + "render { " + render + " }"});
  const auto lowered = compilation.lower(overrides);
  EXPECT_THAT(compilation.codes(), IsEmpty()) << render;
  return lowered ? lowered->settings : RenderSettings{};
}

TEST(Goals, WithoutOneTheSamplesAreThoseOfTheSceneOrTheFlag) {
  EXPECT_EQ(settings_of("").samples, 64);
  EXPECT_EQ(settings_of("samples: 20").samples, 20);
  EXPECT_EQ(settings_of("samples: 20", {.render = {{kSamples, 30}}}).samples, 30);
  EXPECT_EQ(settings_of("").error, std::nullopt);
  EXPECT_EQ(settings_of("").seconds, std::nullopt);
}

TEST(Goals, TheSamplesOfASceneWithAnErrorAreItsMost) {
  EXPECT_EQ(settings_of("error: 3%").error, 0.03);
  EXPECT_EQ(settings_of("error: 3%").samples, render::kMaxSamples);
  EXPECT_EQ(settings_of("error: 3%, samples: 64").samples, 64);
  EXPECT_EQ(settings_of("error: 3%, samples: 64").error, 0.03);
  EXPECT_EQ(settings_of("error: 3%, samples: 64", {.render = {{kSamples, 10}}}).samples, 10);
  EXPECT_EQ(settings_of("error: 3%", {.render = {{kSamples, 10}}}).error, 0.03);
}

TEST(Goals, AnErrorByFlagTakesThePlaceOfTheScenesSamplesAndError) {
  const RenderSettings settings =
      settings_of("samples: 20, error: 3%", {.render = {{kError, 0.1}}});
  EXPECT_EQ(settings.error, 0.1);
  EXPECT_EQ(settings.samples, render::kMaxSamples);
  EXPECT_EQ(settings.seconds, std::nullopt);
  EXPECT_EQ(settings_of("samples: 20", {.render = {{kSamples, 30}, {kError, 0.1}}}).samples, 30);
}

TEST(Goals, ATimeByFlagTakesThePlaceOfTheScenesSamplesAndError) {
  const RenderSettings settings = settings_of("samples: 20, error: 3%", {.seconds = 5});
  EXPECT_EQ(settings.error, std::nullopt);
  EXPECT_EQ(settings.seconds, 5);
  EXPECT_EQ(settings.samples, render::kMaxSamples);
  EXPECT_EQ(settings_of("samples: 20", {.render = {{kSamples, 30}}, .seconds = 5}).samples, 30);
}

TEST(Goals, ErrorAndTimeByFlagAreBothKept) {
  const RenderSettings settings =
      settings_of("samples: 20", {.render = {{kError, 0.1}}, .seconds = 5});
  EXPECT_EQ(settings.error, 0.1);
  EXPECT_EQ(settings.seconds, 5);
  EXPECT_EQ(settings.samples, render::kMaxSamples);
}

TEST(Goals, OnlyWithAnErrorIsARenderAdaptive) {
  EXPECT_TRUE(settings_of("error: 1%", {.is_adaptive = true}).is_adaptive);
  EXPECT_TRUE(
      settings_of("", {.render = {{kError, 0.1}}, .seconds = 5, .is_adaptive = true}).is_adaptive);
  EXPECT_FALSE(settings_of("error: 1%", {.seconds = 5, .is_adaptive = true}).is_adaptive);
  EXPECT_FALSE(settings_of("error: 1%").is_adaptive);
}

TEST(Goals, APlainPictureIsExactAndHasNone) {
  Compilation compilation(
      {.root = "background { color: red }\nrender { width: 4, height: 3, error: 1%, samples: 2 }"});
  const auto lowered = compilation.lower({.seconds = 5, .is_adaptive = true});
  ASSERT_TRUE(lowered);
  EXPECT_EQ(lowered->settings.samples, 1);
  EXPECT_EQ(lowered->settings.error, std::nullopt);
  EXPECT_EQ(lowered->settings.seconds, std::nullopt);
  EXPECT_FALSE(lowered->settings.is_adaptive);
  EXPECT_THAT(compilation.codes(), IsEmpty());
}

/// The text that W502 marks; empty if it is not reported.
std::vector<std::string> warned_at(const std::string& render, const lang::Overrides& overrides) {
  Compilation compilation({.root = kScene + "render { " + render + " }"});
  compilation.lower(overrides);
  std::vector<std::string> places;
  for (const Told& told : compilation.told()) {
    EXPECT_EQ(told.code, "W502");
    places.push_back(told.at);
  }
  return places;
}

TEST(Goals, FewerThanEightSamplesAreWarnedOfWhereTheyAreAsked) {
  EXPECT_THAT(warned_at("samples: 7, error: 1%", {}), ElementsAre("7"));
  EXPECT_THAT(warned_at("samples: 64, error: 1%", {.render = {{kSamples, 7}}}), ElementsAre("1%"));
  EXPECT_THAT(warned_at("", {.render = {{kSamples, 7}, {kError, 0.1}}}), ElementsAre(""));
}

TEST(Goals, NothingIsWarnedOfWhereAnErrorCanBeKnownOrIsNotAsked) {
  EXPECT_THAT(warned_at("samples: 8, error: 1%", {}), IsEmpty());
  EXPECT_THAT(warned_at("samples: 7, error: 1%", {.render = {{kSamples, 8}}}), IsEmpty());
  EXPECT_THAT(warned_at("samples: 7", {.render = {{kError, 0.1}}}), IsEmpty()) << "the flag's goal";
  EXPECT_THAT(warned_at("samples: 7, error: 1%", {.seconds = 5}), IsEmpty());
  EXPECT_THAT(warned_at("samples: 7", {.seconds = 5}), IsEmpty());
}

/// The default of a property as text, which the renderer's default must be.
template <typename T>
std::string default_of(const lang::Property& property) {
  if constexpr (render::Choice<T>) {
    return std::string(std::get<std::string_view>(property.default_value));
  } else {
    return fmt::to_string(static_cast<T>(std::get<double>(property.default_value)));
  }
}

TEST(Settings, ArePropertiesOfRenderWithTheSameWordsAndDefaults) {
  const auto properties = lang::kind_info(lang::ObjectKind::Render).properties;
  render::for_each_setting([&]<typename T>(const render::Setting<T>& setting) {
    const auto property = std::ranges::find(properties, setting.name, &lang::Property::name);
    ASSERT_NE(property, properties.end()) << setting.name;
    EXPECT_THAT(property->words, testing::ElementsAreArray(render::kWords<T>));
    EXPECT_EQ(default_of<T>(*property),
              fmt::format("{}", render::shown(RenderSettings{}.*setting.member)));
  });
}

TEST(Settings, AFlagHasDashes) { EXPECT_EQ(render::flag_of("light_sampling"), "--light-sampling"); }

TEST(Choices, AreThoseOfTheWordsOrTheFlags) {
  using render::LightSampling;
  using render::SamplerKind;
  EXPECT_EQ(settings_of("").sampler, SamplerKind::Sobol);
  EXPECT_EQ(settings_of("sampler: independent").sampler, SamplerKind::Independent);
  EXPECT_EQ(settings_of("sampler: independent", {.render = {{kSampler, "sobol"}}}).sampler,
            SamplerKind::Sobol);
  EXPECT_EQ(settings_of("").light_sampling, LightSampling::Auto);
  EXPECT_EQ(settings_of("light_sampling: on").light_sampling, LightSampling::On);
  EXPECT_EQ(settings_of("light_sampling: on", {.render = {{kLightSampling, "off"}}}).light_sampling,
            LightSampling::Off);
}

}  // namespace
}  // namespace sdlc::test
