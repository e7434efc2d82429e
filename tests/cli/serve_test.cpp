#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/serve_choices.hpp"
#include "cli/serve_messages.hpp"
#include "cli/serve_outline.hpp"
#include "cli/serve_pages.hpp"
#include "cli/serve_picture.hpp"
#include "cli/serve_scene.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::cli {
namespace {

using test::write_text;
using testing::ElementsAre;
using testing::HasSubstr;

/// Compiles scenes of a folder.
class ServedScenes : public testing::Test {
 protected:
  std::unique_ptr<ServedScene> serve(const std::string& text, ServeChoices choices = {}) {
    write_text(folder_ / "a.scene", text);
    ServeOptions options;
    options.scene.file = (folder_ / "a.scene").string();
    Environment env{.workspace = workspace_, .out = out_, .err = out_};
    auto scene = serve_scene(
        options, choices, std::make_shared<lang::StopRequest>(),
        [](const auto&) { return nullptr; }, env);
    choices_ = choices;
    return scene;
  }

  const test::TemporaryFolder folder_;
  const lang::DiskFileSystem disk_;
  lang::Workspace workspace_{disk_};
  std::ostringstream out_;
  ServeChoices choices_;  // after the last serve()
};

const std::string kScene =
    "scene 1\n"
    "camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
    "render { width: 16, height: 8, samples: 1 }\n"
    "param count = 2 + 1\n"
    "/// In the sun.\n"
    "param tint: color = #ff8000\n"
    "param far = 3km\n"
    "param turn = 30deg\n"
    "param name = \"a b\"\n"
    "param place = (1, 2, 3)\n"
    "param is_on = true\n"
    "sphere { center: (0, 0, 0), radius: count, material: unlit(color: tint) }\n";

TEST_F(ServedScenes, HaveParamsWithTypesAndValues) {
  const auto scene = serve(kScene);
  ASSERT_TRUE(scene->prepared) << scene->failure;
  const auto texts = [&](const auto member) {
    std::vector<std::string> all;
    for (const ServedParam& param : scene->params) all.push_back(param.*member);
    return all;
  };
  EXPECT_THAT(texts(&ServedParam::name),
              ElementsAre("count", "tint", "far", "turn", "name", "place", "is_on"));
  EXPECT_THAT(texts(&ServedParam::type),
              ElementsAre("number", "color", "number", "angle", "string", "vec3", "bool"));
  EXPECT_THAT(texts(&ServedParam::default_value),
              ElementsAre("3", "#ff8000", "3km", "30deg", "a b", "(1, 2, 3)", "true"));
  EXPECT_EQ(scene->params[1].hex, "#ff8000");
  EXPECT_EQ(scene->params[1].documentation, "In the sun.");
}

TEST_F(ServedScenes, TakeChoicesAndDropThoseThatAreGone) {
  const auto scene = serve(kScene, {.params = {{"count", "5"}, {"gone", "1"}}, .frame = 3});
  ASSERT_TRUE(scene->prepared) << scene->failure;
  EXPECT_EQ(scene->lowered.scene.spheres.at(0).radius, 5);
  EXPECT_THAT(choices_.params, ElementsAre(std::pair("count", "5")));
  EXPECT_FALSE(choices_.frame) << "there is no animation";
}

TEST(ServeChoices, AddUp) {
  Json all = Json::object();
  const auto add = [&](const char* message) { add_choices(Json::parse(message), all); };
  add(R"({"type": "choose", "params": {"a": "1", "b": "2"}, "frame": 3})");
  add(R"({"pose": {"from": [1, 2, 3], "at": [0, 0, 0]}})");
  add(R"({"params": {"a": null, "c": "4"}})");
  const ServeChoices before{.params = {{"a", "0"}, {"d", "5"}}, .camera = "main"};
  ServeChoices after = choose(before, all);
  EXPECT_THAT(after.params,
              ElementsAre(std::pair("b", "2"), std::pair("c", "4"), std::pair("d", "5")));
  EXPECT_EQ(after.camera, "main");
  EXPECT_EQ(after.frame, 3);
  EXPECT_EQ(after.pose->from.y, 2);
  add(R"({"camera": null})");
  after = choose(after, all);
  EXPECT_FALSE(after.camera);
  EXPECT_FALSE(after.pose) << "of the camera before";
  EXPECT_THROW(choose({}, Json::parse(R"({"params": {"a": 1}})")), Json::exception);
  EXPECT_THROW(choose({}, Json::parse(R"({"pose": {"from": [1, 2]}})")), Json::exception);
}

TEST_F(ServedScenes, SayWhatIsWrong) {
  const auto broken = serve(kScene + "let a = cuont\nassert a > 0, \"\"\n");
  EXPECT_FALSE(broken->prepared);
  EXPECT_EQ(broken->errors, 1);
  ASSERT_EQ(broken->findings.size(), 1);
  EXPECT_THAT(broken->findings[0].text, HasSubstr("did you mean `count`"));
  const auto wrong_value = serve(kScene, {.params = {{"count", "red"}}});
  EXPECT_FALSE(wrong_value->prepared);
  EXPECT_GE(wrong_value->errors, 1);
  const auto nowhere = serve(kScene, {.pose = lang::CameraPose{{0, 0, 1}, {0, 0, 1}}});
  EXPECT_THAT(nowhere->findings.at(0).text, HasSubstr("error[E207]")) << "no direction";
  EXPECT_EQ(nowhere->findings[0].code, "E207");
  EXPECT_THAT(nowhere->findings[0].text, HasSubstr(nowhere->findings[0].message));
  std::filesystem::remove(folder_ / "a.scene");
  ServeOptions missing;
  missing.scene.file = (folder_ / "a.scene").string();
  Environment env{.workspace = workspace_, .out = out_, .err = out_};
  EXPECT_THAT(serve_scene(
                  missing, choices_, std::make_shared<lang::StopRequest>(),
                  [](const auto&) { return nullptr; }, env)
                  ->failure,
              HasSubstr("cannot read"));
}

TEST_F(ServedScenes, WriteTheirCameraWithItsPose) {
  const lang::CameraPose pose{{1, 2, 3.5}, {0, -1, 0}};
  const std::string text =
      "scene 1\n"
      "camera a { from: (0, 0, 1), at: (0, 0, 0), fov: 1deg }\n"
      "camera b {\n"
      "  at: (0, 0, 0)  // the middle\n"
      "  from: (0, 1, 2) * 2\n"
      "  fov: 40deg, aperture: 1mm, focus: 2\n"
      "}\n"
      "render { width: 9, samples: 1, camera: b }\n";
  EXPECT_EQ(camera_text(*serve(text, {.pose = pose})),
            "camera b {\n"
            "  at: (0, -1, 0)  // the middle\n"
            "  from: (1, 2, 3.5)\n"
            "  fov: 40deg, aperture: 1mm, focus: 2\n"
            "}\n");
}

TEST_F(ServedScenes, OutlineTheSpheresOfTheStatementAtTheCursor) {
  const auto scene = serve(
      "scene 1\n"
      "camera { from: (0, 0, 100), at: (0, 0, 0), fov: 10deg, aspect: 2 }\n"
      "render { width: 40, samples: 1 }\n"
      "def pair() {\n"
      "  sphere { center: (-6, 0, 0), radius: 2 }\n"
      "  sphere { center: (6, 0, 0), radius: 2 }\n"
      "}\n"
      "pair { material: unlit(color: red) }\n");
  ASSERT_TRUE(scene->prepared);
  const auto columns = [&](lang::Position position) {
    std::pair<int, int> ends{99, -1};
    for (const PixelRow& row : outline_at(*scene, {folder_ / "a.scene", position}).rows) {
      ends = {std::min(ends.first, row.x), std::max(ends.second, row.x + row.width)};
    }
    return ends;
  };
  // A metre is about a pixel.
  EXPECT_LT(columns({5, 8}).second, 20) << "the left one";
  EXPECT_GT(columns({6, 8}).first, 20) << "the right one";
  EXPECT_LT(columns({8, 3}).first, 20) << "both";
  EXPECT_GT(columns({8, 3}).second, 20);
  EXPECT_EQ(columns({2, 3}), std::pair(99, -1)) << "a camera is not seen";
  EXPECT_EQ(columns({99, 99}), std::pair(99, -1));
}

TEST_F(ServedScenes, OutlineTheSpheresOfAConfig) {
  write_text(
      folder_ / "row.json",
      R"({"camera": {"look_from": [0, 0, 9], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov": 40,
  "focal_length": 9, "aspect_ratio": 2, "viewport_height": 2, "samples_per_pixel": 1},
 "rendering": {"width": 40, "render_depth": 2}, "saving": {"path": "row.png"},
 "spheres": [
  {"origin": [-3, 0, 0], "radius": 1, "material": {"type": "diffuse", "color": [255, 0, 0]}},
  {"origin": [3, 0, 0], "radius": 1, "material": {"type": "diffuse", "color": [255, 0, 0]}}
 ]})");
  const auto scene = serve(
      "scene 1\n"
      "include \"row.json\"\n"
      "camera { from: (0, 0, 100), at: (0, 0, 0), fov: 5deg, aspect: 2 }\n"
      "render { width: 40, samples: 1 }\n");
  ASSERT_TRUE(scene->prepared) << scene->failure;
  const auto rows = [&](const char* file, lang::Position position) {
    return outline_at(*scene, {folder_ / file, position}).rows;
  };
  for (const std::uint32_t column : {3U, 5U, 30U, 60U}) {
    ASSERT_FALSE(rows("row.json", {5, column}).empty()) << column;
    EXPECT_LT(rows("row.json", {5, column}).front().x, 20) << "the left one";
    ASSERT_FALSE(rows("row.json", {6, column}).empty()) << column;
    EXPECT_GT(rows("row.json", {6, column}).front().x, 20) << "the right one";
  }
  EXPECT_THAT(rows("row.json", {2, 5}), testing::IsEmpty()) << "a camera is not seen";
  EXPECT_THAT(rows("other.json", {5, 5}), testing::IsEmpty());
}

TEST(CommandOfServe, RendersWhatItShows) {
  const auto command = [](const std::vector<std::string>& arguments, const ServeChoices& choices) {
    return render_command(arguments, choices);
  };
  EXPECT_EQ(command({"serve", "--port", "80", "a b.scene", "--editor"}, {}),
            "sdlc render 'a b.scene'");
  EXPECT_EQ(command({"serve", "a.scene", "--port=80", "--set", "n=1", "--set=m=2", "--width", "9"},
                    {.params = {{"n", "3m"}, {"text", "it's"}}}),
            "sdlc render a.scene --set=m=2 --width 9 --set n=3m --set 'text=it'\\''s'");
  EXPECT_EQ(command({"serve", "--camera", "a", "a.scene"}, {.camera = "b", .frame = 7}),
            "sdlc render a.scene --camera b --frames=7");
}

ServedPicture picture_of_two_pixels() {
  ServedPicture picture;
  picture.settings.width = 2;
  picture.settings.height = 1;
  picture.result.picture = render::Picture(2, 1);
  picture.result.picture.pixels = {render::LinearRgb{1, 0, 0}, render::LinearRgb{0.25}};
  picture.result.min_samples = picture.result.max_samples = 8;
  return picture;
}

TEST(ServedPicture, ShowsItsChannels) {
  ServedPicture picture = picture_of_two_pixels();
  EXPECT_THAT(codes_of(picture, ServedChannel::Color, 0), ElementsAre(255, 0, 0, 137, 137, 137));
  EXPECT_THAT(codes_of(picture, ServedChannel::Color, 2), ElementsAre(255, 0, 0, 255, 255, 255));
  EXPECT_THAT(codes_of(picture, ServedChannel::Samples, 9), testing::Each(255));
  EXPECT_FALSE(has_channel(picture, ServedChannel::Depth));
  EXPECT_THAT(codes_of(picture, ServedChannel::Depth, 0), testing::Each(0));
  picture.result.features = {
      {.normal = {0, 0, 1}, .depth = 5, .albedo = render::LinearRgb{1}},
      {.normal = {}, .depth = render::kNoDepth, .albedo = render::LinearRgb{}}};
  EXPECT_THAT(codes_of(picture, ServedChannel::Depth, 0), ElementsAre(255, 255, 255, 0, 0, 0));
  EXPECT_THAT(codes_of(picture, ServedChannel::Normal, 0),
              ElementsAre(128, 128, 255, 128, 128, 128));
  EXPECT_THAT(codes_of(picture, ServedChannel::Albedo, 0), ElementsAre(255, 255, 255, 0, 0, 0));
}

TEST(ServedPicture, IsAMessageOfAHeaderAndCodes) {
  const std::string message =
      picture_message(picture_of_two_pixels(), {.channel = ServedChannel::Color, .exposure = 0});
  const auto size = static_cast<std::size_t>(static_cast<unsigned char>(message[0]) +
                                             256 * static_cast<unsigned char>(message[1]));
  const Json header = Json::parse(message.substr(4, size));
  EXPECT_EQ(header.at("full_width"), 2);
  EXPECT_EQ(header.at("error"), nullptr);
  EXPECT_EQ(message.size(), 4 + size + 6);
}

TEST(ServedPicture, TellsTheValuesOfPixels) {
  const ServedPicture picture = picture_of_two_pixels();
  const Json json = pixel_json(picture, 0, 0);
  EXPECT_EQ(json.at("radiance"), Json::array({1.0, 0.0, 0.0}));
  EXPECT_EQ(json.at("samples"), 8);
  EXPECT_FALSE(json.contains("depth"));
  for (const auto& [x, y] : {std::pair(2, 0), {0, 1}, {-1, 0}, {0, -1}}) {
    EXPECT_FALSE(pixel_json(picture, x, y).contains("radiance"));
  }
}

TEST(ServePages, TellAPageThatIsOpenedLaterWhatTheOthersKnow) {
  std::map<ServePages::Viewer, std::vector<std::string>> sent;
  ServePages pages([&](ServePages::Viewer viewer, const std::string& message,
                       WebServer::MessageType) { sent[viewer].push_back(message); });
  pages.open(1);
  pages.show_scene("scene 1");
  pages.show_progress("progress 1");
  pages.show_outline("outline 1");
  pages.show_progress("progress 2");
  pages.open(2);
  EXPECT_THAT(sent[1], ElementsAre("scene 1", "progress 1", "outline 1", "progress 2"));
  EXPECT_THAT(sent[2], ElementsAre("scene 1", "progress 2", "outline 1"));
}

}  // namespace
}  // namespace sdlc::cli
