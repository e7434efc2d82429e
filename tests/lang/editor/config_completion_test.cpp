#include "lang/editor/config_completion.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/editor/config_hover.hpp"

namespace sdlc::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct MarkedConfig {
  explicit MarkedConfig(std::string text)
      : offset(static_cast<std::uint32_t>(text.find('|'))),
        file("picture.json", text.erase(offset, 1)) {}

  std::uint32_t offset;
  lang::SourceFile file;
};

std::vector<lang::CompletionItem> items(const std::string& text) {
  const MarkedConfig config(text);
  return lang::complete_config(config.file, config.offset).items;
}

std::vector<std::string> labels(const std::string& text) {
  std::vector<std::string> all;
  for (const auto& item : items(text)) all.push_back(item.label);
  return all;
}

std::string hover(const std::string& text) {
  const MarkedConfig config(text);
  const auto hover = lang::hover_config(config.file, config.offset);
  return hover ? hover->markdown : "";
}

TEST(ConfigCompletion, OffersMissingKeys) {
  EXPECT_THAT(labels("{|"),
              ElementsAre("camera", "rendering", "saving", "background", "spheres", "image"));
  EXPECT_THAT(labels("{\"camera\": {}, |, \"saving\": {}}"),
              ElementsAre("rendering", "background", "spheres", "image"));
  EXPECT_THAT(labels("{\"rendering\": {\"wi|"), ElementsAre("width"));
  EXPECT_THAT(labels("{\"spheres\": [{\"origin\": [0, 0, 0], |"),
              ElementsAre("radius", "material", "movement"));
  EXPECT_THAT(labels("{\"wrong\": {|"), IsEmpty());
}

TEST(ConfigCompletion, OffersTheKeysOfTheMaterial) {
  const std::string start = "{\"spheres\": [{\"material\": {";
  EXPECT_THAT(labels(start + "|"), ElementsAre("type"));
  EXPECT_THAT(labels(start + "\"type\": \"transmissive\", |"),
              ElementsAre("color", "refraction_index"));
  EXPECT_THAT(labels(start + "\"type\": \"|"),
              ElementsAre("diffuse", "specular", "transmissive", "emissive", "no_texture"));
}

TEST(ConfigCompletion, OffersValues) {
  EXPECT_THAT(labels("{\"saving\": {\"gamma_correct\": |"), ElementsAre("true", "false"));
  EXPECT_THAT(labels("{\"saving\": {\"path\": |"), ElementsAre("picture.png"));
  EXPECT_THAT(labels("{\"spheres\": [{\"origin\": |"), ElementsAre("[0, 0, 0]"));
  EXPECT_THAT(labels("{\"spheres\": [{\"material\": sp|"), ElementsAre("specular"));
  EXPECT_THAT(labels("{\"spheres\": [|"), ElementsAre("sphere"));
  EXPECT_THAT(labels("|"), ElementsAre("config"));
}

TEST(ConfigCompletion, OffersNothingAfterAValueOrInComments) {
  EXPECT_THAT(labels("{\"rendering\": {\"width\": 12|"), IsEmpty());
  EXPECT_THAT(labels("{\"rendering\": {} |"), IsEmpty());
  EXPECT_THAT(labels("{\"rendering\" |"), IsEmpty());
  EXPECT_THAT(labels("{ // |"), IsEmpty());
  EXPECT_THAT(labels("{} |"), IsEmpty());
}

TEST(ConfigCompletion, ReplacesTheKeyWithItsQuotes) {
  const auto found = items("{\"cam|\": 1}").front();
  EXPECT_EQ(found.replaced, (lang::Span{1, 6}));
  EXPECT_EQ(found.text, "\"camera\"");
  EXPECT_EQ(found.filter, "\"camera\"");
  EXPECT_EQ(items("{cam|").front().text, "\"camera\": ");
  EXPECT_EQ(items("{\"camera\": {\"up|").front().snippet, "\"up\": [${1:0}, ${2:0}, ${3:0}]");
}

TEST(ConfigCompletion, AnswersAnywhereInAnyBeginningOfAText) {
  const std::string text =
      "\xEF\xBB\xBF{\"camera\": {\"up\": [0, 1, 0] /* é */, 'vfov': 4e1},\r\n\"spheres\": "
      "[{\"material\": "
      "{\"type\": \"diffuse\", \"color\": [1, 2, 3]}}, ], \"𝄞\": \"\\\"\" // end\r}";
  for (std::size_t end = 0; end <= text.size(); ++end) {
    for (std::uint32_t cursor = 0; cursor <= end + 1; cursor += 7) {
      const lang::SourceFile file("a.json", text.substr(0, end));
      for (const auto& item : lang::complete_config(file, cursor).items) {
        EXPECT_LE(item.replaced.end, end);
        EXPECT_FALSE(item.text.empty());
      }
      lang::hover_config(file, cursor);
    }
  }
}

TEST(ConfigCompletion, AcceptsAnyNesting) {
  EXPECT_THAT(labels(std::string(100'000, '[') + "|"), IsEmpty());
  EXPECT_THAT(labels("{\"camera\": " + std::string(100, '[') + std::string(100, ']') + ", |"),
              Contains("saving"));
}

TEST(ConfigHover, DescribesKeysAndTypes) {
  EXPECT_EQ(hover("{\"camera\": {\"|look_from\": 1}}"),
            "`look_from`: three numbers [x, y, z], required\n\nThe position of the camera.");
  EXPECT_THAT(hover("{\"spheres\": [{\"radius|\": 1}]}"), HasSubstr("at least 0"));
  EXPECT_THAT(hover("{\"spheres\": [{\"material\": {\"fu|zz\": 1, \"type\": \"specular\"}}]}"),
              HasSubstr("Blurs the mirror"));
  EXPECT_THAT(hover("{\"spheres\": [{\"material\": {\"type\": \"spec|ular\"}}]}"),
              HasSubstr("metals"));
  EXPECT_EQ(hover("{\"wro|ng\": 1}"), "");
  EXPECT_EQ(hover("{\"camera\": {\"up\": [0|, 1, 0]}}"), "");
}

}  // namespace
}  // namespace sdlc::test
