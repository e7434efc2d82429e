#include "lang/lint/fix_text.hpp"

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/lint/fix_guard.hpp"
#include "lang/lint/linted_text.hpp"

// Results of fixes: safe ones produce the certain meaning, unsafe ones the probable meaning, and
// neither adds errors.
namespace sdlc::lang {
namespace {

FixResult fix(const std::string& name, std::string text, bool applies_unsafe) {
  const CheckText check = [&](std::string fixed) {
    return std::make_unique<LintedText>(std::make_shared<const Document>(name, std::move(fixed)));
  };
  return fix_text(check(std::move(text)), applies_unsafe, check);
}

constexpr std::string_view kVersion = "scene 1\n";

/// A scene without its first line, after its safe fixes.
std::string safely(const std::string& scene) {
  const FixResult result = fix("a.scene", std::string(kVersion) + scene, false);
  return std::string(result.checked->file().text().substr(kVersion.size()));
}
std::string by_guesses(const std::string& scene) {
  const FixResult result = fix("a.scene", std::string(kVersion) + scene, true);
  return std::string(result.checked->file().text().substr(kVersion.size()));
}
std::string config_safely(const std::string& config) {
  return std::string(fix("a.json", config, false).checked->file().text());
}

/// No safe fix changes any of these.
void expect_left_alone(std::initializer_list<std::string> scenes) {
  for (const std::string& scene : scenes) EXPECT_EQ(safely(scene), scene);
}
void expect_configs_left_alone(std::initializer_list<std::string> configs) {
  for (const std::string& config : configs) EXPECT_EQ(config_safely(config), config);
}

// Each left the number of errors unchanged, so the count alone does not show the damage.
TEST(SafeFixes, GlueNoWordsAndLeaveWhatIsInQuotes) {
  expect_left_alone({"let c = if a||b then 1 else 2\n", "let c = if 1 < 2&&a then 1 else 2\n",
                     "let d = 40°C\n", "let d = 40°at2\n", "let r = = 1\n", "let r :: 3\n",
                     "let r = “a “b” c”\n", "let r = ‘it’s’\n", "let r = '''a'''\n",
                     "let r = 'a''b'\n", "let r = x'ff8800'\n"});
  for (const std::string version : {"scene \"1\"\n", "scene(1)\n", "scene v1\n", "scene #1\n"}) {
    EXPECT_EQ(fix("a.scene", version, false).checked->file().text(), version);
  }
  expect_left_alone({"group(translate: (0, 1, 0)) { sphere { center: (0, 0, 0), radius: 1 } }\n",
                     "let v = (1, 0, 0) × (0, 1, 0)\n", "let v = (1, 0, 0) · (0, 1, 0)\n"});
  const std::string quoted = "assert true, 'he said “no” && it \\\"s'\n";
  EXPECT_EQ(safely(quoted), quoted);
}

TEST(UnsafeFixes, RemoveAChainOfUnusedNames) {
  std::string chain = "let a0 = 1\n";
  for (int i = 1; i < 30; ++i) {
    chain += "let a" + std::to_string(i) + " = a" + std::to_string(i - 1) + "\n";
  }
  const std::string picture =
      "camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
      "sphere { center: (0, 0, 0), radius: 1, material: diffuse(color: tan) }\n";
  EXPECT_EQ(by_guesses(chain + picture), picture);
}

TEST(SafeFixes, ChangeNoForeignLetters) {
  expect_left_alone({"let a = 50μm\n", "let a = 10µm\n", "let a = 2π\n", "let a = 3é\n",
                     "let a = 1Å * 2\n", "let a = 5!\n", "let a = 5é3\n"});
}

TEST(SafeFixes, LeaveATextOfTheOtherFormat) {
  const std::string config = "{\"camera\": {\"x\": 1,}, \"spheres\": []}\n";
  EXPECT_EQ(fix("a.scene", config, false).checked->file().text(), config);
  expect_configs_left_alone({"scene 1\nsphere { center: (0, 0, 0), radius: 1, }\n"});
}

TEST(SafeFixes, KeepDocumentationAtItsStatement) {
  EXPECT_EQ(fix("a.scene", "// File\n/// The ball\nlet a = 1\n", false).checked->file().text(),
            "// File\nscene 1\n/// The ball\nlet a = 1\n");
}

// `:=` was half replaced, which left `==`, and `=>` became `:>`.
TEST(SafeFixes, TakeASignAsAWhole) {
  EXPECT_EQ(safely("let a := 3\n"), "let a = 3\n");
  EXPECT_EQ(safely("fn f(x) := x\n"), "fn f(x) = x\n");
  expect_left_alone({"sphere { center => (0, 0, 0) }\n", "sphere { center =>(0, 0, 0) }\n",
                     "background { color := white }\n", "param b := 2\n",
                     "camera main { from=>(0, 0, 5) }\n", "let a ::= 3\n", "let a =: 3\n",
                     "let a === 3\n", "sphere { radius =:= 1 }\n"});
  expect_configs_left_alone({R"({"camera" => {}})", R"({"camera" := {}})"});
}

TEST(SafeFixes, LeaveStringsOfConfigsAlone) {
  expect_configs_left_alone({
      R"({"spheres": [{"origin"x [0, 0, 0]}]})",
      "{\"spheres\": [{\"ori\ngin\": [0, 0, 0]}]}",
      "{\"saving\": {\"path\": \"a\tb\"}}",
      R"({"saving": {"path": "C:\dir\new"}})",
      R"({"camera": {"look"_from": [0, 0, 0]}})",
      R"({"camera": {'look "x" from': [0, 0, 0]}})",
  });
}

TEST(SafeFixes, LeaveStringsAndCommentsOfScenesAlone) {
  expect_left_alone({
      "let a = \"C:\\dir\"\n",
      "let a = \"one\ttwo\"\n",
      "let a = \"one\xE2\x80\xAEtwo\"\n",
      "// a comment\x01 with a control\nlet a = 1\n",
      "let a = 'it // isn't'\n",
  });
}

TEST(SafeFixes, AddNoColonByGuess) {
  expect_left_alone({
      "def planet(size: number) { sphere { center: (0, 0, 0), radius: size, material: unlit(red) } "
      "}\n"
      "planet { earth size: 0.2 }\n",
      "render { light-sampling: on }\n",
      "group { translate: 1.4 x d }\n",
      "group { rotate x 5 }\n",
      "sphere { position (0, 0, 0) }\n",
      "group { ring(3) }\n",
  });
}

TEST(SafeFixes, AddNoCommaByGuess) {
  expect_left_alone({
      "def planet(float size) { sphere { center: (0, 0, 0), radius: size, material: unlit(red) } "
      "}\n",
      "let a = randomb\"hue\"\n",
      "let a = max(1 2)\n",
      "let a = [1 2]\n",
      "let d = 2\nlet a = (1.4 d, 3)\n",
      "let a = (0 1 2 3)\n",
  });
}

TEST(SafeFixes, AddColonsAndCommasThatAreCertain) {
  EXPECT_EQ(safely("camera main { from: (0 1, 5), at: (0 0 0), fov: 40deg }\n"),
            "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n");
  EXPECT_EQ(safely("let a = diffuse(color: red checker: 2)\n"),
            "let a = diffuse(color: red, checker: 2)\n");
  EXPECT_EQ(safely("sphere { center: (0, 0, 0), radius 1, material: unlit(red) }\n"),
            "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n");
  EXPECT_EQ(safely("def dot(size number) { sphere { center: (0, 0, 0), radius: size } }\n"),
            "def dot(size: number) { sphere { center: (0, 0, 0), radius: size } }\n");
}

TEST(SafeFixes, AddSeparatorsToConfigsWhereNothingElseCanBeMissing) {
  EXPECT_EQ(config_safely(R"({"spheres": [{"radius": 1} {"radius": 2}]})"),
            R"({"spheres": [{"radius": 1}, {"radius": 2}]})");
  EXPECT_EQ(config_safely("{\"camera\": {\"look_at\" [0, 0, 0]\n\"vfov\": 40}}"),
            "{\"camera\": {\"look_at\": [0, 0, 0],\n\"vfov\": 40}}");
  expect_configs_left_alone({R"({"camera": {"look_at": [0 1, 0]}})",
                             R"({"camera": {"look_at" "vfov": 40}})",
                             R"({"camera": {"look_at": [0, 1, 0)}})"});
}

TEST(SafeFixes, AddNoCommaToConfigsByGuess) {
  expect_configs_left_alone({
      "{\"camera\": {\"look_at\": [1,\n 2\n.5, 3]}}",
      "{\"camera\": {\"look_at\": [1,\n 2\n-5, 3]}}",
      "{\"camera\": {\"look_at\": [1,\n 2\n5, 3]}}",
      "{\"camera\": {\"vfov\": 4\n0}}",
      "{\"saving\": {\"path\": \"out\"\n\".png\"}}",
  });
  EXPECT_EQ(config_safely("{\"camera\": {\"vfov\": .5}}"), "{\"camera\": {\"vfov\": 0.5}}");
  EXPECT_EQ(config_safely("{\"spheres\": [{\"radius\": 1}\n{\"origin\": [0, 0, 0]}]}"),
            "{\"spheres\": [{\"radius\": 1},\n{\"origin\": [0, 0, 0]}]}");
}

TEST(SafeFixes, UngroupDigitsOfConfigsOnlyInThrees) {
  expect_configs_left_alone({R"({"camera": {"vfov": 1_5}})", R"({"camera": {"vfov": +1_5}})",
                             R"({"camera": {"vfov": 40_00}})", R"({"camera": {"vfov": 1.5_0}})",
                             R"({"rendering": {"width": 1000_000}})",
                             R"({"rendering": {"width": 1__000}})"});
  EXPECT_EQ(config_safely(R"({"rendering": {"width": 1_920}})"),
            R"({"rendering": {"width": 1920}})");
}

TEST(SafeFixes, TakeSingleQuotesOnlyAroundAWholeText) {
  expect_configs_left_alone(
      {R"({'it''s': 1})", R"({"saving": {"path": 'it''s'}})", R"({"saving": {"path": 'it' 's'}})"});
  EXPECT_EQ(config_safely("{'camera' : {'vfov': 40}}"), "{\"camera\" : {\"vfov\": 40}}");
  EXPECT_EQ(config_safely("{\"saving\": {\"path\": 'a.png'\n}}"),
            "{\"saving\": {\"path\": \"a.png\"\n}}");
}

TEST(SafeFixes, KeepDefinitionsOfOtherLanguages) {
  EXPECT_EQ(safely("#declare R = 3;\n#local S = R;\n"), "let R = 3\nlet S = R\n");
  expect_left_alone({"#define R 3\n", "#include \"shapes.inc\"\n", "#version 3.7;\n"});
  EXPECT_EQ(safely("# a comment\n#\n"), "// a comment\n//\n");
}

TEST(SafeFixes, TakeTypographicQuotesInPairs) {
  EXPECT_EQ(safely("let a = “one”\nlet b = „two“\nlet c = ‘three’\n"),
            "let a = \"one\"\nlet b = \"two\"\nlet c = \"three\"\n");
  EXPECT_EQ(safely("let c = diffuse(color: “#e8e8e8”)\n"), "let c = diffuse(color: #e8e8e8)\n");
  expect_left_alone({"let a = “one\n", "let a = one”\n", "let a = “a \"b\" c”\n"});
}

TEST(SafeFixes, TakeNoColorForANumber) {
  expect_left_alone(
      {"sphere { center: (0, 0, 0), radius: 1, material: unlit(0xff0000) }\n", "let a = 0xfff\n"});
  EXPECT_EQ(safely("let a = 0x10\n"), "let a = 16\n");
  EXPECT_EQ(by_guesses("sphere { center: (0, 0, 0), radius: 1, material: unlit(0xff0000) }\n"),
            "sphere { center: (0, 0, 0), radius: 1, material: unlit(#ff0000) }\n");
  expect_configs_left_alone({R"({"camera": {"vfov": 0xff0000}})"});
}

TEST(SafeFixes, TakeSignsOnlyWithTheirOperands) {
  expect_left_alone({"<!-- x -->\n", "let a = 2 <!-- x -->\n", "let a = 3!\n", "let a = 2 ** 3\n",
                     "let a = 800×600\n", "let a =< 3\n", "let a = 1 <> 2\n", "let a; = 3\n"});
  expect_left_alone({"let a = not!true\n", "let a = 1 ! 2\n"});
  EXPECT_EQ(safely("let a = 1 < 2 && !(2 ≤ 3)\n"), "let a = 1 < 2 and not (2 <= 3)\n");
}

TEST(SafeFixes, LeaveNumbersWithAMissingPartAlone) {
  expect_left_alone({"let a = 0.\n", "let a = (1, 2., 3)\n"});
  expect_configs_left_alone({R"({"camera": {"vfov": 05}})", R"({"camera": {"vfov": 0.}})"});
}

TEST(SafeFixes, LeaveWordsOfConfigsAloneThatMayBeNames) {
  expect_configs_left_alone(
      {R"({"camera": {"vfov": angle}})", R"({"rendering": {"in_parallel": on}})"});
  EXPECT_EQ(config_safely(R"({camera: {'vfov': 40}, "rendering": {"in_parallel": True}})"),
            R"({"camera": {"vfov": 40}, "rendering": {"in_parallel": true}})");
}

TEST(SafeFixes, TakeNoVariableForAUnit) {
  expect_left_alone({"let s = 3\nlet a = 2 s\n", "let a = 2 m d\n"});
  expect_left_alone({"fn f(x,s) = 2 s\n", "fn f( s) = 2 s\n", "fn f(x,\n  s) = 2 s\n",
                     "for  s in [1, 2] { sphere { center: (0, 0, 0), radius: 2 s } }\n",
                     "def d(a ,s ) { sphere { center: (0, 0, 0), radius: 2 s } }\n",
                     "let  m = 3\nlet a = 2 m\n", "param  m = 3\nlet a = 2 m\n"});
  EXPECT_EQ(safely("// m\nlet k = \"m\"\nlet a = (1.5 m, 2m, 3 m)\n"),
            "// m\nlet k = \"m\"\nlet a = (1.5m, 2m, 3m)\n");
  EXPECT_EQ(safely("let a = 2 m\n"), "let a = 2m\n");
}

TEST(SafeFixes, TakeNoWordFromAVariable) {
  expect_left_alone({"let k = \"sobol\"\nrender { sampler: (k) }\n"});
}

TEST(UnsafeFixes, CloseNoFormula) {
  const std::string scene =
      "let i = 2\nlet detail = 4\nlet cell = 1\nlet a = (i - detail / 2 * cell\n";
  EXPECT_EQ(by_guesses(scene), scene);
  const std::string open = "let i = 2\nlet a = i - 1 / 2) * 3\n";
  EXPECT_EQ(by_guesses(open), open);
  EXPECT_EQ(by_guesses("let a = (1, 2, -3\nlet b = 1\n"), "let a = (1, 2, -3)\nlet b = 1\n");
}

TEST(UnsafeFixes, PutNoColorWhereAMaterialBelongs) {
  const std::string scene =
      "def lamp(bulb: material) { sphere { center: (0, 0, 0), radius: 1, material: bulb } }\n"
      "lamp { bulb: cold }\nsphere { center: (5, 0, 0), radius: 1, material: cold }\n";
  EXPECT_EQ(by_guesses(scene), scene);
  const std::string by_default =
      "def lamp(bulb = unlit(red)) { sphere { center: (0, 0, 0), radius: 1, material: bulb } }\n"
      "lamp { bulb: cold }\n";
  EXPECT_EQ(by_guesses(by_default), by_default);
  EXPECT_EQ(by_guesses(
                "let warm = unlit(red)\nsphere { center: (5, 0, 0), radius: 1, material: wram }\n"),
            "let warm = unlit(red)\nsphere { center: (5, 0, 0), radius: 1, material: warm }\n");
}

TEST(UnsafeFixes, AreReported) {
  const FixResult result = fix(
      "a.scene", "scene 1\nsphere { center: (5, 0, 0), radus: 1, material: unlit(red); }\n", true);
  ASSERT_EQ(result.guesses.size(), 1u);
  EXPECT_EQ(result.guesses[0].change, "`radus` to `radius`");
  EXPECT_EQ(result.guesses[0].where, (Position{2, 29}));
  EXPECT_EQ(result.guesses[0].info->code, "E104");
}

// The mechanism, with an artificial check: a text has an error for every `x` and two for every `y`.

class Marked final : public CheckedText {
 public:
  explicit Marked(std::string text) : file_("a.scene", std::move(text)) {
    const std::string_view all = file_.text();
    for (std::uint32_t at = 0; at < all.size(); ++at) {
      const Location where{&file_, {at, at + 1}};
      switch (all[at]) {
        case 'x': sink_.report(diag::bad_utf8, where).fix(where, "."); break;
        case 'h': sink_.report(diag::bad_utf8, where).fix(where, "yy"); break;
        case 'g': sink_.report(diag::bad_utf8, where).unsafe_fix(where, "z"); break;
        case 'z': sink_.report(diag::bad_utf8, where); break;
        case 'y': sink_.report(diag::bad_utf8, where); break;
        case 'a': sink_.report(diag::bad_utf8, where).fix(where, "b"); break;
        case 'b': sink_.report(diag::bad_utf8, where).fix(where, "a"); break;
        default: break;
      }
    }
    findings_ = select_findings(sink_);
  }
  const SourceFile& file() const override { return file_; }
  std::size_t error_count() const override { return sink_.error_count(); }
  const Findings& findings() const override { return findings_; }

 private:
  SourceFile file_;
  DiagnosticSink sink_;
  Findings findings_;
};

FixResult fix_marks(std::string text, bool applies_unsafe = false) {
  const CheckText check = [](std::string fixed) {
    return std::make_unique<Marked>(std::move(fixed));
  };
  return fix_text(check(std::move(text)), applies_unsafe, check);
}
std::string text_of(const FixResult& result) { return std::string(result.checked->file().text()); }

TEST(FixText, LeavesOutTheFixesThatDoHarm) {
  const FixResult result = fix_marks("x x x h x x h x");
  EXPECT_EQ(text_of(result), ". . . h . . h .");
  EXPECT_EQ(result.applied, 6u);
  EXPECT_EQ(result.refused, 2u);
}

TEST(FixText, FindsTheGoodOnesAmongMoreThanAreKept) {
  std::string text(120, 'x');
  for (std::size_t i = 1; i < text.size(); i += 2) text[i] = ' ';
  EXPECT_EQ(text_of(fix_marks(text + " h " + text)).find('x'), std::string::npos);
}

TEST(FixText, GuessesOnlyWhereFewerErrorsAreLeft) {
  const FixResult result = fix_marks("g x g", true);
  EXPECT_EQ(text_of(result), "g . g");
  EXPECT_EQ(result.refused, 2u);
  EXPECT_TRUE(result.guesses.empty());
}

TEST(FixText, EndsWhereFixesUndoEachOther) {
  for (const std::string text : {"a b", "b", "a x"}) {
    const std::string once = text_of(fix_marks(text));
    EXPECT_EQ(text_of(fix_marks(once)), once) << text;
  }
  EXPECT_THAT(text_of(fix_marks("a x")), testing::EndsWith("."));
}

TEST(FixText, LeavesStringsAndCommentsAlone) {
  const FixResult result = fix_marks("x \"x\" /* x */ x // x");
  EXPECT_EQ(text_of(result), ". \"x\" /* x */ . // x");
  EXPECT_EQ(result.refused, 3u);
}

TEST(FixGuard, AllowsToReplaceAStringOrCommentByATextThatContainsIt) {
  const auto keeps = [](std::string_view text, Span span, std::string replacement) {
    return FixGuard(text).keeps_strings_and_comments(
        {{nullptr, span}, std::move(replacement), true});
  };
  EXPECT_TRUE(keeps("a \"red\" b", {2, 7}, "red"));
  EXPECT_FALSE(keeps("a \"red\" b", {2, 7}, "blue"));
  EXPECT_TRUE(keeps("a \"red\" b", {7, 7}, ","));
  EXPECT_TRUE(keeps("a \"red\" b", {2, 2}, ","));
  EXPECT_FALSE(keeps("a \"red\" b", {3, 3}, ","));
  EXPECT_FALSE(keeps("a \"red\" b", {1, 4}, ""));
  EXPECT_FALSE(keeps("a \"red", {6, 6}, ","));
  EXPECT_FALSE(keeps("a // b", {6, 6}, ","));
  EXPECT_TRUE(keeps("a /* b */", {9, 9}, ","));
  EXPECT_FALSE(keeps("a /* b */ c", {0, 11}, ""));
}

}  // namespace
}  // namespace sdlc::lang
