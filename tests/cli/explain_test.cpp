#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/environment.hpp"
#include "cli/program.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"

namespace sdlc::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class NoFiles final : public lang::FileSystem {
 public:
  std::optional<std::string> read(const std::filesystem::path& /*path*/, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }
};

struct Explained {
  cli::ExitCode code;
  std::string out, err;
};

Explained explain(std::vector<std::string> arguments, bool is_terminal = false,
                  bool no_color = false) {
  const NoFiles files;
  lang::Workspace workspace(files);
  std::ostringstream out, err;
  cli::Environment env{.workspace = workspace,
                       .out = out,
                       .err = err,
                       .out_is_terminal = is_terminal,
                       .no_color = no_color};
  arguments.insert(arguments.begin(), "explain");
  const cli::ExitCode code = cli::run_program(arguments, env);
  return {.code = code, .out = out.str(), .err = err.str()};
}

TEST(ExplainCommand, ShowsThePageOfACode) {
  const Explained told = explain({"E104"});
  EXPECT_EQ(told.code, cli::ExitCode::Success);
  EXPECT_EQ(told.err, "");
  EXPECT_THAT(told.out, StartsWith("E104: unknown property\n\n"));
  EXPECT_THAT(told.out, HasSubstr("\nWrong\n\nball.scene:\n\n    scene 1\n    camera main"));
  EXPECT_THAT(told.out, HasSubstr("\nsdlc reports:\n\n    error[E104]: unknown property `radus`"));
  EXPECT_THAT(told.out, HasSubstr("\nRight\n"));
  EXPECT_THAT(told.out, AllOf(Not(HasSubstr("```")), Not(HasSubstr("](")), Not(HasSubstr("## "))));
}

TEST(ExplainCommand, TakesCodesInAnyCaseAndNames) {
  const std::string page = explain({"E104"}).out;
  for (const char* topic :
       {"e104", "unknown_property", "unknown property", "Unknown-Property", "UNKNOWN_PROPERTY"}) {
    EXPECT_EQ(explain({topic}).out, page) << topic;
  }
}

TEST(ExplainCommand, ShowsSeveralPages) {
  EXPECT_EQ(explain({"E104", "W401"}).out, explain({"E104"}).out + "\n" + explain({"W401"}).out);
}

TEST(ExplainCommand, ShowsTheFlagsOfAnExample) {
  EXPECT_THAT(explain({"E122"}).out, HasSubstr("row.scene, with --set cuont=5:\n"));
}

TEST(ExplainCommand, KeepsTextToEightyColumns) {
  std::istringstream page(explain({"E101"}).out);
  for (std::string line; std::getline(page, line) && line != "Wrong";) {
    EXPECT_LE(line.size(), 82u) << line;  // in bytes
  }
}

TEST(ExplainCommand, ListsTheCodesThatBeginSo) {
  const Explained told = explain({"w4"});
  EXPECT_THAT(told.out, StartsWith("The picture will not be as intended\n  W401  "));
  EXPECT_THAT(told.out, AllOf(HasSubstr("  W402  zero radius\n"), Not(HasSubstr("E104"))));
}

TEST(ExplainCommand, ListsAllCodesWhenItIsAskedForNone) {
  const std::string list = explain({}).out;
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
    EXPECT_THAT(list, HasSubstr("  " + std::string(info->code) + "  "));
  }
  EXPECT_THAT(list, AllOf(StartsWith("Syntax\n  E001  expected\n"), HasSubstr("\n\nNames\n")));
}

TEST(ExplainCommand, RefusesACodeThatIsNone) {
  const Explained told = explain({"E104", "E1044"});
  EXPECT_EQ(told.code, cli::ExitCode::Usage);
  EXPECT_EQ(told.out, "");
  EXPECT_EQ(told.err,
            "error: unknown diagnostic `E1044` (did you mean `E104`?); `sdlc explain` lists all\n");
  EXPECT_THAT(explain({"unknown_proprety"}).err, HasSubstr("did you mean `unknown_property`?"));
  EXPECT_THAT(explain({"\x1b[31m"}).err, Not(HasSubstr("\x1b")));
}

TEST(ExplainCommand, IsBoldOnATerminalOnly) {
  EXPECT_THAT(explain({"E104"}).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(explain({"E104"}, true).out, StartsWith("\x1b[1mE104: unknown property\x1b[0m\n"));
  EXPECT_THAT(explain({}, true).out, StartsWith("\x1b[1mSyntax\x1b[0m\n"));
  EXPECT_THAT(explain({"E104"}, true, true).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(explain({"E104", "--color", "never"}, true).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(explain({"E104", "--color", "always"}).out, HasSubstr("\x1b[1m"));
}

TEST(ExplainCommand, PrintsJsonForPrograms) {
  const auto json = nlohmann::json::parse(explain({"E104", "W4", "--format", "json"}).out);
  ASSERT_GT(json.size(), 2u);
  EXPECT_EQ(json[0]["code"], "E104");
  EXPECT_EQ(json[0]["name"], "unknown_property");
  EXPECT_EQ(json[0]["severity"], "error");
  EXPECT_THAT(json[0]["page"].get<std::string>(), StartsWith("# E104: unknown property\n"));
  EXPECT_EQ(json[1]["severity"], "warning");
}

TEST(ExplainCommand, PrintsALineACodeWhenItIsConcise) {
  EXPECT_EQ(explain({"E104", "W402", "--format", "concise"}).out,
            "E104: unknown property\nW402: zero radius\n");
}

}  // namespace
}  // namespace sdlc::test
