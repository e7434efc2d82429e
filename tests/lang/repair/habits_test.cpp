#include "lang/repair/habits.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(Habits, AreFoundByPlaceAndWord) {
  EXPECT_EQ(find_habit(HabitPlace::Sign, "&&")->meant, "and");
  EXPECT_EQ(find_habit(HabitPlace::Callee, "glass")->meant, "transmissive");
  EXPECT_EQ(find_habit(HabitPlace::Name, "glass"), std::nullopt);
  EXPECT_EQ(find_habit(HabitPlace::Kind, "sun moon"), std::nullopt);
  EXPECT_EQ(find_habit(HabitPlace::Kind, ""), std::nullopt);
}

TEST(Habits, OfPropertiesKnowTheKeysOfJson) {
  for (const Kind& kind : all_kinds()) {
    for (std::size_t i = 0; i < kind.properties.size(); ++i) {
      const std::string_view key = json_key_of(kind, i);
      if (key.empty()) continue;
      const auto habit = property_habit(kind, key);
      ASSERT_TRUE(habit) << key;
      EXPECT_EQ(json_key_of(kind, i), key);
    }
  }
}

TEST(ForeignSigns, AreTheLongestThatFit) {
  EXPECT_EQ(foreign_sign_at("!== b"), "!==");
  EXPECT_EQ(foreign_sign_at("!a"), "!");
  EXPECT_EQ(foreign_sign_at("!= b"), "");
  EXPECT_EQ(foreign_sign_at("... 3"), "...");
  EXPECT_EQ(foreign_sign_at("...3"), "");  // the interval to 0.3
  EXPECT_EQ(foreign_sign_at("..3"), "");
  EXPECT_EQ(foreign_sign_at(""), "");
}

TEST(ColorsWithoutTheirSign, HaveThreeOrSixDigits) {
  EXPECT_TRUE(is_color_without_sign("80b3ff"));
  EXPECT_TRUE(is_color_without_sign("f80"));
  EXPECT_FALSE(is_color_without_sign("fade"));
  EXPECT_FALSE(is_color_without_sign("80b3"));
  EXPECT_FALSE(is_color_without_sign("80g3ff"));
}

}  // namespace
}  // namespace sdlc::lang
