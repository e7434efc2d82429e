#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRing = R"(scene 1
import "library/materials.scene" as mat
param count = 8
def ring(n: number) {
  for i in range(n) {
    sphere bead { center: (2 * cos(i / n * 1turn), time / 1s, 2 * sin(i / n * 1turn)), radius: 0.25 }
  }
}
camera main { from: (0, 0, 10), at: (0, 0, 0), fov: 40deg, shutter: 0 .. 0.5s }
camera top { from: (0, 20, 0), at: (0, 0, 0), up: (0, 0, 1), fov: 30deg }
sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: white) }
sphere twin { center: (0, 0, 0), radius: 1, material: unlit(color: white) }
ring beads { n: count, material: mat.brushed, translate: (0, 0.5, 0) }
group { include "library/lamp.scene" }
background { color: black }
render { width: 320, samples: 4, depth: 6, seed: 9, tone: sqrt, camera: main, output: "out/ring.####.png" }
animation { frames: 1 .. 9, step: 2, fps: 4 }
)";

constexpr const char* kMaterials = R"(scene 1
let brushed = specular(color: white, fuzz: 0.1)
)";

constexpr const char* kLamp = R"(scene 1
sphere lamp { center: (0, 5, 0), radius: 0.5, material: emissive(color: white) }
)";

constexpr const char* kConfig = R"({
  "background": [0, 0, 0],
  "camera": {"look_from": [0, 0, 0], "look_at": [0, 0, -1], "up": [0, 1, 0], "vfov": 90, "focal_length": 1,
             "aspect_ratio": 1.6, "viewport_height": 3, "samples_per_pixel": 4, "time_interval": [0, 2]},
  "rendering": {"width": 640, "render_depth": 3},
  "saving": {"path": "results/picture.ppm", "gamma_correct": true},
  "spheres": [{"origin": [0, 0, -3], "radius": 1, "material": {"type": "no_texture", "color": [51, 102, 255]},
               "movement": [[0, 1, -3], 0, 1]}]
})";

/// A folder with ring.scene and its files, and config.json.
class InspectCommand : public testing::Test {
 protected:
  InspectCommand() {
    std::filesystem::create_directory(folder_ / "library");
    write_text(folder_ / "ring.scene", kRing);
    write_text(folder_ / "library/materials.scene", kMaterials);
    write_text(folder_ / "library/lamp.scene", kLamp);
    write_text(folder_ / "config.json", kConfig);
  }

  ProgramResult run(const std::string& arguments) {
    return run_shell(folder_.path(), "\"$SDLC\" inspect " + arguments);
  }

  /// The output of `--format json`.
  json inspect(const std::string& arguments) {
    const ProgramResult result = run(arguments + " --format json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out);
  }

  TemporaryFolder folder_;
};

TEST_F(InspectCommand, CountsTheSpheresThatAreLeft) {
  const json spheres = inspect("ring.scene")["spheres"];
  EXPECT_EQ(spheres["count"], 10);
  EXPECT_EQ(spheres["moving"], 8);
  EXPECT_EQ(spheres["dropped"], 1);
  EXPECT_EQ(spheres["smallest"], (json{{"radius", 0.25}, {"sphere", 1}}));
  EXPECT_EQ(spheres["largest"], (json{{"radius", 1}, {"sphere", 0}}));
  EXPECT_EQ(spheres["radius_ratio"], 4);
  EXPECT_EQ(spheres["bounds"]["max"][1], 5.5);
  EXPECT_EQ(spheres["scale_ratio"], spheres["extent"].get<double>() / 0.25);
}

TEST_F(InspectCommand, CountsMaterialsInUse) {
  const json materials = inspect("ring.scene")["materials"];
  EXPECT_EQ(materials["distinct"], 3);
  EXPECT_EQ(materials["types"]["specular"], (json{{"spheres", 8}, {"distinct", 1}}));
  EXPECT_EQ(materials["types"]["unlit"], (json{{"spheres", 0}, {"distinct", 0}}))
      << "its sphere was dropped";
}

TEST_F(InspectCommand, ShowsTheChosenCamera) {
  const json report = inspect("ring.scene");
  EXPECT_EQ(report["cameras"], (json{"main", "top"}));
  EXPECT_EQ(report["camera"]["name"], "main");
  EXPECT_EQ(report["camera"]["from"], (json{0, 0, 10}));
  EXPECT_EQ(report["camera"]["fov_degrees"], 40);
  EXPECT_EQ(report["camera"]["shutter"], (json{{"open_seconds", 0.25}, {"close_seconds", 0.75}}));
  const json top = inspect("ring.scene --camera top");
  EXPECT_EQ(top["camera"]["name"], "top");
  EXPECT_EQ(top["camera"]["up"], (json{0, 0, 1}));
  EXPECT_TRUE(top["camera"]["shutter"].is_null());
  EXPECT_EQ(top["spheres"]["moving"], 0);
}

TEST_F(InspectCommand, ShowsTheSettingsOfThePicture) {
  const json report = inspect("ring.scene --width 100 --samples 2");
  EXPECT_EQ(report["picture"], (json{{"width", 100},
                                     {"height", 56},
                                     {"samples", 2},
                                     {"depth", 6},
                                     {"seed", 9},
                                     {"sampler", "sobol"},
                                     {"light_sampling", "auto"},
                                     {"error", nullptr},
                                     {"seconds", nullptr},
                                     {"adaptive", false},
                                     {"denoised", false},
                                     {"sampled_lights", 1},
                                     {"threads", 0},
                                     {"tone", "sqrt"},
                                     {"exposure", 0},
                                     {"output", "out/ring.0001.png"}}));
  EXPECT_EQ(report["background"]["kind"], "color");
  EXPECT_EQ(report["memory"]["picture_bytes"], 100 * 56 * 24);
}

TEST_F(InspectCommand, ShowsTheGoalsOfTheFlags) {
  const json goals = inspect(
      "ring.scene --error 3% --time 2min --adaptive --sampler independent --light-sampling "
      "on")["picture"];
  EXPECT_EQ(goals["error"], 0.03);
  EXPECT_EQ(goals["seconds"], 120);
  EXPECT_EQ(goals["adaptive"], true);
  EXPECT_EQ(goals["samples"], 1 << 24);
  EXPECT_EQ(goals["sampler"], "independent");
  EXPECT_EQ(goals["light_sampling"], "on");
  EXPECT_EQ(goals["sampled_lights"], 1);
  EXPECT_EQ(inspect("ring.scene --error 3% --samples 50")["picture"]["samples"], 50);
  const ProgramResult result = run("ring.scene --adaptive");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--adaptive needs a requested error"));
}

TEST_F(InspectCommand, LaysOutGoalsForPeople) {
  const auto text = [&](const std::string& flags) { return run("ring.scene " + flags).out; };
  EXPECT_THAT(text(""),
              HasSubstr("  sampling      sobol, light sampling auto (on, 1 light)\n  output"));
  EXPECT_THAT(text("--error 7% --samples 100"),
              AllOf(HasSubstr("pixels, at most 100 samples, depth"),
                    HasSubstr("  until         an error of 7%\n")));
  EXPECT_THAT(text("--error 7% --time 90s --adaptive"),
              HasSubstr("  until         an error of 7% or 1 min 30 s, whichever comes first, more "
                        "samples where there is more noise\n"));
}

TEST_F(InspectCommand, ShowsTheFirstFrameOrTheOneAskedFor) {
  const json first = inspect("ring.scene");
  EXPECT_EQ(first["animation"],
            (json{{"first", 1}, {"last", 9}, {"step", 2}, {"count", 5}, {"fps", 4}}));
  EXPECT_EQ(first["frame"], 1);
  EXPECT_EQ(first["time_seconds"], 0.25);
  const json later = inspect("ring.scene --frame 6");
  EXPECT_EQ(later["frame"], 6);
  EXPECT_EQ(later["time_seconds"], 1.5);
  EXPECT_EQ(later["camera"]["shutter"]["open_seconds"], 1.5);
  EXPECT_EQ(later["picture"]["output"], "out/ring.0006.png");
}

TEST_F(InspectCommand, RefusesAFrameOfASceneThatHasNone) {
  const ProgramResult result = run("config.json --frame 3");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("no `animation`"));
  EXPECT_EQ(run("ring.scene --frame -1").exit_code, 2);
}

TEST_F(InspectCommand, ReadsConfigs) {
  const json report = inspect("config.json");
  EXPECT_EQ(report["dependencies"], json::array());
  EXPECT_TRUE(report["animation"].is_null());
  EXPECT_TRUE(report["frame"].is_null());
  EXPECT_EQ(report["cameras"], (json{nullptr}));
  EXPECT_EQ(report["camera"]["view_height"], 3);
  EXPECT_EQ(report["camera"]["shutter"]["close_seconds"], 2);
  EXPECT_EQ(report["spheres"]["bounds"]["max"], (json{1, 3, -2}));
  EXPECT_EQ(report["features"], (json{"motion", "unlit"}));
  EXPECT_EQ(report["picture"]["output"], "results/picture.ppm");
}

TEST_F(InspectCommand, ShowsTheFieldsOfAPlainPicture) {
  write_text(folder_ / "plain.scene",
             "scene 1\nbackground { color: white }\nrender { width: 8, height: 4 }\n");
  const json report = inspect("plain.scene");
  EXPECT_TRUE(report["camera"].is_null());
  EXPECT_EQ(report["spheres"]["count"], 0);
  EXPECT_TRUE(report["spheres"]["bounds"].is_null());
  EXPECT_TRUE(report["memory"]["bytes_per_sphere"].is_null());
  EXPECT_EQ(report["picture"]["output"], "plain.png");
  EXPECT_THAT(run("plain.scene").out, HasSubstr("none: a plain picture"));
}

TEST_F(InspectCommand, ShowsWhatRenderWillDo) {
  const json report = inspect("ring.scene --width 32 --set count=2000");
  const ProgramResult rendered =
      run_shell(folder_.path(),
                "\"$SDLC\" render ring.scene --width 32 --set count=2000 --frames 1 "
                "-o r.####.png --quiet --stats -");
  const json stats = json::parse(rendered.out);
  EXPECT_EQ(report["spheres"]["count"], stats["spheres"]);
  for (const char* field : {"scene", "features", "precision", "kernel", "instruction_set"}) {
    EXPECT_EQ(report[field], stats[field]) << field;
  }
  for (const char* field : {"width", "height", "samples", "depth", "seed"}) {
    EXPECT_EQ(report["picture"][field], stats[field]) << field;
  }
  const double estimated = report["memory"]["bvh_bytes_estimated"];
  const double built = stats["bvh_bytes"];
  EXPECT_GT(estimated, built / 2);
  EXPECT_LT(estimated, built * 2);
}

TEST_F(InspectCommand, LaysOutAReportForPeople) {
  const ProgramResult result = run("ring.scene");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("W401"));
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("scene           ring.scene, which reads 2 other files\n"),
            HasSubstr("animation       5 frames: 1 .. 9 in steps of 2, 4 per second\n"
                      "  shown         frame 1, at 0.25 s\n"),
            HasSubstr("spheres         10, 8 of them moving; 1 more dropped as a duplicate\n"),
            HasSubstr("  radii         0.25 (sphere 1) to 1 (sphere 0), ratio 4\n"),
            HasSubstr("  diffuse       1 sphere   1 distinct\n"
                      "  specular      8 spheres  1 distinct\n"),
            HasSubstr("camera          main, chosen of main, top\n")));
  EXPECT_THAT(
      result.out,
      AllOf(HasSubstr("  shutter       open from 0.25 s to 0.75 s\n"),
            HasSubstr("background      linear(0, 0, 0)\n"),
            HasSubstr("picture         320 x 180 pixels, 4 samples, depth 6, seed 9, tone sqrt\n"),
            HasSubstr("requires        motion, diffuse, specular, emissive\n"),
            HasSubstr("  kernel        float precision, wide, for "),
            HasSubstr("  picture       1.32 MiB\n"), HasSubstr(" to parse, ")));
}

constexpr const char* kGarden = R"(scene 1
camera main { from: (0, 2, 9), at: (0, 0, 0), fov: 40deg, shutter: 0 .. 1 }
def flower(petals) {
  for i in range(petals) {
    sphere { center: (cos(i / petals * 1turn), 0, sin(i / petals * 1turn)), radius: 0.2,
             material: diffuse(color: tan) }
  }
  sphere { center: (0, 0, 0), radius: 0.5 }
}
for i in range(10) {
  flower { petals: 7, translate: (3 * i, time * 1m / 1s * mod(i, 2), 0), material: unlit(color: white), scale: 1 + i }
}
)";

TEST_F(InspectCommand, CountsSpheresOfInstances) {
  write_text(folder_ / "garden.scene", kGarden);
  const json plain = inspect("garden.scene"),
             held_once = inspect("garden.scene --instances always");
  EXPECT_EQ(plain["spheres"]["instances"], 0);
  EXPECT_EQ(held_once["spheres"]["instances"], 9);
  EXPECT_EQ(held_once["spheres"]["prototypes"], 1);
  EXPECT_EQ(held_once["spheres"]["largest"], (json{{"radius", 5}, {"sphere", nullptr}}));
  for (const char* field : {"count", "moving", "radius_ratio"}) {
    EXPECT_EQ(held_once["spheres"][field], plain["spheres"][field]) << field;
  }
  EXPECT_EQ(held_once["materials"], plain["materials"]);
  EXPECT_EQ(held_once["kernel"], "bvh");
  EXPECT_THAT(run("garden.scene --instances always").out,
              AllOf(HasSubstr("spheres         80, 40 of them moving\n"
                              "  instances     9 of 1 prototype, and 8 plain spheres\n"),
                    HasSubstr("0.2 (sphere 0) to 5 (of an instance)")));
  const ProgramResult refused = run("garden.scene --instances always --kernel wide");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--instances never"));
  EXPECT_THAT(run("garden.scene --instances always --where 8").err,
              HasSubstr("they are 0 to 7; spheres of instances have no numbers"));
}

TEST_F(InspectCommand, ShowsTheRequestedKernel) {
  EXPECT_EQ(inspect("ring.scene --kernel scalar")["kernel"], "scalar");
  const ProgramResult refused = run("ring.scene --kernel scalar --precision float");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("--precision: the scalar kernel computes in double"));
}

constexpr const char* kPlanet = R"(scene 1
camera main { from: (0, 2, 9), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 1, 0), radius: 1, material: diffuse(color: tan) }
for r in [1000] { sphere { center: (0, -r, 0), radius: r, material: diffuse(color: gray) } }
)";

TEST_F(InspectCommand, ShowsTheBoundsOfEachPrecisionAndTheDecidingSpheres) {
  write_text(folder_ / "planet.scene", kPlanet);
  EXPECT_THAT(run("planet.scene").out,
              AllOf(HasSubstr("  kernel        mixed precision, wide, for "),
                    HasSubstr("  float         refused: so near a surface is off by "),
                    HasSubstr("where 0.0625 is allowed (sphere 1 at planet.scene:4:19)\n"),
                    HasSubstr("  mixed         accepted, 1 sphere met in double: "),
                    HasSubstr("  double        accepted: ")));
  const json bounds = inspect("planet.scene")["precision_bounds"];
  EXPECT_EQ(bounds["float"]["is_accepted"], false);
  EXPECT_EQ(bounds["float"]["deciding"], "across");
  EXPECT_EQ(bounds["float"]["across"]["sphere"], 1);
  EXPECT_EQ(bounds["float"]["locations"][0]["line"], 4);
  EXPECT_NEAR(bounds["float"]["hit"]["value"].get<double>(), 25 * 0x1p-24 * 2000, 1e-4);
  EXPECT_EQ(bounds["mixed"]["is_accepted"], true);
  EXPECT_EQ(bounds["mixed"]["exact_spheres"], json({1}));
  EXPECT_EQ(bounds["double"]["is_accepted"], true);
  EXPECT_EQ(bounds["double"]["hit"]["limit"], 0.01);
  EXPECT_EQ(inspect("planet.scene --precision double")["precision"], "double");
}

TEST_F(InspectCommand, PrintsDiagnosticsAsRenderDoes) {
  write_text(folder_ / "bad.scene", "scene 1\nsphere { center: (0, 0, 0), radus: 1 }\n");
  for (const char* format : {"human", "concise", "json"}) {
    const std::string arguments = std::string("bad.scene --format ") + format;
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.out, "") << format;
    EXPECT_THAT(result.err, HasSubstr("E104")) << format;
    EXPECT_EQ(result.err, run_shell(folder_.path(), "\"$SDLC\" render " + arguments).err);
  }
}

TEST_F(InspectCommand, ListsTheFilesThatASceneReads) {
  const ProgramResult result = run("ring.scene --deps");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "ring.scene\nlibrary/materials.scene\nlibrary/lamp.scene\n");
  EXPECT_EQ(inspect("ring.scene --deps"),
            (json{"ring.scene", "library/materials.scene", "library/lamp.scene"}));
  EXPECT_EQ(inspect("ring.scene")["dependencies"],
            (json{"library/materials.scene", "library/lamp.scene"}));
  EXPECT_EQ(run("config.json --deps").out, "config.json\n");
}

TEST_F(InspectCommand, WritesDependencyFiles) {
  EXPECT_EQ(run("ring.scene --deps --target ring.png --target ring.exr").out,
            "ring.png ring.exr: \\\n  ring.scene \\\n  library/materials.scene \\\n"
            "  library/lamp.scene\n\nlibrary/materials.scene:\n\nlibrary/lamp.scene:\n");
  EXPECT_THAT(run("ring.scene --target ring.png").err, HasSubstr("--target requires --deps"));
  EXPECT_EQ(run("ring.scene --deps --target 'a\nb.png'").exit_code, 2);
  EXPECT_EQ(run("ring.scene --deps --target ''").exit_code, 2);
  EXPECT_THAT(run("ring.scene --deps --target 'a:b.png'").out, HasSubstr("a\\:b.png: "));
  write_text(folder_ / "bad.scene", "scene 1\ninclude \"missing.scene\"\n");
  const ProgramResult bad = run("bad.scene --deps --target bad.png");
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_EQ(bad.out, "") << "the missing file would not be in it";
}

TEST_F(InspectCommand, WritesDependencyFilesThatMakeAndNinjaRead) {
  if (run_shell(folder_.path(), "command -v make && command -v ninja").exit_code != 0) {
    GTEST_SKIP() << "needs make and ninja";
  }
  std::filesystem::create_directory(folder_ / "w");
  const std::filesystem::path work = folder_ / "w";
  write_text(work / "my ring.scene", "scene 1\nimport \"li b:#$.scene\" as lib\n");
  write_text(work / "li b:#$.scene", "scene 1\nlet a = 1\n");
  write_text(work / "Makefile",
             "out.txt:\n\t@echo made > out.txt\n\t@echo rebuilt\n"
             "\t@\"$(SDLC)\" inspect 'my ring.scene' --deps --target out.txt > out.d\n"
             "-include out.d\n");
  write_text(work / "build.ninja",
             "rule picture\n  command = echo made > $out && \"$$SDLC\" inspect 'my ring.scene' "
             "--deps --target $out > $out.d\n  depfile = $out.d\n"
             "build picture.txt: picture\n");
  const auto output_of = [&](const std::string& command) {
    const ProgramResult result = run_shell(work, "export SDLC; " + command);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    return result.out;
  };
  const std::string touch = "sleep 1; touch 'li b:#$.scene'; ";
  EXPECT_THAT(output_of("make"), HasSubstr("rebuilt"));
  EXPECT_THAT(output_of("make"), HasSubstr("up to date"));
  EXPECT_THAT(output_of("ninja"), HasSubstr("[1/1]"));
  EXPECT_THAT(output_of("ninja"), HasSubstr("no work to do"));
  EXPECT_THAT(output_of(touch + "make"), HasSubstr("rebuilt"));
  EXPECT_THAT(output_of("ninja"), HasSubstr("[1/1]"));
}

TEST_F(InspectCommand, ListsFilesThatOnlyOtherValuesRead) {
  write_text(folder_ / "rare.scene", R"(scene 1
param rare = false
def lit() { include "lit.scene" }
if rare { include "more.scene" }
for i in range(0) { include "more.scene" }
include "config.json"
assert 1 > 2, "this is not looked at"
)");
  write_text(folder_ / "lit.scene", "scene 1\ninclude \"library/lamp.scene\"\n");
  write_text(folder_ / "more.scene", "scene 1\ngroup { include \"most.scene\" }\n");
  write_text(folder_ / "most.scene", "scene 1\nimport \"library/materials.scene\" as m\n");
  const ProgramResult result = run("rare.scene --deps");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "rare.scene\nlit.scene\nmore.scene\nconfig.json\nlibrary/lamp.scene\nmost.scene\n"
            "library/materials.scene\n");
}

TEST_F(InspectCommand, ListsTheFilesOfASceneWithErrors) {
  write_text(folder_ / "bad.scene", R"(scene 1
import "library/materials.scene" as mat
sphere { radus: }
include "missing.scene"
include "library/lamp.scene"
)");
  const ProgramResult result = run("bad.scene --deps --format concise");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.out, "bad.scene\nlibrary/materials.scene\nlibrary/lamp.scene\n");
  EXPECT_THAT(result.err, HasSubstr("missing.scene"));
}

TEST_F(InspectCommand, ListsASceneOfStandardInputByTheNameItWasGiven) {
  EXPECT_EQ(run("- --deps <ring.scene").out, "library/materials.scene\nlibrary/lamp.scene\n");
  EXPECT_EQ(run("- --stdin-filename library/a.scene --deps <library/lamp.scene").out,
            "library/a.scene\n");
  EXPECT_THAT(run("- <config.json").out, HasSubstr("scene           <stdin>\n"));
  EXPECT_THAT(run("- <ring.scene").out, HasSubstr("<stdin>, which reads 2 other files\n"));
}

TEST_F(InspectCommand, ShowsTheOriginOfASphere) {
  const json spheres = inspect("ring.scene --where 9 --where 4 --where 4");
  ASSERT_EQ(spheres.size(), 2u) << "by index, each once";
  const json& bead = spheres[0];
  EXPECT_EQ(bead["sphere"], 4);
  EXPECT_EQ(bead["name"], "bead");
  EXPECT_EQ(bead["material"], "specular");
  EXPECT_EQ(bead["radius"], 0.25);
  EXPECT_EQ(bead["center"][1], 0.75);
  EXPECT_EQ(bead["shift"], (json{0, 0.5, 0}));
  EXPECT_EQ(bead["location"], (json{{"file", "ring.scene"}, {"line", 6}, {"column", 5}}));
  ASSERT_EQ(bead["chain"].size(), 2u);
  EXPECT_EQ(bead["chain"][0]["message"], "with i = 3");
  EXPECT_EQ(bead["chain"][1]["message"], "in `ring`");
  EXPECT_EQ(bead["chain"][1]["location"]["line"], 13);
  const json& lamp = spheres[1];
  EXPECT_EQ(lamp["name"], "lamp");
  EXPECT_EQ(lamp["location"]["file"], "library/lamp.scene");
  EXPECT_EQ(lamp["chain"][0]["location"]["file"], "ring.scene");
}

TEST_F(InspectCommand, ShowsTheOriginOfASphereInWords) {
  EXPECT_EQ(run("ring.scene --where 0 --where 1").out,
            "sphere 0: center (0, 0, 0), radius 1, diffuse\n"
            "  at ring.scene:11:1\n"
            "sphere 1 `bead`: center (2, 0.75, 0), radius 0.25, specular\n"
            "  moves by (0, 0.5, 0) while the shutter is open\n"
            "  at ring.scene:6:5\n"
            "  with i = 0, ring.scene:5:7\n"
            "  in `ring`, ring.scene:13:1\n");
}

TEST_F(InspectCommand, RefusesASphereThatIsNotThere) {
  const ProgramResult result = run("ring.scene --where 3 --where 10");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("there is no sphere 10; they are 0 to 9"));
  EXPECT_THAT(run("ring.scene --where x").err, HasSubstr("takes a whole number from 0"));
  EXPECT_EQ(run("ring.scene --where 1 --deps").exit_code, 2);
}

TEST_F(InspectCommand, SharesTheFlagsOfRender) {
  EXPECT_EQ(inspect("ring.scene --set count=3")["spheres"]["count"], 5);
  EXPECT_EQ(run("ring.scene --limit objects=5").exit_code, 1);
  EXPECT_THAT(run("ring.scene --tone sgrb").err, HasSubstr("did you mean `srgb`?"));
  std::filesystem::rename(folder_ / "library/lamp.scene", folder_ / "lamp.scene");
  write_text(folder_ / "library/outside.scene", "scene 1\ninclude \"../lamp.scene\"\n");
  EXPECT_EQ(run("library/outside.scene --sandbox --deps").exit_code, 1);
  EXPECT_EQ(run("missing.scene").exit_code, 2);
}

TEST_F(InspectCommand, PrintsNothingThatControlsATerminal) {
  write_text(folder_ / "odd.scene", R"(scene 1
background { color: white }
render { width: 8, height: 4, output: "\u001b[31mred.png" }
)");
  EXPECT_THAT(run("odd.scene").out, Not(HasSubstr("\x1b")));
  const ProgramResult json_form = run("odd.scene --format json");
  EXPECT_THAT(json_form.out, Not(HasSubstr("\x1b")));
}

TEST_F(InspectCommand, ChangesNothingOnTheDisk) {
  const auto before = names_in(folder_.path());
  EXPECT_EQ(run("ring.scene").exit_code, 0);
  EXPECT_EQ(run("config.json").exit_code, 0);
  EXPECT_EQ(names_in(folder_.path()), before);
}

TEST_F(InspectCommand, IsListedAndShowsExamples) {
  const ProgramResult help = run("--help");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, AllOf(HasSubstr("Examples:"), HasSubstr("--where")));
  EXPECT_THAT(run_shell(folder_.path(), "\"$SDLC\" --help").out, HasSubstr("inspect"));
}

// The picture is 360 rows of a plane 0.7279 high: a pixel of blur is 0.02022 per metre of the lens.
TEST_F(InspectCommand, TellsTheDepthsThatALensShowsSharply) {
  const auto write = [&](const std::string& focus) {
    write_text(folder_ / "lens.scene",
               "scene 1\n"
               "camera { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg, aperture: 0.1, focus: " +
                   focus + " }\nrender { width: 640 }\n");
  };
  write("10");
  EXPECT_THAT(run("lens.scene").out,
              HasSubstr("aperture 0.1, focus at 10, sharp from 8.318 to 12.53 (blur within"));
  const json near = inspect("lens.scene")["camera"]["lens"];
  EXPECT_NEAR(near["sharp_from"].get<double>(), 8.318, 1e-3);
  EXPECT_NEAR(near["sharp_to"].get<double>(), 12.535, 1e-3);
  EXPECT_NEAR(near["hyperfocal_distance"].get<double>(), 49.454, 1e-3);
  write("60");
  EXPECT_THAT(run("lens.scene").out, HasSubstr("sharp from 27.11 to infinity (blur within"));
  EXPECT_TRUE(inspect("lens.scene")["camera"]["lens"]["sharp_to"].is_null());
}

// The deciding spheres are found by further evaluations, whose steps are limited.
TEST_F(InspectCommand, NeedsNoMoreStepsThanTheScene) {
  write_text(folder_ / "many.scene",
             "scene 1\n"
             "camera { from: (0, 0, 50), at: (0, 0, 0), fov: 40deg }\n"
             "let clay = diffuse(color: tan)\n"
             "sphere { center: (0, -1e5, 0), radius: 99990, material: clay }\n"
             "for i in range(900) {\n"
             "  sphere { center: (i / 90 - 5, 0, 0), radius: 0.6 - i / 1e5, material: clay }\n"
             "}\n");
  const auto with_steps = [](int steps) {
    return "many.scene --limit steps=" + std::to_string(steps);
  };
  int too_few = 0, enough = 1 << 20;
  while (enough - too_few > 1) {
    const int steps = (too_few + enough) / 2;
    const bool is_enough = run(with_steps(steps)).err.find("E304") == std::string::npos;
    (is_enough ? enough : too_few) = steps;
  }
  EXPECT_THAT(run(with_steps(enough)).out, HasSubstr("sphere 900 at many.scene:6:3"));
  EXPECT_EQ(inspect(with_steps(enough))["precision_bounds"]["double"]["locations"].size(), 2u);
}

}  // namespace
}  // namespace sdlc::test
