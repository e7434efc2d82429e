#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/json.hpp"
#include "lang/report/report.hpp"

namespace sdlc::lang {
namespace {

using testing::ElementsAre;

/// Stores what it receives.
class Objects final : public ObjectSink {
 public:
  void add(const Object& object) override { all.push_back(object); }

  std::vector<ObjectKind> kinds() const {
    std::vector<ObjectKind> kinds;
    for (const Object& object : all) kinds.push_back(object.kind->id);
    return kinds;
  }
  const Object& only(ObjectKind kind) const {
    const Object* found = nullptr;
    for (const Object& object : all) {
      if (object.kind->id != kind) continue;
      if (found != nullptr) throw std::runtime_error("several objects of the kind");
      found = &object;
    }
    if (found == nullptr) throw std::runtime_error("no object of the kind");
    return *found;
  }

  std::vector<Object> all;
};

/// A config read, with the text that its spans are of.
struct Reading {
  explicit Reading(std::string text) : file("config.json", std::move(text)) {
    read_config(file, objects, sink);
  }
  std::string messages() const {
    return render_diagnostics(sink, {.format = MessageFormat::Concise});
  }
  std::string_view text(const Object& object, std::size_t property) const {
    return file.text(object.slots[property].span);
  }

  SourceFile file;
  Objects objects;
  DiagnosticSink sink;
};

constexpr const char* kCamera =
    R"("camera": {"look_from": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 1, 0], "vfov": 40,
       "focal_length": 1, "aspect_ratio": 1.5, "viewport_height": 3, "samples_per_pixel": 64,
       "time_interval": [2, 1]}, )";
constexpr const char* kRest =
    R"("rendering": {"width": 600, "render_depth": 8}, "saving": {"path": "a\u00e9.png"})";

std::string sphere(std::string_view material) {
  return R"({"origin": [1, -2, 3e1], "radius": 0.5, "material": )" + std::string(material) + "}";
}

std::string config(std::string_view spheres) {
  return std::string("{") + kCamera + kRest + R"(, "spheres": [)" + std::string(spheres) + "]}";
}

MaterialValue material_of(std::string_view json) {
  const Reading reading(config(sphere(json)));
  EXPECT_EQ(reading.messages(), "");
  return *reading.objects.only(ObjectKind::Sphere).get<MaterialValue>(sphere_property::kMaterial);
}

TEST(ReadConfig, HandsSpheresOnFirstAndTheRestAtTheEnd) {
  const std::string plain = sphere(R"({"type": "diffuse", "color": [0, 0, 0]})");
  const std::string spheres = std::string(R"("spheres": [)") + plain + "," + plain + "], ";
  const Reading reading(std::string("{") + spheres + kCamera + kRest +
                        R"(, "background": [51, 0, 0]})");
  EXPECT_EQ(reading.messages(), "");
  EXPECT_THAT(reading.objects.kinds(),
              ElementsAre(ObjectKind::Sphere, ObjectKind::Sphere, ObjectKind::Camera,
                          ObjectKind::Background, ObjectKind::Render));
  const Object& background = reading.objects.only(ObjectKind::Background);
  EXPECT_EQ(background.get<render::LinearRgb>(background_property::kColor),
            render::LinearRgb(0.2, 0, 0));
}

TEST(ReadConfig, HandsOnNoBackgroundThatIsNotThere) {
  const Reading reading(config(""));
  EXPECT_THAT(reading.objects.kinds(), ElementsAre(ObjectKind::Camera, ObjectKind::Render));
}

TEST(ReadConfig, ReadsASphereWithItsPlaces) {
  const Reading reading(config(
      R"({"origin": [1, -2, 3e1], "movement": [[1, 2, 3], 5, -5], "radius": 0.5, "material": {"type": "no_texture", "color": [0, 0, 0]}})"));
  EXPECT_EQ(reading.messages(), "");
  using namespace sphere_property;
  const Object& sphere = reading.objects.only(ObjectKind::Sphere);
  EXPECT_EQ(sphere.get<render::Vec3>(kCenter), (render::Vec3{1, -2, 30}));
  EXPECT_EQ(sphere.get<double>(kRadius), 0.5);
  EXPECT_EQ(sphere.get<MotionValue>(kMotion), (MotionValue{.to = {1, 2, 3}, .over = {5, -5}}));
  EXPECT_EQ(reading.text(sphere, kCenter), "[1, -2, 3e1]");
  EXPECT_EQ(reading.text(sphere, kRadius), "0.5");
  EXPECT_EQ(reading.text(sphere, kMaterial), R"({"type": "no_texture", "color": [0, 0, 0]})");
  EXPECT_EQ(reading.file.text(sphere.where.span), "{");
}

TEST(ReadConfig, LeavesNothingOfASphereToTheNext) {
  const std::string plain = sphere(R"({"type": "diffuse", "color": [0, 0, 0]})");
  std::string moving = plain;
  moving.insert(1, R"("movement": [[1, 2, 3], 0, 1], )");
  const Reading reading(config(moving + "," + plain));
  ASSERT_EQ(reading.messages(), "");
  EXPECT_TRUE(reading.objects.all[0].slot(sphere_property::kMotion).is_written);
  EXPECT_FALSE(reading.objects.all[1].slot(sphere_property::kMotion).is_written);
}

TEST(ReadConfig, ReadsEveryMaterial) {
  const render::LinearRgb color{1, 0.2, 1000 / 255.0};
  EXPECT_EQ(material_of(R"({"type": "diffuse", "color": [255, 51, 1000]})"),
            (MaterialValue{MaterialKind::Diffuse, color, 0, false}));
  EXPECT_EQ(material_of(R"({"type": "specular", "color": [255, 51, 1000], "fuzz": 0.25})"),
            (MaterialValue{MaterialKind::Specular, color, 0.25, false}));
  EXPECT_EQ(
      material_of(R"({"refraction_index": 1.5, "color": [255, 51, 1000], "type": "transmissive"})"),
      (MaterialValue{MaterialKind::Transmissive, color, 1.5, false}));
  EXPECT_EQ(material_of(R"({"type": "emissive", "color": [255, 51, 1000], "intensity": 8})"),
            (MaterialValue{MaterialKind::Emissive, color, 8, false}));
  EXPECT_EQ(material_of(R"({"type": "no_texture", "color": [255, 51, 1000]})"),
            (MaterialValue{MaterialKind::Unlit, color, 0, false}));
}

TEST(ReadConfig, ReadsTheCamera) {
  const Reading reading(config(""));
  using namespace camera_property;
  const Object& camera = reading.objects.only(ObjectKind::Camera);
  EXPECT_EQ(camera.get<render::Vec3>(kFrom), (render::Vec3{1, 2, 3}));
  EXPECT_EQ(camera.get<render::Vec3>(kAt), (render::Vec3{4, 5, 6}));
  EXPECT_EQ(camera.get<render::Vec3>(kUp), (render::Vec3{0, 1, 0}));
  EXPECT_EQ(camera.get<Angle>(kFov), Angle{40});
  EXPECT_EQ(camera.get<double>(kAspect), 1.5);
  EXPECT_EQ(camera.get<double>(kViewHeight), 3);
  EXPECT_EQ(camera.get<render::Interval>(kShutter), (render::Interval{1, 2}));
  EXPECT_EQ(reading.file.text(camera.where.span), "camera");
}

Object settings(const std::string& rendering, const std::string& saving) {
  const Reading reading(std::string("{") + kCamera +
                        R"("rendering": {"width": 600, "render_depth": 8)" + rendering +
                        R"(}, "saving": {)" + saving + "}}");
  EXPECT_EQ(reading.messages(), "");
  return reading.objects.only(ObjectKind::Render);
}

TEST(ReadConfig, GathersTheRenderSettings) {
  using namespace render_property;
  const Object render = settings("", R"("path": "a\u00e9\n.png")");
  EXPECT_EQ(render.get<double>(kWidth), 600);
  EXPECT_EQ(render.get<double>(kSamples), 64);
  EXPECT_EQ(render.get<double>(kDepth), 8);
  EXPECT_EQ(render.get<std::string>(kOutput), "aé\n.png");
  EXPECT_FALSE(render.slot(kHeight).is_written);
  EXPECT_FALSE(render.slot(kSeed).is_written);
}

TEST(ReadConfig, GammaCorrectIsTheSquareRoot) {
  using render_property::kTone;
  EXPECT_EQ(settings("", R"("gamma_correct": true)").get<Word>(kTone), Word{"sqrt"});
  EXPECT_EQ(settings("", R"("gamma_correct": false)").get<Word>(kTone), Word{"linear"});
  EXPECT_EQ(settings("", R"("gamma_correct": null)").get<Word>(kTone), Word{"linear"});
  EXPECT_EQ(settings("", "").get<Word>(kTone), Word{"linear"});
}

TEST(ReadConfig, ThreadsComeFromTwoKeys) {
  using render_property::kThreads;
  EXPECT_EQ(settings("", "").get<double>(kThreads), 0);
  EXPECT_EQ(settings(R"(, "number_cores": 3)", "").get<double>(kThreads), 3);
  EXPECT_EQ(settings(R"(, "in_parallel": true, "number_cores": 3)", "").get<double>(kThreads), 3);
  EXPECT_EQ(settings(R"(, "in_parallel": false, "number_cores": 3)", "").get<double>(kThreads), 1);
}

TEST(ReadConfig, APlainPictureIsASizeAndABackground) {
  const Reading reading(
      R"({"image": {"width": 8, "height": 4, "color": [255, 0, 51]}, "saving": {"gamma_correct": true}})");
  EXPECT_EQ(reading.messages(), "");
  EXPECT_THAT(reading.objects.kinds(), ElementsAre(ObjectKind::Background, ObjectKind::Render));
  const Object& render = reading.objects.only(ObjectKind::Render);
  EXPECT_EQ(render.get<double>(render_property::kWidth), 8);
  EXPECT_EQ(render.get<double>(render_property::kHeight), 4);
  EXPECT_EQ(render.get<Word>(render_property::kTone), Word{"sqrt"});
}

TEST(ReadConfig, ASphereWithAMistakeIsNotHandedOn) {
  const std::string good = sphere(R"({"type": "diffuse", "color": [0, 0, 0]})");
  const std::string bad = sphere(R"({"type": "diffuse", "color": [0, 0, -1]})");
  const Reading reading(config(good + "," + bad + "," + good));
  EXPECT_EQ(reading.sink.error_count(), 1u);
  EXPECT_THAT(reading.objects.kinds(), ElementsAre(ObjectKind::Sphere, ObjectKind::Sphere,
                                                   ObjectKind::Camera, ObjectKind::Render));
}

TEST(ReadConfig, AWrongSettingIsWrittenWithoutAValue) {
  std::string text = config("");
  text.replace(text.find("600"), 3, "0.5");
  const Reading reading(text);
  const Slot& width = reading.objects.only(ObjectKind::Render).slot(render_property::kWidth);
  EXPECT_TRUE(width.is_written);
  EXPECT_TRUE(is_nothing(width.value));
}

TEST(ReadConfig, ASphereIsHandedOnAsSoonAsItIsClosed) {
  const std::string text = config(sphere(R"({"type": "diffuse", "color": [0, 0, 0]})"));
  const Reading reading(text.substr(0, text.size() - 2) + "/* never closed");
  EXPECT_EQ(reading.sink.error_count(), 1u);
  EXPECT_THAT(reading.objects.kinds(), ElementsAre(ObjectKind::Sphere));
}

}  // namespace
}  // namespace sdlc::lang
