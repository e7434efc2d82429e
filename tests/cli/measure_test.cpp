#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }
background { bottom: white, top: #80b3ff }
sphere ground { center: (0, -100, 0), radius: 100, material: diffuse(color: gray) }
sphere ball { center: (0, 0.5, 0), radius: 0.5, material: specular(color: tan, fuzz: 0.3) }
render { width: 6, samples: 20, depth: 4 }
)";

/// So few pixels that the whole plan takes a second or two.
class Measure : public testing::Test {
 protected:
  void SetUp() override { write_text(folder_ / "ball.scene", kScene); }

  ProgramResult run(const std::string& arguments) const {
    return run_shell(folder_.path(), "\"$SDLC\" measure ball.scene --budget 20s " + arguments);
  }
  json report(const std::string& name) const { return json::parse(content_of(folder_ / name)); }

  const TemporaryFolder folder_;
};

TEST_F(Measure, WritesATableAndFiles) {
  const ProgramResult result = run("-o a.html -o a.json -o a.csv --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("ball.scene, 6 × 3 pixels"));
  EXPECT_THAT(result.out, HasSubstr("reference: "));
  EXPECT_THAT(result.out, HasSubstr(" %: --samples "));

  const json measured = report("a.json");
  EXPECT_EQ(measured["format"], "sdlc-measurement");
  EXPECT_TRUE(measured["is_complete"]);
  EXPECT_THAT(measured["command"].get<std::string>(), HasSubstr("sdlc measure ball.scene"));
  EXPECT_EQ(measured["own"]["depth"], 4);
  EXPECT_LT(measured["reference"]["relative_error"], 0.01);
  ASSERT_GE(measured["points"].size(), 10u);
  const auto has_own = std::ranges::any_of(measured["points"], [](const json& point) {
    return point["samples"] == 20 && point["sampler"] == "sobol";
  });
  EXPECT_TRUE(has_own) << "the scene's own samples are among them";
  EXPECT_EQ(measured["precision"]["refusal"], nullptr);
  EXPECT_EQ(measured["left_out"], json::array());

  const std::string csv = content_of(folder_ / "a.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(csv, '\n')), measured["points"].size() + 1);
  EXPECT_TRUE(csv.starts_with("samples,sampler,light_sampling,precision,depth,denoise,seconds,"));

  const std::string page = content_of(folder_ / "a.html");
  EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
  for (const json& recommendation : measured["recommendations"]) {
    // The others depend on timing, and a line may be broken between two.
    const auto flags = recommendation["flags"].get<std::string>();
    EXPECT_THAT(page, HasSubstr(flags.substr(0, flags.find(" --"))));
  }
}

TEST_F(Measure, TimesNumbersOfThreads) {
  const ProgramResult result = run("--threads-sweep --threads 3 -o a.json -o a.html --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("samples with numbers of threads"));
  EXPECT_THAT(result.out, HasSubstr("All of these pictures are the same, byte for byte."));
  EXPECT_THAT(result.out, HasSubstr("--threads 3"));
  EXPECT_THAT(result.out, Not(HasSubstr("--threads-sweep")));
  const json scaling = report("a.json")["thread_scaling"];
  ASSERT_EQ(scaling.size(), 3u);
  EXPECT_EQ(scaling[0]["speed_up"], 1);
  EXPECT_EQ(scaling[2]["threads"], 3);
  EXPECT_THAT(content_of(folder_ / "a.html"), HasSubstr("Speed-up against threads"));
  run("-o without.json --quiet");
  EXPECT_EQ(report("without.json")["thread_scaling"], json::array());
}

/// The names of all fields, at any depth, except those that identify the machine.
void collect_names(const json& value, std::set<std::string>& names) {
  for (const auto& [name, field] : value.items()) {
    if (value.is_object()) names.insert(name);
    if (name != "machine" && field.is_structured()) collect_names(field, names);
  }
}

TEST_F(Measure, HasNoFieldThatItsPageDoesNotName) {
  ASSERT_EQ(run("-o old.json --quiet").exit_code, 0);
  run("--threads-sweep --against old.json -o a.json --quiet");
  std::set<std::string> names;
  collect_names(report("a.json"), names);
  ASSERT_GT(names.size(), 50u);
  const std::string page = content_of(fs::path(SDLC_SOURCE_DIR) / "docs/measure.md");
  for (std::string name : names) {
    constexpr std::string_view kInterval = "_interval";
    if (name.ends_with(kInterval)) name.resize(name.size() - kInterval.size());
    EXPECT_THAT(page, HasSubstr("`" + name + "`"));
  }
}

TEST_F(Measure, AnswersInJsonAndCsvOnStandardOutput) {
  const ProgramResult in_json = run("--format json --quiet");
  ASSERT_EQ(in_json.exit_code, 0) << in_json.err;
  EXPECT_EQ(json::parse(in_json.out)["seed"], 0);
  const ProgramResult in_csv = run("--format csv --quiet --seed 3");
  EXPECT_TRUE(in_csv.out.starts_with("samples,sampler,"));
}

TEST_F(Measure, RecommendsForTheErrorThatIsAskedFor) {
  ASSERT_EQ(run("--error 3% -o a.json --quiet").exit_code, 0);
  const json measured = report("a.json");
  bool is_there = false;
  for (const json& recommendation : measured["recommendations"]) {
    if (std::abs(recommendation["goal"].get<double>() - 0.03) > 1e-9) continue;
    is_there = true;
    EXPECT_TRUE(recommendation["is_main"]);
    EXPECT_LE(recommendation["relative_error_interval"][1], 0.0301);
  }
  EXPECT_TRUE(is_there);
}

TEST_F(Measure, ReportsIfTheRequestedErrorIsTooFar) {
  const ProgramResult result = run("--error 0.00001% -o a.json --quiet");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out,
              HasSubstr("No number of samples can be predicted for the requested error of 1e-05"));
  EXPECT_FALSE(report("a.json")["notes"].empty());
}

TEST_F(Measure, RecommendsFlagsThatMakeThePictureThatWasMeasured) {
  ASSERT_EQ(run("--sampler independent --depth 3 --seed 7 --width 8 --error 5% -o a.json --quiet")
                .exit_code,
            0);
  const json measured = report("a.json");
  for (const json& recommendation : measured["recommendations"]) {
    const auto flags = recommendation["flags"].get<std::string>();
    const ProgramResult rendered = run_shell(
        folder_.path(), "\"$SDLC\" render ball.scene --quiet -o a.exr --stats - " + flags);
    ASSERT_EQ(rendered.exit_code, 0) << flags << rendered.err;
    const json stats = json::parse(rendered.out);
    EXPECT_EQ(stats["width"], 8);
    EXPECT_EQ(stats["seed"], 7);
    for (const char* field : {"depth", "samples", "sampler", "light_sampling", "precision"}) {
      EXPECT_EQ(stats[field], recommendation[field]) << flags;
    }
  }
}

TEST_F(Measure, GoesOnWhereItWasInterrupted) {
  const std::string measure =
      "\"$SDLC\" measure ball.scene --width 24 --budget 1h --work kept -o a.json --quiet";
  // Interrupted as soon as there are three points; a budget of an hour is far from used up.
  const ProgramResult stopped = run_shell(folder_.path(), measure + R"sh( & pid=$!
         points() { grep -c '"flip"' kept/study.json 2>/dev/null || true; }
         until [ "$(points)" -ge 3 ] 2>/dev/null || ! kill -0 $pid; do sleep 0.05; done
         kill -TERM $pid; wait $pid)sh");
  EXPECT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_THAT(stopped.err, HasSubstr("the partial report was saved as a.partial.json"));
  EXPECT_THAT(stopped.err, HasSubstr("run the same command to resume from kept"));
  EXPECT_FALSE(fs::exists(folder_ / "a.json"));
  const json before = report("a.partial.json");
  EXPECT_FALSE(before["is_complete"]);
  ASSERT_GE(before["points"].size(), 3u);

  // The plan stays, and there is no time left: the results so far are reported completely.
  const ProgramResult rest = run_shell(
      folder_.path(),
      "\"$SDLC\" measure ball.scene --width 24 --budget 1ms --work kept -o a.json --quiet");
  ASSERT_EQ(rest.exit_code, 0) << rest.err;
  const json after = report("a.json");
  EXPECT_TRUE(after["is_complete"]);
  EXPECT_EQ(after["points"].size(), before["points"].size());
  for (std::size_t i = 0; i < before["points"].size(); ++i) {
    for (const char* field : {"samples", "timings", "relative_error", "rmse", "flip"}) {
      EXPECT_EQ(after["points"][i][field], before["points"][i][field]);
    }
  }
  EXPECT_EQ(after["reference"], before["reference"]);
  EXPECT_FALSE(after["left_out"].empty());
}

TEST_F(Measure, ComesToTheSameWhenAllOfItIsKept) {
  ASSERT_EQ(run("--work kept -o a.json -o a.html --quiet").exit_code, 0);
  ASSERT_EQ(run("--work kept -o b.json -o b.html --quiet").exit_code, 0);
  json a = report("a.json"), b = report("b.json");
  for (json* any : {&a, &b}) {
    (*any).erase("command");
    (*any).erase("spent_seconds");
  }
  EXPECT_EQ(a, b);
  EXPECT_EQ(std::ranges::count(content_of(folder_ / "a.html"), '<'),
            std::ranges::count(content_of(folder_ / "b.html"), '<'));
}

TEST_F(Measure, RefusesAFolderOfAnotherMeasurement) {
  ASSERT_EQ(run("--work kept --quiet").exit_code, 0);
  const ProgramResult other_seed = run("--work kept --seed 9");
  EXPECT_EQ(other_seed.exit_code, 2);
  EXPECT_THAT(other_seed.err, HasSubstr("another seed (0, now 9)"));
  write_text(folder_ / "ball.scene",
             std::string(kScene) +
                 "sphere { center: (1, 1, 1), radius: 0.1, material: diffuse(color: gray) }\n");
  const ProgramResult other_scene = run("--work kept");
  EXPECT_EQ(other_scene.exit_code, 2);
  EXPECT_THAT(other_scene.err, HasSubstr("another scene"));
}

TEST_F(Measure, RefusesAFolderThatIsDamaged) {
  ASSERT_EQ(run("--work kept --quiet").exit_code, 0);
  const std::string study = content_of(folder_ / "kept" / "study.json");
  fs::resize_file(folder_ / "kept" / "reference.f32", 8);
  const ProgramResult short_reference = run("--work kept");
  EXPECT_EQ(short_reference.exit_code, 2);
  EXPECT_THAT(short_reference.err, HasSubstr("its reference.f32 is damaged"));
  write_text(folder_ / "kept" / "study.json", study.substr(0, study.size() / 2));
  const ProgramResult half = run("--work kept");
  EXPECT_EQ(half.exit_code, 2);
  EXPECT_THAT(half.err, HasSubstr("its study.json cannot be read"));
  EXPECT_THAT(half.err, HasSubstr("remove the folder to start again"));
}

TEST_F(Measure, HoldsItselfAgainstAnEarlierReport) {
  ASSERT_EQ(run("-o old.json --quiet").exit_code, 0);
  const ProgramResult same = run("--against old.json -o new.json --quiet");
  EXPECT_THAT(same.out, HasSubstr("Against "));
  // Times of a loaded machine may be worse; the pictures of the same renderer never are.
  const json held = report("new.json");
  ASSERT_FALSE(held["against"]["points"].empty());
  for (const json& point : held["against"]["points"]) {
    EXPECT_EQ(point["error"], "not distinguished");
  }

  json better = report("old.json");
  for (json& point : better["points"]) {
    for (const char* field : {"relative_error", "relative_error_spread"}) {
      point[field] = point[field].get<double>() / 10;
    }
    for (json& end : point["relative_error_interval"]) end = end.get<double>() / 10;
  }
  better["machine"]["processor"] = "another";
  write_text(folder_ / "better.json", better.dump());
  const ProgramResult worse = run("--against better.json --quiet");
  EXPECT_EQ(worse.exit_code, 1);
  EXPECT_THAT(worse.out, HasSubstr("WORSE"));
  EXPECT_THAT(worse.out, HasSubstr("times are not compared"));
}

TEST_F(Measure, RefusesToBeHeldAgainstSomethingElse) {
  ASSERT_EQ(run("-o old.json --quiet").exit_code, 0);
  const ProgramResult size = run("--against old.json --width 7");
  EXPECT_EQ(size.exit_code, 2);
  EXPECT_THAT(size.err, HasSubstr("of another size (6 × 3)"));
  const ProgramResult scene = run("--against old.json --camera nobody");
  EXPECT_NE(scene.exit_code, 0);
  write_text(folder_ / "ball.scene",
             std::string(kScene) +
                 "sphere { center: (1, 1, 1), radius: 0.1, material: diffuse(color: gray) }\n");
  EXPECT_THAT(run("--against old.json").err, HasSubstr("of another scene"));
  write_text(folder_ / "text.json", "{\"points\": []}");
  EXPECT_THAT(run("--against text.json").err, HasSubstr("not a JSON report of `sdlc measure`"));
  EXPECT_EQ(run("--against text.json").exit_code, 2);
  write_text(folder_ / "broken.json", "{");
  EXPECT_EQ(run("--against broken.json").exit_code, 2);
  EXPECT_THAT(run("--against none.json").err, HasSubstr("none.json"));
  json old = report("old.json");
  old["format_version"] = 99;
  write_text(folder_ / "later.json", old.dump());
  EXPECT_THAT(run("--against later.json").err, HasSubstr("version 99"));
  old["format_version"] = 1;
  old["points"][0].erase("seconds");
  write_text(folder_ / "hole.json", old.dump());
  EXPECT_EQ(run("--against hole.json").exit_code, 2);
}

TEST_F(Measure, ReportsWhatItCannotDo) {
  const auto expect_usage = [&](const std::string& arguments, const std::string& words) {
    const ProgramResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_EQ(result.out, "");
  };
  expect_usage("-o a.png", "`a.png` is not a report; reports are .html, .json and .csv");
  expect_usage("-o a.htm", "did you mean `html`?");
  expect_usage("-o a.json -o a.json", "two outputs go to `a.json`");
  expect_usage("-o nowhere/a.json", "nowhere");
  expect_usage("--time 3s", "use --budget to limit the time");
  expect_usage("--adaptive --error 1%", "--adaptive cannot be measured");
  expect_usage("--budget 0s", "--budget");
  expect_usage("--budget long", "--budget");
  expect_usage("--format html", "`html` is not one of human, json, csv");
  expect_usage("--frame 3", "no `animation`");
}

TEST_F(Measure, ReportsErrorsOfTheSceneAndMeasuresNothing) {
  write_text(folder_ / "ball.scene", "scene 1\nsphere { radus: 1 }\n");
  const ProgramResult result = run("-o a.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("did you mean `radius`?"));
  EXPECT_FALSE(fs::exists(folder_ / "a.json"));
}

TEST_F(Measure, RecommendsTheFewestSamplesForAPictureWithoutNoise) {
  write_text(folder_ / "ball.scene", R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 30deg }
background { bottom: black, top: black }
sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: gray) }
render { width: 6, depth: 4 }
)");
  const ProgramResult result = run("-o a.html -o a.json --quiet");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, Not(HasSubstr("nan")));
  EXPECT_THAT(result.out, HasSubstr("without noise: --samples 8, "));
  const json measured = report("a.json");
  ASSERT_EQ(measured["recommendations"].size(), 1u);
  EXPECT_EQ(measured["recommendations"][0]["goal"], nullptr);
}

TEST_F(Measure, ReadsStandardInputAndOneFrameOfAFilm) {
  const ProgramResult result = run_shell(folder_.path(),
                                         R"("$SDLC" measure - --budget 20s --quiet --frame 3 <<'END'
scene 1
animation { frames: 1 .. 4, fps: 24 }
camera main { from: (0, 1, 5), at: (0, 0.5, 0), fov: 30deg }
background { bottom: white, top: white }
sphere { center: (time / 1s, 0, 0), radius: 1, material: diffuse(color: gray) }
render { width: 4, depth: 4 }
END
)");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("<stdin>, 4 × 2 pixels"));
}

}  // namespace
}  // namespace sdlc::test
