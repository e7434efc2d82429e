#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/eval/eval.hpp"
#include "lang/json/json.hpp"
#include "lang/lint/lint.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/program/program.hpp"
#include "lang/resolve/symbol_index.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/lang/workspace/checked_program.hpp"
#include "tests/support/compilation/compilation.hpp"

// A request to stop is answered by every phase, and leaves a workspace that can go on.
namespace sdlc::test {
namespace {

using namespace lang;

/// A request that is made at the n-th poll.
class StopAtPoll final : public StopRequest {
 public:
  explicit StopAtPoll(std::uint64_t poll = UINT64_MAX) : poll_(poll) {}
  bool is_made() const override { return ++polls_ >= poll_; }
  std::uint64_t polls() const { return polls_; }

 private:
  std::uint64_t poll_;
  mutable std::uint64_t polls_ = 0;
};

const std::string kPicture =
    "camera { from: (0, 0, 50), at: (0, 0, 0), fov: 40deg }\nbackground { color: white }\n";

/// Several thousand spheres, some inside others, some the same as others, in groups and instances.
const std::string kLarge = "scene 1\nimport \"lib.scene\" as lib\n" + kPicture + R"(
for i in range(700) {
  sphere { center: (lib.wave(i), i / 100, 0), radius: 0.1, material: diffuse(color: red) }
}
group { material: transmissive(ior: 1.5)
  for i in range(200) { sphere { center: (i / 10, 0, 0), radius: 2 + mod(i, 7) } }
  for i in range(3) { sphere { center: (0, 0, 3), radius: 1 } }
}
sphere { center: (0, 40, 0), radius: 9, material: unlit(white) }
def row(n) { for i in range(n) { sphere { center: (i, 0, 9), radius: 0.2 } } }
for i in range(20) { row { n: 30, translate: (0, i, 0), material: unlit(blue) } }
)";

/// Mistakes that make the parser repair the text and the resolver search for names.
std::string mistakes() {
  std::string text = "scene 1\n" + kPicture;
  for (int i = 0; i < 100; ++i) {
    text += fmt::format("let velue{} = {}\nfn f{}(x) = x + value{}\n", i, i, i, i);
    text += fmt::format("for i in range(3) {{ sphere {{ radius = {}, center: (1 2, 0) }}\n", i);
  }
  return text;
}

/// `separator`: of the spheres.
std::string config(int spheres, const std::string& separator) {
  std::string text = R"({"background": [0, 0, 0], "spheres": [)";
  for (int i = 0; i < spheres; ++i) {
    text += fmt::format(
        "{}{{\"origin\": [{}, 0, 0], \"radius\": 0.4, \"material\": "
        "{{\"type\": \"no_texture\", \"color\": [255, 0, 0]}}}}",
        i == 0 ? "" : separator, i);
  }
  return text + "]}";
}

/// The line with each of the numbers below `count`.
std::string lines(fmt::format_string<int&> line, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += fmt::format(line, i);
  return text;
}

std::map<std::string, std::string> texts() {
  return {
      {"large.scene", kLarge},
      {"lib.scene", "scene 1\nfn wave(x) = 3 * sin(x * 1deg)\n"},
      {"mistakes.scene", mistakes()},
      {"good.json", config(3000, ",")},
      {"bad.json", config(2000, " ")},
      {"root.scene", "scene 1\n" + kPicture + "include \"good.json\"\ninclude \"large.scene\""}};
}

class StopTest : public testing::TestWithParam<const char*> {
 protected:
  CheckedProgram check(const StopRequest* stop = nullptr) {
    return check_program(workspace_, GetParam(), {.steps = 1'000'000}, stop);
  }
  std::map<std::string, std::vector<std::filesystem::path>> roots() const {
    std::map<std::string, std::vector<std::filesystem::path>> roots;
    for (const auto& [name, text] : texts()) roots[name] = workspace_.roots(name);
    return roots;
  }

  MemoryFiles disk_{texts()};
  Workspace workspace_{disk_};
};

TEST_P(StopTest, LeavesAWorkspaceThatGoesOn) {
  const CheckedProgram expected = check();
  const auto expected_roots = roots();
  StopAtPoll counter;
  EXPECT_EQ(check(&counter), expected);
  const std::uint64_t polls = counter.polls();
  EXPECT_GT(polls, 100u);
  // The first polls one by one, then fewer and fewer.
  for (std::uint64_t poll = 1; poll <= polls; poll += std::max<std::uint64_t>(poll / 5, 1)) {
    // The stopped check parses everything, the next one has what that left.
    workspace_.close("unrelated.scene");
    workspace_.open("unrelated.scene", "scene 1");
    const StopAtPoll stop(poll);
    EXPECT_THROW(check(&stop), StopRequested) << poll;
    EXPECT_EQ(stop.polls(), poll) << "work went on after the stop";
    EXPECT_EQ(roots(), expected_roots) << poll;
    ASSERT_EQ(check(), expected) << poll;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, StopTest,
                         testing::Values("large.scene", "mistakes.scene", "good.json", "bad.json",
                                         "root.scene"));

class IgnoredObjects final : public ObjectSink {
 public:
  void add(const Object& /*object*/) override {}
};

TEST(Stop, LeavesTheSinkWithoutTheEvaluation) {
  const std::string text = "scene 1\nlet a = 1\nlet late = 1 + time\nlet b = late + a\n" + kPicture;
  const Document file("test.scene", text);
  StopAtPoll counter;
  DiagnosticSink counted(&counter);
  Program program(file, {}, counted);
  const std::uint64_t before = counter.polls();
  const Evaluation whole(program, {}, counted);
  ASSERT_GT(counter.polls(), before);
  for (std::uint64_t poll = 1; poll <= counter.polls() - before; ++poll) {
    const StopAtPoll stop(poll);
    DiagnosticSink sink(&stop);
    EXPECT_THROW(Evaluation(program, {}, sink), StopRequested);
    EXPECT_TRUE(sink.chain().empty());
    sink.report(diag::file_circle, {&file, {0, 0}}, "test");
    EXPECT_EQ(sink.error_count(), 1u) << "it is muted";
  }
}

/// How often the request is polled by the phase.
template <typename Phase>
std::uint64_t polls_of(Phase phase) {
  const StopAtPoll counter;
  DiagnosticSink sink(&counter);
  phase(sink);
  return counter.polls();
}

// Each text makes one phase long and the phases before it short: they poll less than `kFew` times.
constexpr std::uint64_t kFew = 50, kMany = 500;

TEST(Stop, IsPolledByTheParser) {
  const Document file("large.scene", "scene 1\n" + lines("let a{0} = {0}\n", 5000));
  const Document wrong("mistakes.scene", mistakes());
  EXPECT_GT(polls_of([&](DiagnosticSink& sink) { file.tree(sink); }), kFew);
  EXPECT_GT(polls_of([&](DiagnosticSink& sink) { wrong.tree(sink); }), kMany) << "repair";
}

TEST(Stop, IsPolledByTheResolver) {
  const Document file(
      "large.scene", "scene 1\n" + lines("def d{0}(a) {{ sphere {{ radius: a + {0} }} }}\n", 1000));
  std::string parameters;
  for (int i = 0; i < 1000; ++i) parameters += fmt::format("p{}, ", i);
  const Document wide("wide.scene", "scene 1\nfn f(" + parameters + "last) = last\n");
  DiagnosticSink ignored;
  file.tree(ignored), wide.tree(ignored);  // parsed now, so not below
  EXPECT_GT(polls_of([&](DiagnosticSink& sink) { Program(file, {}, sink); }), kMany);
  for (const Document* document : {&file, &wide}) {
    Program program(*document, {}, ignored);
    EXPECT_GT(polls_of([&](DiagnosticSink& sink) { SymbolIndex(program, sink); }), kMany);
  }
}

TEST(Stop, IsPolledByEvaluationAndLowering) {
  const std::string head = "scene 1\n" + kPicture;
  const Document loop("loop.scene", head + "for i in range(100000) { let a = i * i }\n");
  const Document spheres("spheres.scene",
                         head +
                             "for i in range(20000) { sphere { center: (i, 0, 0), radius: 1, "
                             "material: unlit(red) } }\n");
  IgnoredObjects objects;
  DiagnosticSink ignored;
  Program of_loop(loop, {}, ignored), of_spheres(spheres, {}, ignored);
  const auto evaluate = [&](Program& program, ObjectSink& to) {
    return polls_of([&](DiagnosticSink& sink) { Evaluation(program, {}, sink).run(to); });
  };
  const Document empty("empty.scene", head);
  Program of_nothing(empty, {}, ignored);
  EXPECT_LT(evaluate(of_nothing, objects), kFew);
  EXPECT_GT(evaluate(of_loop, objects), 5 * kFew);
  const std::uint64_t evaluating = evaluate(of_spheres, objects);
  const auto lowering = polls_of([&](DiagnosticSink& sink) {
    SceneBuilder builder(spheres, {}, sink);
    Evaluation(of_spheres, {}, sink).run(builder);
    builder.finish({});
  });
  EXPECT_GT(lowering, evaluating + kFew);
}

TEST(Stop, IsPolledByLintRules) {
  const MemoryFiles disk(texts());
  Workspace workspace(disk);
  const ProgramOptions options{.workspace = &workspace, .limits = {}};
  const Document file("large.scene", kLarge);
  const auto checking =
      polls_of([&](DiagnosticSink& sink) { Compiler(file, options, sink).check(); });
  const auto linting = polls_of([&](DiagnosticSink& sink) {
    Compiler compiler(file, options, sink);
    lint(compiler, file, sink);
  });
  EXPECT_GT(linting, checking + kMany);
}

TEST(Stop, IsPolledByTheReaderOfConfigs) {
  const Document good("good.json", config(3000, ",")), bad("bad.json", config(2000, " "));
  IgnoredObjects objects;
  EXPECT_GT(polls_of([&](DiagnosticSink& sink) { read_config(good, objects, sink); }), 3000u);
  EXPECT_GT(polls_of([&](DiagnosticSink& sink) { read_config(bad, objects, sink); }), 6000u);
}

}  // namespace
}  // namespace sdlc::test
