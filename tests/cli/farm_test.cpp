#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program_test.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

constexpr const char* kScene =
    "scene 1\n"
    "param hue = \"grey\"\n"
    "render { width: 48, height: 32, samples: 700 }\n"
    "camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg, shutter: 0s .. 0.5s }\n"
    "sphere { center: (0, -100.5, 0), radius: 100, material: diffuse(#888888) }\n"
    "sphere { center: (time / 1s, 0, 0), radius: 0.5, material: transmissive(#FFFFFF, ior: 1.5) }\n"
    "sphere { center: (1, 2, 1), radius: 0.1, material: emissive(#FFFFFF, 50) }\n";

/// A name with all that shells and job files treat specially.
const std::string kOddName = "it's $HOME \"a b\" {{x}} `#`";

class Farm : public ProgramTest {
 protected:
  Farm() {
    const std::string text = kScene;
    write("a.scene", text);
    write("film.scene", text + "animation { frames: 1 .. 5, fps: 24 }\n");
    write(kOddName + ".scene", text);
  }

  void write_program(const std::string& name, const std::string& script) const {
    write(name, "#!/bin/sh\n" + script);
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  Json json(const std::string& name) const { return Json::parse(content(name)); }
  /// Runs in the folder, with the program for the scripts and without pauses.
  ProgramResult shell(const std::string& command) const {
    return run_shell(folder_.path(), "export SDLC SDLC_PAUSE=0; " + command);
  }
  ProgramResult sdlc(const std::string& arguments) const { return shell("\"$SDLC\" " + arguments); }
  std::string succeed(const std::string& command) const {
    const ProgramResult result = shell(command);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.out << result.err;
    return result.out + result.err;
  }
  std::string failure(int status, const std::string& arguments) const {
    const ProgramResult result = sdlc(arguments);
    EXPECT_EQ(result.exit_code, status) << arguments << "\n" << result.out << result.err;
    return result.out + result.err;
  }
  void farm(const std::string& arguments) const { succeed("\"$SDLC\" farm " + arguments); }
};

/// With GNU parallel, and with xargs where that is not found.
class ShellFarm : public Farm, public testing::WithParamInterface<bool> {
 protected:
  void SetUp() override {
    if (GetParam() && !has_program("parallel")) GTEST_SKIP() << "GNU parallel is not installed";
  }
  std::string path() const {
    if (GetParam()) return {};
    write_program("parallel", "exit 1\n");
    return "PATH=$PWD:$PATH ";
  }
};

INSTANTIATE_TEST_SUITE_P(, ShellFarm, testing::Bool(),
                         [](const auto& each) { return each.param ? "Parallel" : "Xargs"; });

TEST_P(ShellFarm, RendersTheBytesOfOneMachine) {
  succeed("\"$SDLC\" render a.scene -o a.exr --aov normal");
  farm("a.scene --engine shell -o job --tasks 5 --aov normal");
  succeed(path() + "JOBS=2 sh job/render.sh");
  expect_same("a.exr", "job/frames/a.exr");

  succeed("\"$SDLC\" render film.scene -o film.####.png --samples 16");
  farm("film.scene --engine shell -o film --tasks 3 --samples 16");
  EXPECT_EQ(content("film/render.tasks"), "1-2\n3-4\n5\n");
  succeed(path() + "sh film/render.sh");
  for (int frame = 1; frame <= 5; ++frame) {
    expect_same(fmt::format("film.000{}.png", frame),
                fmt::format("film/frames/film.000{}.png", frame));
  }
}

TEST_F(Farm, DividesLongFramesIntoShards) {
  succeed("\"$SDLC\" render film.scene -o film.####.png --frames 2,4");
  farm("film.scene --engine shell -o film --tasks 4 --frames 2,4");
  EXPECT_EQ(content("film/render.tasks"), "2 1\n2 2\n4 1\n4 2\n");
  succeed("sh film/render.sh");
  expect_same("film.0002.png", "film/frames/film.0002.png");
  expect_same("film.0004.png", "film/frames/film.0004.png");
}

TEST_F(Farm, RendersFromAPack) {
  succeed("\"$SDLC\" render film.scene -o film.####.png --frames 2-3 --samples 16");
  succeed("\"$SDLC\" pack film.scene && mkdir elsewhere && mv film.sdlc.zip elsewhere");
  farm("elsewhere/film.sdlc.zip --engine shell -o film --tasks 2 --frames 2-3 --samples 16");
  succeed("sh film/render.sh");
  expect_same("film.0002.png", "film/frames/film.0002.png");
  expect_same("film.0003.png", "film/frames/film.0003.png");
}

TEST_F(Farm, RendersTheSceneAsItWas) {
  fs::create_directory(folder_ / "scenes");
  write("scenes/part.scene", "scene 1\nlet size = 0.5\n");
  write("scenes/b.scene", std::string(kScene) +
                              "import \"part.scene\" as part\n"
                              "sphere { center: (0, 1, 0), radius: part.size, material: "
                              "diffuse(red) }\n");
  succeed("\"$SDLC\" render scenes/b.scene -o b.png --samples 16");
  farm("scenes/b.scene --engine shell -o job --tasks 1 --samples 16");
  fs::remove_all(folder_ / "scenes");
  succeed("mv job moved && sh moved/render.sh");
  expect_same("b.png", "moved/frames/b.png");
}

TEST_F(Farm, MeasuresThePicture) {
  EXPECT_THAT(succeed("\"$SDLC\" farm a.scene --engine shell -o job --samples 64"),
              AllOf(HasSubstr("samples/s on this machine"),
                    HasSubstr("1 task: 1 shard of the picture, then a merge")));
  EXPECT_THAT(
      succeed("\"$SDLC\" farm film.scene --engine shell -o film --samples 1000000 --task-time 1s"),
      HasSubstr("shards of each of 5 frames"));
  EXPECT_THAT(succeed("\"$SDLC\" farm film.scene --engine shell -o short --samples 1"),
              HasSubstr("1 task of 5 frames"));
}

TEST_F(Farm, GoesOnAfterATaskWasKilled) {
  succeed("\"$SDLC\" render a.scene -o a.png --width 240");
  farm("a.scene --engine shell -o job --tasks 4 --width 240");
  // The first renderer is killed, and its task repeated.
  write_program("once",
                "[ -e killed ] || { : >killed; kill -s KILL $$; }\nexec \"$REAL\" \"$@\"\n");
  EXPECT_THAT(succeed("REAL=$SDLC SDLC=$PWD/once sh job/render.sh"),
              HasSubstr("ended with status 137; attempt 2 of 5"));
  expect_same("a.png", "job/frames/a.png");
}

TEST_F(Farm, SavesItsFilmWhenATaskIsTerminated) {
  const std::string flags = " --width 240 --samples 1000";
  farm("a.scene --engine shell -o job --tasks 1" + flags);
  // A renderer that has a film is tracing.
  write_program("early",
                "for a; do shift; [ \"$a\" != 60s ] || a=10ms; set -- \"$@\" \"$a\"; done\n"
                "exec \"$REAL\" \"$@\"\n");
  const ProgramResult stopped = shell(
      "REAL=$SDLC SDLC=$PWD/early; export REAL\n"
      "job/task.sh render.tasks 0 & task=$!\n"
      "until [ -e job/parts/a.1.film ] || ! kill -0 $task; do sleep 0.01; done\n"
      "kill -s TERM $task; wait $task");
  if (stopped.exit_code != 0) {  // the task was not finished earlier
    EXPECT_EQ(stopped.exit_code, 130);
    EXPECT_THAT(stopped.err, HasSubstr("--resume goes on from parts/a.1.film"));
    EXPECT_THAT(failure(75, "farm status job"), HasSubstr("unfinished: parts/a.1.film"));
  }
  succeed("sh job/render.sh");
  succeed("\"$SDLC\" render a.scene -o a.png" + flags);
  expect_same("a.png", "job/frames/a.png");
}

TEST_F(Farm, TriesAgainAFewTimes) {
  farm("a.scene --engine shell -o job --tasks 1");
  write_program("full", "echo >>calls\nexit 75\n");
  EXPECT_EQ(shell("SDLC=$PWD/full job/task.sh render.tasks 0").exit_code, 75);
  EXPECT_EQ(content("job/calls").size(), 5U);
  write_program("broken", "echo >>calls2\nexit 1\n");
  EXPECT_EQ(shell("SDLC=$PWD/broken job/task.sh render.tasks 0").exit_code, 1);
  write_program("refused", "[ \"$1\" = farm ] && exec \"$REAL\" \"$@\"\nexit 2\n");
  EXPECT_EQ(shell("REAL=$SDLC SDLC=$PWD/refused sh job/render.sh").exit_code, 2);
  EXPECT_EQ(content("job/calls2").size(), 1U);
  EXPECT_EQ(shell("job/task.sh render.tasks 1").exit_code, 2);
}

TEST_F(Farm, StatusNamesFramesThatItsRetryRenders) {
  farm("film.scene --engine shell -o film --tasks 1 --samples 16");
  succeed("sh film/render.sh");
  const std::string second = content("film/frames/film.0002.png"),
                    fourth = content("film/frames/film.0004.png");
  fs::remove(folder_ / "film/frames/film.0002.png");
  fs::resize_file(folder_ / "film/frames/film.0004.png", fourth.size() / 2);
  succeed("\"$SDLC\" render film.scene --frames 5 --width 24 -o film/frames/film.####.png");

  const ProgramResult result = sdlc("farm status film --format json");
  EXPECT_EQ(result.exit_code, 75) << result.err;
  const Json status = Json::parse(result.out);
  EXPECT_EQ(status.at("complete"), false);
  EXPECT_EQ(status.at("frames").at("present"), 2);
  EXPECT_THAT(status.at("frames").at("missing"), ElementsAre("frames/film.0002.png"));
  const Json& damaged = status.at("frames").at("damaged");
  ASSERT_EQ(damaged.size(), 2U);
  EXPECT_EQ(damaged[0].at("file"), "frames/film.0004.png");
  EXPECT_EQ(damaged[1].at("cause"), "it has 24 x 16 pixels, not 48 x 32");
  EXPECT_TRUE(exists("film/frames/film.0004.png.damaged"));

  EXPECT_EQ(content("film/retry.tasks"), "2,4-5\n");
  succeed("sh film/retry.sh");
  EXPECT_EQ(content("film/frames/film.0002.png"), second);
  EXPECT_EQ(content("film/frames/film.0004.png"), fourth);
  EXPECT_THAT(succeed("\"$SDLC\" farm status film"), HasSubstr("5 of 5 frames are there"));
  EXPECT_FALSE(exists("film/retry.sh") || exists("film/retry.tasks"));
}

TEST_F(Farm, StatusNamesPartsThatItsRetryRenders) {
  farm("a.scene --engine shell -o job --tasks 4");
  for (int task = 0; task < 3; ++task) succeed(fmt::format("job/task.sh render.tasks {}", task));
  fs::resize_file(folder_ / "job/parts/a.2.film", 1000);
  EXPECT_THAT(failure(75, "farm status job"),
              AllOf(HasSubstr("the picture is missing"), HasSubstr("2 of 4 parts are there"),
                    HasSubstr("missing: parts/a.4.film"), HasSubstr("damaged: parts/a.2.film"),
                    HasSubstr("/job/retry.sh")));
  EXPECT_EQ(content("job/retry.tasks"), "- 2\n- 4\n");
  fs::rename(folder_ / "job/a.sdlc.zip", folder_ / "away");
  EXPECT_THAT(failure(2, "farm status job"), HasSubstr("it is missing, and the job renders it"));
  fs::rename(folder_ / "away", folder_ / "job/a.sdlc.zip");
  succeed("sh job/retry.sh");
  succeed("\"$SDLC\" render a.scene -o a.png");
  expect_same("a.png", "job/frames/a.png");
  // The parts are not needed any more.
  fs::remove_all(folder_ / "job/parts");
  succeed("\"$SDLC\" farm status job");
}

TEST_F(Farm, KeepsOddNamesSafe) {
  succeed("\"$SDLC\" render a.scene -o a.png --set 'hue={{x}} $HOME'");
  for (const char* engine : {"shell", "slurm", "openjd", "kubernetes"}) {
    succeed(
        fmt::format("\"$SDLC\" farm it*.scene --engine {0} -o \"o'f $HOME\n{0}\" --tasks 2 "
                    "--set 'hue={{{{x}}}} $HOME'",
                    engine));
  }
  const std::string home = shell("printf %s \"$HOME\"").out;
  succeed("sh \"o'f $HOME\nshell/render.sh\"");
  const std::string stem = "it's $HOME \"a b\" __x__ `_`";
  expect_same("a.png", "o'f " + home + "\nshell/frames/" + stem + ".png");
}

TEST_F(Farm, RefusesWhatCannotBe) {
  EXPECT_THAT(failure(2, "farm --engine shell -o job"), HasSubstr("FILE is required"));
  EXPECT_THAT(failure(2, "farm a.scene -o job"), HasSubstr("--engine is required"));
  EXPECT_THAT(failure(2, "farm a.scene --engine shell"), HasSubstr("--output is required"));
  EXPECT_THAT(failure(2, "farm a.scene --engine condor -o job"), HasSubstr("is not one of slurm"));
  EXPECT_THAT(failure(2, "farm - --engine shell -o job"), HasSubstr("from a file"));
  EXPECT_THAT(failure(2, "farm a.scene --engine shell -o job --frames 1-3"),
              HasSubstr("no `animation`"));
  EXPECT_THAT(failure(2, "farm a.scene --engine shell -o job --extension mp4"), HasSubstr("mp4"));
  EXPECT_THAT(failure(2, "farm a.scene --engine shell -o job --aov normal --extension png"),
              HasSubstr("only .exr files"));
  EXPECT_THAT(failure(2,
                      "farm film.scene --engine shell -o job --samples 1000000 --task-time 1ms "
                      "--frames 1-100"),
              HasSubstr("more than 100000"));
  EXPECT_THAT(failure(2, "farm a.scene --engine openjd -o '####'"), HasSubstr("would be replaced"));
  EXPECT_THAT(failure(2, "farm status job"), HasSubstr("farm.json"));
  write("two\nlines.scene", kScene);
  EXPECT_THAT(failure(1, "farm two*.scene --engine shell -o job"), HasSubstr("control characters"));
  write("broken.scene", "scene 1\nspere { }\n");
  failure(1, "farm broken.scene --engine shell -o job");
  EXPECT_FALSE(exists("job"));
}

TEST_F(Farm, KeepsTheJobOfAFolder) {
  farm("film.scene --engine shell -o film --samples 16 --tasks 2");
  const std::string before = content("film/farm.json");
  EXPECT_THAT(succeed("\"$SDLC\" farm film.scene --engine shell -o film --samples 16"),
              HasSubstr("has this job already: 2 tasks of 3 frames"));
  EXPECT_EQ(content("film/farm.json"), before);
  farm("film.scene --engine slurm -o film --samples 16");
  EXPECT_THAT(failure(2, "farm film.scene --engine shell -o film --samples 17"),
              HasSubstr("its list of flags is --samples 16, not --samples 17"));
  EXPECT_THAT(failure(2, "farm film.scene --engine shell -o film --samples 16 --frames 1-4"),
              HasSubstr("its list of frames is 1-5, not 1-4"));
  EXPECT_THAT(failure(2, "farm film.scene --engine shell -o film --samples 16 --tasks 5"),
              HasSubstr("divided into 2 tasks"));
  farm("a.scene --engine shell -o a --tasks 1");
  std::string text = kScene;
  write("a.scene", text.replace(text.find("700"), 3, "701"));
  EXPECT_THAT(failure(2, "farm a.scene --engine shell -o a"), HasSubstr("the scene has changed"));
  write("film.scene", content("film.scene") +
                          "sphere { center: (0, 3, 0), radius: 0.1, material: diffuse(red) }\n");
  EXPECT_THAT(failure(2, "farm film.scene --engine shell -o film --samples 16"),
              HasSubstr("the scene has changed"));
  fs::create_directory(folder_ / "other");
  write("other/mine.txt", "");
  EXPECT_THAT(failure(2, "farm film.scene --engine shell -o other"), HasSubstr("other files"));
}

TEST_F(Farm, WritesJobsForSlurm) {
  farm("a.scene --engine slurm -o job --tasks 3 --samples 1500 --width 49");
  for (const char* file : {"render.sbatch", "merge.sbatch", "submit.sh", "task.sh", "merge.sh"}) {
    succeed(fmt::format("bash -n job/{0} && sh -n job/{0}", file));
  }
  EXPECT_THAT(content("job/render.sbatch"),
              AllOf(HasSubstr("#SBATCH --array=0-2\n"), HasSubstr("#SBATCH --requeue\n"),
                    HasSubstr("exec ./task.sh render.tasks")));
  // sbatch runs each index at once, in the folder in which it was called.
  write_program("sbatch",
                "echo \"$@\" >>calls\n"
                "for script; do :; done\n"
                "for i in $(sed -n 's/^#SBATCH --array=0-//p' \"$script\" | xargs -r seq 0); do\n"
                "  SLURM_ARRAY_TASK_ID=$i SLURM_CPUS_ON_NODE=1 sh \"$script\" >&2\n"
                "done\n"
                "[ \"$script\" != merge.sbatch ] || sh \"$script\" >&2\n"
                "echo '42;cluster'\n");
  EXPECT_THAT(succeed("PATH=$PWD:$PATH sh job/submit.sh --partition=short"),
              HasSubstr("render: job 42\n"));
  EXPECT_EQ(content("job/calls"),
            "--parsable --partition=short render.sbatch\n"
            "--parsable --dependency=afterany:42 --partition=short merge.sbatch\n");
  succeed("\"$SDLC\" render a.scene -o a.png --samples 1500 --width 49");
  expect_same("a.png", "job/frames/a.png");

  // Retries, first of a part and then only of the merge.
  fs::remove(folder_ / "job/frames/a.png");
  fs::remove(folder_ / "job/parts/a.2.film");
  failure(75, "farm status job");
  EXPECT_THAT(content("job/retry.sbatch"), HasSubstr("#SBATCH --array=0-0\n"));
  succeed("PATH=$PWD:$PATH sh job/retry.sh");
  expect_same("a.png", "job/frames/a.png");
  fs::remove(folder_ / "job/frames/a.png");
  failure(75, "farm status job");
  EXPECT_THAT(content("job/retry.sh"), Not(HasSubstr("retry.sbatch")));
  succeed("PATH=$PWD:$PATH sh job/retry.sh");
  expect_same("a.png", "job/frames/a.png");
}

TEST_F(Farm, GivesAnIndexOfSlurmSeveralTasks) {
  farm("a.scene --engine slurm -o job --tasks 1500");
  EXPECT_THAT(content("job/render.sbatch"),
              AllOf(HasSubstr("#SBATCH --array=0-749\n"), HasSubstr("tasks=1500 per_index=2\n")));
  write_program("print", "for a; do case $a in */1500) echo $a ;; esac; done\n");
  EXPECT_EQ(shell("cd job && SDLC=../print SLURM_ARRAY_TASK_ID=749 sh render.sbatch").out,
            "1499/1500\n1500/1500\n");
}

TEST_F(Farm, WritesJobsForKubernetes) {
  farm("a.scene --engine kubernetes -o job --tasks 3 --image registry/sdlc:1");
  const Json list = json("job/render.json");
  EXPECT_EQ(list.at("kind"), "List");
  ASSERT_EQ(list.at("items").size(), 2U);
  const Json &render = list["items"][0], &merge = list["items"][1];
  for (const Json& job : list.at("items")) {
    EXPECT_EQ(job.at("apiVersion"), "batch/v1");
    EXPECT_EQ(job.at("kind"), "Job");
    const Json& pod = job.at("spec").at("template").at("spec");
    EXPECT_EQ(pod.at("restartPolicy"), "Never");  // required by podFailurePolicy
    const Json& container = pod.at("containers").at(0);
    EXPECT_EQ(container.at("image"), "registry/sdlc:1");
    EXPECT_EQ(container.at("workingDir"), fs::canonical(folder_ / "job").string());
    EXPECT_EQ(container.at("volumeMounts").at(0).at("mountPath"), container.at("workingDir"));
    EXPECT_EQ(container.at("volumeMounts").at(0).at("name"), pod.at("volumes").at(0).at("name"));
    EXPECT_EQ(pod.at("volumes").at(0).at("persistentVolumeClaim").at("claimName"), "sdlc-farm");
    const Json& rules = job.at("spec").at("podFailurePolicy").at("rules");
    EXPECT_EQ(rules[0].at("onExitCodes").at("values"), Json({1, 2, 3}));
    EXPECT_EQ(rules[1].at("action"), "Ignore");
    EXPECT_EQ(rules[1].at("onPodConditions").at(0).at("type"), "DisruptionTarget");
  }
  EXPECT_EQ(render.at("metadata").at("name"), "sdlc-a");
  EXPECT_EQ(merge.at("metadata").at("name"), "sdlc-a-merge");
  const Json& spec = render.at("spec");
  EXPECT_EQ(spec.at("completionMode"), "Indexed");
  EXPECT_EQ(spec.at("completions"), 3);
  EXPECT_EQ(spec.at("parallelism"), 3);
  EXPECT_EQ(spec.at("backoffLimitPerIndex"), 5);
  const Json& rules = spec.at("podFailurePolicy").at("rules");
  EXPECT_EQ(rules[0].at("action"), "FailIndex");
  EXPECT_EQ(rules[2].at("action"), "Ignore");
  EXPECT_EQ(rules[2].at("onExitCodes").at("values"), Json({75}));
  EXPECT_EQ(merge.at("spec").at("podFailurePolicy").at("rules")[0].at("action"), "FailJob");
  EXPECT_EQ(merge.at("spec").at("podFailurePolicy").at("rules").size(), 2U);
  EXPECT_THAT(spec.at("template").at("spec").at("containers")[0].at("command"),
              ElementsAre("/bin/sh", "./task.sh", "render.tasks", "$(JOB_COMPLETION_INDEX)"));
  EXPECT_THAT(merge.at("spec").at("template").at("spec").at("containers")[0].at("command"),
              ElementsAre("/bin/sh", "./merge.sh"));
  failure(75, "farm status job");
  const Json retry = json("job/retry.json");
  EXPECT_EQ(retry.at("items")[0].at("metadata").at("generateName"), "sdlc-a-retry-");
  EXPECT_EQ(retry.at("items")[0].at("spec").at("completions"), 3);
  // The commands of the pods.
  for (int index = 0; index < 3; ++index) {
    succeed(fmt::format("cd job && /bin/sh ./task.sh render.tasks {}", index));
  }
  succeed("cd job && /bin/sh ./merge.sh");
  succeed("\"$SDLC\" render a.scene -o a.png");
  expect_same("a.png", "job/frames/a.png");
}

/// Replaces the parameters of a job and of a task.
std::string expanded(std::string text, const Json& job, const Json& task) {
  for (const Json& parameter : job.at("parameterDefinitions")) {
    const std::string mark = "{{Param." + parameter.at("name").get<std::string>() + "}}";
    const std::string value = parameter.at("default");
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; at += value.size()) {
      text.replace(at, mark.size(), value);
    }
  }
  for (const auto& [name, value] : task.items()) {
    const std::string mark = "{{Task.Param." + name + "}}";
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos;) {
      text.replace(at, mark.size(), value.get<std::string>());
    }
  }
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

/// What a worker runs for a task of a step.
std::string command_of(const Json& job, const Json& step, const Json& task) {
  const Json& action = step.at("script").at("actions").at("onRun");
  std::string line = "\"$SDLC\"";
  if (action.at("command") != "{{Param.Sdlc}}") line = action.at("command");
  for (const Json& argument : action.at("args")) {
    line += ' ' + quoted(expanded(argument.get<std::string>(), job, task));
  }
  return line;
}

TEST_F(Farm, WritesJobsForOpenJobDescription) {
  farm("film.scene --engine openjd -o film --tasks 2 --samples 16 --set 'hue={{x}}'");
  const Json job = json("film/render.json");
  EXPECT_THAT(job.at("extensions"), ElementsAre("TASK_CHUNKING"));
  ASSERT_EQ(job.at("steps").size(), 1U);
  const Json& step = job.at("steps")[0];
  const Json& parameter = step.at("parameterSpace").at("taskParameterDefinitions").at(0);
  EXPECT_EQ(parameter.at("type"), "CHUNK[INT]");
  EXPECT_EQ(parameter.at("range"), "1-5");
  EXPECT_EQ(parameter.at("chunks").at("defaultTaskCount"), 3);
  EXPECT_EQ(parameter.at("chunks").at("rangeConstraint"), "CONTIGUOUS");
  EXPECT_THAT(succeed(command_of(job, step, {{"Frames", "1-4"}})),
              HasSubstr("openjd_progress: 100\n"));
  succeed(command_of(job, step, {{"Frames", "5-5"}}));
  succeed("\"$SDLC\" farm status film");
  EXPECT_FALSE(exists("film/merge.sh"));

  farm("film.scene --engine openjd -o shards --tasks 4 --frames 2,4");
  const Json shards = json("shards/render.json");
  EXPECT_FALSE(shards.contains("extensions"));
  ASSERT_EQ(shards.at("steps").size(), 2U);
  EXPECT_EQ(shards.at("steps")[1].at("dependencies")[0].at("dependsOn"), "Render");
  for (const char* frame : {"2", "4"}) {
    for (const char* shard : {"1", "2"}) {
      succeed(command_of(shards, shards.at("steps")[0], {{"Frame", frame}, {"Shard", shard}}));
    }
  }
  succeed(command_of(shards, shards.at("steps")[1], Json::object()));
  succeed("\"$SDLC\" farm status shards");
  succeed("\"$SDLC\" render film.scene -o film.####.png --frames 2,4");
  expect_same("film.0004.png", "shards/frames/film.0004.png");

  fs::remove_all(folder_ / "shards/frames");
  fs::remove(folder_ / "shards/parts/film.0004.1.film");
  failure(75, "farm status shards");
  const Json retry = json("shards/retry.json");
  const Json& space = retry.at("steps")[0].at("parameterSpace");
  EXPECT_EQ(space.at("combination"), "(Frame, Shard)");
  EXPECT_EQ(space.at("taskParameterDefinitions")[0].at("range"), Json({1}));
  EXPECT_EQ(space.at("taskParameterDefinitions")[1].at("range"), Json({4}));
}

TEST_F(Farm, WritesValidOpenJobDescriptions) {
  if (!has_program("python3") ||
      run_shell(folder_.path(), "python3 -c 'import jsonschema'").exit_code != 0) {
    GTEST_SKIP() << "python3-jsonschema is not installed";
  }
  std::string lines;
  const auto add = [&](const std::string& name, const std::string& flags) {
    farm(flags + " --engine openjd -o " + name);
    lines += json(name + "/render.json").dump() + "\n";
    sdlc("farm status " + name);
    lines += json(name + "/retry.json").dump() + "\n";
  };
  add("a", "a.scene --tasks 3");
  add("b", "a.scene --error 5% --tasks 1");
  add("c", "film.scene --tasks 2 --set 'hue={{x}}\na}}'");
  add("d", "film.scene --frames 1-5x2 --tasks 1");
  add("e", "film.scene --tasks 15");
  add("f", "film.scene --samples 1");
  Json wrong = json("c/render.json");
  wrong.erase("extensions");
  lines += wrong.dump() + "\n";
  write("templates", lines);
  const std::string verdicts =
      succeed("python3 '" SDLC_SOURCE_DIR "/tests/cli/validate_configs.py' '" SDLC_SOURCE_DIR
              "/tests/cli/openjd.schema.json' < templates");
  std::string expected;
  for (int i = 0; i < 12; ++i) expected += "valid\n";
  EXPECT_EQ(verdicts, expected + "invalid\n");
}

TEST_F(Farm, ReportsProgressToOpenJobDescription) {
  const ProgramResult result = sdlc("render a.scene --progress openjd -o a.png");
  EXPECT_EQ(result.exit_code, 0);
  // A busy machine may report before the end, too.
  EXPECT_THAT(result.out, testing::EndsWith("openjd_progress: 100\n"));
  const ProgramResult failed = sdlc("render gone.scene --progress openjd -o a.png");
  EXPECT_EQ(failed.exit_code, 2);
  EXPECT_EQ(failed.out, "openjd_fail: sdlc ended with status 2; standard error has the reason\n");
  EXPECT_THAT(failure(2, "render a.scene --progress openjd -o -"),
              HasSubstr("writes to standard output"));
  EXPECT_THAT(failure(2, "render a.scene --progress openjd -o a.png --stats -"),
              HasSubstr("writes to standard output"));
  const ProgramResult longer = shell(
      "\"$SDLC\" render a.scene --progress openjd -o a.png --samples 16777216 >out & job=$!\n"
      "until grep -q samples/s out || ! kill -0 $job; do sleep 0.01; done\n"
      "kill -s KILL $job; cat out");
  EXPECT_THAT(longer.out,
              testing::ContainsRegex("openjd_progress: [0-9.]+\nopenjd_status: .* samples/s"));
}

}  // namespace
}  // namespace sdlc::test
