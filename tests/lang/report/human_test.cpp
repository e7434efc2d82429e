#include <string>

#include <gtest/gtest.h>

#include "lang/report/report.hpp"

namespace sdlc::lang {
namespace {

Span span_of(const SourceFile& file, std::string_view part) {
  const auto begin = static_cast<std::uint32_t>(file.text().find(part));
  return {begin, begin + static_cast<std::uint32_t>(part.size())};
}

/// The output for the mistake `part` of the text, from the gutter on, without the summary.
std::string excerpt(const std::string& text, std::string_view part) {
  const SourceFile file("a.scene", text);
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&file, span_of(file, part)});
  const std::string all = render_diagnostics(sink, {});
  const std::size_t begin = all.find(" |\n") - 1;
  return all.substr(begin, all.find("\n\n") + 1 - begin);
}

TEST(RenderHuman, ShowsMessagePlaceLineAndHelp) {
  const SourceFile file("a.scene", "scene 1\n\n\n\n\n\n\n\n\nsphere { radus: 1 }\n");
  DiagnosticSink sink;
  sink.report(diag::unknown_property, {&file, span_of(file, "radus")}, "radus", "sphere")
      .suggest("radius")
      .help("a sphere has center, radius and material");
  EXPECT_EQ(render_diagnostics(sink, {}), R"(error[E104]: unknown property `radus` of sphere
  --> a.scene:10:10
   |
10 | sphere { radus: 1 }
   |          ^^^^^
   = help: did you mean `radius`?
   = help: a sphere has center, radius and material

1 error
)");
}

TEST(RenderHuman, PutsLabelsOnTheirLines) {
  const SourceFile file("a.scene", "radius: 1\ncenter: 2\n# three\n# four\nradius: 3\n");
  DiagnosticSink sink;
  const auto second = static_cast<std::uint32_t>(file.text().rfind("radius"));
  sink.report(diag::duplicate, {&file, {second, second + 6}}, "property", "radius")
      .label({&file, {0, 6}}, "it is given here first");
  EXPECT_EQ(render_diagnostics(sink, {}), R"(error[E106]: property `radius` is given twice
 --> a.scene:5:1
  |
1 | radius: 1
  | ------ it is given here first
...
5 | radius: 3
  | ^^^^^^

1 error
)");
}

TEST(RenderHuman, StacksLabelsOfOneLine) {
  const SourceFile file("a.scene", "one two three\n");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&file, span_of(file, "two")})
      .label({&file, span_of(file, "one")}, "first")
      .label({&file, span_of(file, "three")}, "last");
  EXPECT_EQ(render_diagnostics(sink, {}), R"(error[E007]: the text is not valid UTF-8 here
 --> a.scene:1:5
  |
1 | one two three
  | --- ^^^ ----- last
  | first

1 error
)");
}

TEST(RenderHuman, ShowsLabelsInOtherFiles) {
  const SourceFile file("a.scene", "here\n"), other("b.scene", "\nthere\n");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&file, {0, 4}}).label({&other, {1, 6}}, "and there");
  EXPECT_EQ(render_diagnostics(sink, {}), R"(error[E007]: the text is not valid UTF-8 here
 --> a.scene:1:1
  |
1 | here
  | ^^^^
 ::: b.scene:2:1
  |
2 | there
  | ----- and there

1 error
)");
}

TEST(RenderHuman, CaretsStandUnderTabs) {
  EXPECT_EQ(excerpt("\t\"x\":\tq\n", "q"), R"(  |
1 |     "x":    q
  |             ^
)");
}

TEST(RenderHuman, CaretsStandUnderWideAndCombiningCharacters) {
  EXPECT_EQ(excerpt("日本 q\n", "q"), "  |\n1 | 日本 q\n  |      ^\n");
  EXPECT_EQ(excerpt("日本 q\n", "本"), "  |\n1 | 日本 q\n  |   ^^\n");
  EXPECT_EQ(excerpt("e\u0301e\u0301 q\n", "q"), "  |\n1 | e\u0301e\u0301 q\n  |    ^\n");
  EXPECT_EQ(excerpt("ae\u0301 q\n", "\u0301"), "  |\n1 | ae\u0301 q\n  |  ^\n");
  EXPECT_EQ(excerpt("😀 q\n", "q"), "  |\n1 | 😀 q\n  |    ^\n");
}

TEST(RenderHuman, ShortensLongLines) {
  const std::string shown = excerpt(std::string(500, 'a') + "q" + std::string(500, 'b'), "q");
  EXPECT_EQ(shown, "  |\n1 | …" + std::string(40, 'a') + "q" + std::string(59, 'b') + "…\n  | " +
                       std::string(41, ' ') + "^\n");
}

TEST(RenderHuman, ShowsTheFirstAndTheLastOfManyLines) {
  EXPECT_EQ(excerpt("a (b\nc\n  d) e\n", "(b\nc\n  d)"), R"(  |
1 | a (b
  |   ^^
...
3 |   d) e
  |   ^^
)");
}

TEST(RenderHuman, PointsAfterTheEnd) {
  EXPECT_EQ(excerpt("abc", ""), "  |\n1 | abc\n  | ^\n");
  const SourceFile file("a.scene", "abc\n");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&file, {4, 4}});
  EXPECT_NE(render_diagnostics(sink, {}).find("2 |\n  | ^\n"), std::string::npos);
}

TEST(RenderHuman, ShowsWhatToWrite) {
  const SourceFile file("a.json", "x, .5\n");
  DiagnosticSink sink;
  const Location number{&file, span_of(file, ".5")};
  sink.report(diag::bad_utf8, number).fix(number, "0.5");
  sink.report(diag::unknown_name, number, "a").fix({&file, span_of(file, ",")}, "");
  sink.report(diag::unknown_name, number, "b")
      .fix({&file, {number.span.end, number.span.end}}, "deg");
  sink.report(diag::unknown_name, number, "c").fix({&file, {0, 0}}, "scene 1\n");
  const std::string text = render_diagnostics(sink, {});
  for (const char* help : {"help: write `0.5` instead of `.5`\n", "help: remove `,`\n",
                           "help: add `deg` after `.5`\n", "help: add `scene 1` at 1:1\n"}) {
    EXPECT_NE(text.find(help), std::string::npos) << help << text;
  }
}

TEST(RenderHuman, ShowsTheChain) {
  const SourceFile file("a.scene", "ring { }\nx\n");
  DiagnosticSink sink;
  sink.report(diag::bad_utf8, {&file, {9, 10}})
      .chain({{.where = {&file, {0, 4}}, .message = "in `ring`"}});
  EXPECT_NE(render_diagnostics(sink, {}).find("  = in `ring`, a.scene:1:1\n"), std::string::npos);
}

TEST(RenderHuman, CountsErrorsAndWarnings) {
  const SourceFile file("a.json", "x\n");
  DiagnosticSink sink;
  for (int i = 0; i < 51; ++i) {
    sink.report(diag::unknown_name, {&file, {0, 1}}, std::to_string(i));
  }
  sink.report(diag::zero_radius, {&file, {0, 1}});
  EXPECT_TRUE(
      render_diagnostics(sink, {}).ends_with("\n51 errors, 1 warning (1 of them not shown)\n"));
}

TEST(RenderHuman, NeedsNoFile) {
  DiagnosticSink sink;
  sink.report(diag::zero_radius, {});
  EXPECT_EQ(render_diagnostics(sink, {}),
            "warning[W402]: a sphere of radius 0 is never visible\n\n1 warning\n");
}

TEST(RenderHuman, ShowsWhatAFixChangesWhereBothLookAlike) {
  struct Case {
    const char* text;
    const char* replacement;
    const char* help;
  };
  const std::string end(70, 'z');
  const std::string longer = end + "y";
  for (const auto& [text, replacement, help] :
       {Case{"-", "- ", "add a space at 1:2"}, Case{"a b", "a  b", "instead of `a b`"},
        Case{"\u2212", "-", "write `-` instead of `\u2212` (U+2212)"},
        Case{"\u00a0", " ", "write a space instead"}, Case{"  ", "", "remove 2 spaces"},
        Case{"a\nb", "a\nc", "write `c` instead of `b`"},
        Case{end.c_str(), longer.c_str(), "add `y` at 1:71"}}) {
    const SourceFile file("a.scene", std::string(text) + "\n");
    DiagnosticSink sink;
    const Location all{&file, {0, static_cast<std::uint32_t>(std::string_view(text).size())}};
    sink.report(diag::bad_utf8, {&file, {0, 0}}).fix(all, replacement);
    EXPECT_NE(render_diagnostics(sink, {}).find(help), std::string::npos)
        << render_diagnostics(sink, {});
  }
}

TEST(RenderHuman, ColoursOnlyWhenAsked) {
  const SourceFile file("a\x1b.json", "\x1b[2J\n");
  DiagnosticSink sink;
  sink.report(diag::bad_string, {&file, {0, 1}}, "\x1b[2J");
  EXPECT_EQ(render_diagnostics(sink, {}).find('\x1b'), std::string::npos);
  const std::string colored = render_diagnostics(sink, {.color = true});
  EXPECT_NE(colored.find("\x1b[1;31merror[E005]\x1b[0m"), std::string::npos);
  EXPECT_EQ(colored.find("\x1b[2J"), std::string::npos);
}

}  // namespace
}  // namespace sdlc::lang
