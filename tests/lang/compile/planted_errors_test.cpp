#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

// Realistic files with several planted mistakes each. EXPECTED lists the ideal reports: every
// mistake once, on its line, and nothing else.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

const fs::path& folder() {
  static const fs::path path = fs::path(SDLC_SOURCE_DIR) / "tests/files/planted";
  return path;
}

/// One mistake. If two reports are equally good, either is accepted.
struct Planted {
  std::vector<std::uint32_t> lines;
  std::vector<std::string> codes;
  std::string text;  ///< the line of EXPECTED
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The mistakes planted in each file: lines of EXPECTED such as `stairs.scene:9|18 E017|E004`.
const std::map<std::string, std::vector<Planted>>& planted() {
  static const auto all = [] {
    std::map<std::string, std::vector<Planted>> by_file;
    std::ifstream stream(folder() / "EXPECTED");
    for (std::string text; std::getline(stream, text);) {
      const std::size_t colon = text.find(':');
      const std::size_t blank = text.find(' ', colon);
      Planted mistake{{}, split(text.substr(blank + 1), '|'), text};
      for (const std::string& line : split(text.substr(colon + 1, blank - colon - 1), '|')) {
        std::uint32_t number = 0;
        std::from_chars(line.data(), line.data() + line.size(), number);
        mistake.lines.push_back(number);
      }
      by_file[text.substr(0, colon)].push_back(std::move(mistake));
    }
    return by_file;
  }();
  return all;
}

std::vector<std::string> inputs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder())) {
    const fs::path extension = entry.path().extension();
    if (extension == ".scene" || extension == ".json") {
      names.push_back(entry.path().filename().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

struct Told {
  std::uint32_t line = 0;
  std::string code, message;
};

std::vector<Told> check(const lang::Document& file) {
  static const lang::DiskFileSystem files;
  lang::Workspace workspace(files);
  lang::DiagnosticSink sink;
  lang::Compiler compiler(
      file, {.workspace = &workspace, .limits = {}, .is_sandboxed = false, .sets = {}}, sink);
  compiler.check();
  std::vector<Told> all;
  for (const lang::Diagnostic& diagnostic : sink.diagnostics()) {
    const lang::Location where = diagnostic.where;
    const std::uint32_t line =
        where.file == nullptr ? 0 : where.file->position(where.span.begin).line;
    all.push_back({line, std::string(diagnostic.info->code), diagnostic.message});
  }
  return all;
}

bool fits(const Planted& mistake, const Told& told) {
  return std::ranges::count(mistake.lines, told.line) != 0 &&
         std::ranges::count(mistake.codes, told.code) != 0;
}

/// Bipartite matching by augmenting paths: assigns a report to each planted mistake if possible.
/// `owner` holds the planted mistake of each report.
bool give(std::size_t mistake, const std::vector<Planted>& all, const std::vector<Told>& told,
          std::vector<std::optional<std::size_t>>& owner, std::vector<bool>& is_tried) {
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (is_tried[i] || !fits(all[mistake], told[i])) continue;
    is_tried[i] = true;
    if (!owner[i] || give(*owner[i], all, told, owner, is_tried)) {
      owner[i] = mistake;
      return true;
    }
  }
  return false;
}

class PlantedErrors : public testing::TestWithParam<std::string> {};

TEST_P(PlantedErrors, AreToldOnceEach) {
  const fs::path path = folder() / GetParam();
  std::error_code error;
  const auto text = lang::DiskFileSystem().read(path, lang::Limits().any_file(), error);
  ASSERT_TRUE(text) << error.message();
  const lang::Document file(path.string(), *text);
  const auto found = planted().find(GetParam());
  const std::vector<Planted> mistakes =
      found == planted().end() ? std::vector<Planted>() : found->second;

  const std::vector<Told> told = check(file);
  std::vector<std::optional<std::size_t>> owner(told.size());
  std::string differences;
  const auto source_line = [&](std::uint32_t line) {
    return line == 0 || line > file.line_count() ? std::string_view() : file.line(line);
  };
  for (std::size_t i = 0; i < mistakes.size(); ++i) {
    std::vector<bool> is_tried(told.size());
    if (give(i, mistakes, told, owner, is_tried)) continue;
    differences += fmt::format("  missing {}\n          {}\n", mistakes[i].text,
                               source_line(mistakes[i].lines.front()));
  }
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (owner[i]) continue;
    differences += fmt::format("  surplus {}:{} {} {}\n          {}\n", GetParam(), told[i].line,
                               told[i].code, told[i].message, source_line(told[i].line));
  }
  EXPECT_TRUE(differences.empty()) << differences;
}

TEST(PlantedErrorsList, SpeaksOfFilesThatAreThere) {
  for (const auto& [name, mistakes] : planted()) EXPECT_TRUE(fs::exists(folder() / name)) << name;
}

/// The file's name, restricted to characters allowed in test names.
struct InputName {
  std::string operator()(const testing::TestParamInfo<std::string>& input) const {
    std::string name = input.param;
    const auto is_foreign = [](unsigned char c) { return std::isalnum(c) == 0; };
    std::ranges::replace_if(name, is_foreign, '_');
    return name;
  }
};
INSTANTIATE_TEST_SUITE_P(Files, PlantedErrors, testing::ValuesIn(inputs()), InputName());

}  // namespace
}  // namespace sdlc::test
