#include "lang/convert/material_names.hpp"

#include <string>

#include <gtest/gtest.h>

#include "lang/schema/schema.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/types.hpp"
#include "tests/support/configs/config_generator.hpp"

namespace sdlc::lang {
namespace {

MaterialValue material(MaterialKind kind, render::LinearRgb color, double parameter = 0) {
  return {.kind = kind, .color = color, .parameter = parameter, .exact_fresnel = false};
}

TEST(MaterialNames, SayColorAndKind) {
  using enum MaterialKind;
  const render::LinearRgb white{1, 1, 1}, red{1, 0, 0}, lamp{20, 20, 0};
  EXPECT_EQ(describing_name(material(Diffuse, red)), "red_matt");
  EXPECT_EQ(describing_name(material(Specular, white)), "mirror");
  EXPECT_EQ(describing_name(material(Specular, red)), "red_mirror");
  EXPECT_EQ(describing_name(material(Specular, white, 0.1)), "white_metal");
  EXPECT_EQ(describing_name(material(Transmissive, white, 1.5)), "glass");
  EXPECT_EQ(describing_name(material(Transmissive, white, 1.33)), "water");
  EXPECT_EQ(describing_name(material(Transmissive, white, 1 / 1.5)), "bubble");
  EXPECT_EQ(describing_name(material(Transmissive, red, 1.5)), "red_glass");
  EXPECT_EQ(describing_name(material(Emissive, lamp, 1)), "yellow_light");
  EXPECT_EQ(describing_name(material(Unlit, {0, 0, 0})), "black_unlit");
}

TEST(MaterialNames, AreGivenOnce) {
  MaterialNames names;
  const MaterialValue red = material(MaterialKind::Diffuse, {1, 0, 0});
  EXPECT_EQ(names.name_of(red), "red_matt");
  EXPECT_EQ(names.name_of(red), "red_matt_2");
  EXPECT_EQ(names.name_of(red), "red_matt_3");
}

TEST(MaterialNames, AreNoneOfTheLanguages) {
  const auto is_taken = [](const std::string& name) {
    bool is_kind = false;
    for (const Kind& kind : all_kinds()) is_kind = is_kind || kind.name == name;
    return is_kind || find_named_color(name) || find_builtin(name) || find_constructor(name) ||
           find_type(name);
  };
  test::SplitMix64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto kind = all_materials()[random.below(all_materials().size())].id;
    const double bright = random.one_in(4) ? 1 : random.uniform() * 2;
    const render::LinearRgb color{bright * random.uniform(), bright, bright * random.uniform()};
    const std::string name = describing_name(material(kind, color, random.uniform() * 3));
    EXPECT_FALSE(is_taken(name)) << name;
  }
}

}  // namespace
}  // namespace sdlc::lang
