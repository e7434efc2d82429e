#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/diagnostics/render.hpp"
#include "lang/source/source.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// What the documentation shows is true: each block of code of a page is run. What stands behind its
// opening fence says how; the first word is for those who colour it (GitHub has no colours for the
// language, and takes those of Rust).
//
//   rust scene [NAME]        a complete file, which compiles without a word
//   rust scene-part          the same without `scene 1`, and without a camera if it needs none
//   rust scene-values        lines `expression // result` or `expression // error: message`;
//                            behind a `;` is what the reader is told; declarations hold for the
//                            lines below them
//   rust scene-wrong [NAME]  a file whose mistakes the next block shows
//   rust scene-file NAME     a file that others of the page import or include
//   json                     a config, which compiles without a word
//   text message [A => B]    all that is printed about the last file above, once B has taken the
//                            place of A in it
//   sh                       lines `sdlc …` that succeed without a word, in a folder with the files
//                            of the page that have a NAME; the pictures are made small
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCamera = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

struct Page {
  std::string path;
  std::vector<CodeBlock> blocks;
};

/// A block and where to look for what it needs.
struct Example {
  const Page* page;
  std::size_t index;
  std::string name;

  const CodeBlock& block() const { return page->blocks[index]; }
};

void PrintTo(const Example& example, std::ostream* out) {
  *out << example.page->path << ", line " << example.block().line;
}

std::string word(const CodeBlock& block, std::size_t i) {
  return i < block.words.size() ? block.words[i] : std::string();
}

/// A block that is a text of the language by itself.
bool is_file(const CodeBlock& block) {
  const std::string kind = word(block, 1);
  return kind == "scene" || kind == "scene-wrong" || kind == "scene-file" || kind == "scene-part";
}

std::string file_name(const CodeBlock& block) {
  const std::string name = word(block, 2);
  return name.empty() ? "page.scene" : name;
}

/// The block with what a reader adds in his head: the version, and a camera, at the end so that no
/// line changes its number.
std::string complete(std::string text) {
  if (!text.starts_with("scene 1")) text.insert(0, "scene 1\n");
  const bool has_camera = text.find("\ncamera ") != std::string::npos;
  return has_camera ? text : text + std::string(kCamera);
}

/// The named files of a page.
class PageFiles final : public lang::FileSystem {
 public:
  explicit PageFiles(const Page& page) : page_(page) {}

  std::optional<std::string> read(const fs::path& path, std::error_code& error) const override {
    for (const CodeBlock& block : page_.blocks) {
      if (is_file(block) && word(block, 2) == path.string()) return block.text;
    }
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  const Page& page_;
};

/// What is reported of one text.
class Compiled {
 public:
  Compiled(const Page& page, std::string name, std::string text)
      : files_(page), file_(std::move(name), std::move(text)) {
    lang::ProgramOptions options;
    options.files = &files_;
    compiler_.emplace(file_, options, sink_);
    compiler_->animation();
    compiler_->lower({});
  }

  /// As the program prints it; empty where there is nothing to say.
  std::string messages() const {
    return sink_.diagnostics().empty() ? "" : lang::render_diagnostics(sink_, {});
  }
  /// The first error alone.
  std::string first_message() const {
    return sink_.diagnostics().empty() ? "" : sink_.sorted().front()->message;
  }

 private:
  PageFiles files_;
  lang::SourceFile file_;
  lang::DiagnosticSink sink_;
  std::optional<lang::Compiler> compiler_;
};

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \n");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" \n") + 1 - begin));
}

/// `expression // result; remark`
void check_value(const Example& example, const std::string& declarations, const std::string& line) {
  const std::size_t comment = line.find("//");
  ASSERT_NE(comment, std::string::npos) << "no result is stated: " << line;
  const std::string expression = trimmed(line.substr(0, comment));
  const std::string claim = line.substr(comment + 2);
  const std::string result = trimmed(claim.substr(0, claim.find(';')));
  constexpr std::string_view kError = "error: ";
  if (result.starts_with(kError)) {
    const Compiled compiled(*example.page, "page.scene",
                            complete(declarations + "let it = " + expression + "\n"));
    EXPECT_EQ(compiled.first_message(), result.substr(kError.size())) << line;
    return;
  }
  const Compiled compiled(
      *example.page, "page.scene",
      complete(declarations + "assert (" + expression + ") == (" + result + "), \"it is not\"\n"));
  EXPECT_EQ(compiled.messages(), "") << line;
}

bool is_declaration(const std::string& line) {
  return line.starts_with("let ") || line.starts_with("fn ") || line.starts_with("param ");
}

void check_values(const Example& example) {
  std::string declarations;
  std::istringstream lines(example.block().text);
  for (std::string line; std::getline(lines, line);) {
    if (is_declaration(line)) {
      declarations += line + "\n";
    } else if (!trimmed(line).empty() && !line.starts_with("//")) {
      check_value(example, declarations, line);
    }
  }
}

void check_message(const Example& example) {
  std::size_t index = example.index;
  while (index > 0 && !is_file(example.page->blocks[index])) --index;
  const CodeBlock& file = example.page->blocks[index];
  ASSERT_TRUE(is_file(file)) << "there is no file above";

  std::string text = file.text;
  const std::vector<std::string>& words = example.block().words;
  std::string from, to;
  bool is_behind = false;
  for (std::size_t i = 2; i < words.size(); ++i) {
    std::string& part = is_behind ? to : from;
    if (words[i] == "=>") {
      is_behind = true;
    } else {
      part += (part.empty() ? "" : " ") + words[i];
    }
  }
  if (!from.empty()) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
  }
  EXPECT_EQ(Compiled(*example.page, file_name(file), complete(text)).messages(),
            example.block().text);
}

/// The command with the real program and a small picture where it does not say how large.
std::string small_command(const std::string& line) {
  std::string command = "\"$SDLC\"" + line.substr(line.find(' '));
  command = command.substr(0, command.find(" #"));
  for (const auto& [flag, value] : {std::pair("--width", "16"), std::pair("--samples", "1")}) {
    if (command.find(flag) == std::string::npos) command += std::string(" ") + flag + " " + value;
  }
  return command + " --quiet";
}

void check_commands(const Example& example) {
  const TemporaryFolder folder;
  for (const CodeBlock& block : example.page->blocks) {
    if (is_file(block) && !word(block, 2).empty()) {
      fs::create_directories((folder / word(block, 2)).parent_path());
      write_text(folder / word(block, 2), block.text);
    }
  }
  std::istringstream lines(example.block().text);
  for (std::string line; std::getline(lines, line);) {
    ASSERT_TRUE(line.starts_with("sdlc ")) << line;
    const ProgramResult result = run_shell(folder.path(), small_command(line));
    EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.err;
    EXPECT_EQ(result.err, "") << line;
  }
}

void check(const Example& example) {
  const CodeBlock& block = example.block();
  const std::string language = word(block, 0), kind = word(block, 1);
  if (language == "json") {
    EXPECT_EQ(Compiled(*example.page, "config.json", block.text).messages(), "");
  } else if (kind == "scene") {
    EXPECT_EQ(Compiled(*example.page, file_name(block), block.text).messages(), "");
  } else if (kind == "scene-part") {
    EXPECT_EQ(Compiled(*example.page, "page.scene", complete(block.text)).messages(), "");
  } else if (kind == "scene-values") {
    check_values(example);
  } else if (kind == "scene-wrong") {
    ASSERT_LT(example.index + 1, example.page->blocks.size());
    EXPECT_EQ(word(example.page->blocks[example.index + 1], 1), "message");
  } else if (kind == "scene-file") {
    EXPECT_NE(word(block, 2), "");
  } else if (kind == "message") {
    check_message(example);
  } else if (language == "sh") {
    check_commands(example);
  } else {
    FAIL() << "nobody says what this block is";
  }
}

/// The page, its heading and which block of the section it is.
std::string test_name(const Page& page, const CodeBlock& block, int ordinal) {
  std::string name;
  for (const char c : fs::path(page.path).stem().string() + " " + block.heading) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain || (!name.empty() && name.back() != '_')) name += is_plain ? c : '_';
  }
  if (name.back() != '_') name += '_';
  return name + std::to_string(ordinal);
}

std::vector<Example> examples() {
  static const std::vector<Page> pages = [] {
    std::vector<Page> all;
    for (const char* path : {"README.md", "docs/language.md", "docs/json-config.md"}) {
      all.push_back({path, code_blocks_of(content_of(fs::path(SDLC_SOURCE_DIR) / path))});
    }
    return all;
  }();
  std::vector<Example> result;
  for (const Page& page : pages) {
    std::map<std::string, int> ordinals;
    for (std::size_t i = 0; i < page.blocks.size(); ++i) {
      const CodeBlock& block = page.blocks[i];
      result.push_back({&page, i, test_name(page, block, ++ordinals[block.heading])});
    }
  }
  return result;
}

class Documentation : public testing::TestWithParam<Example> {};

TEST_P(Documentation, IsTrue) { check(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Blocks, Documentation, testing::ValuesIn(examples()),
                         [](const auto& example) { return example.param.name; });

}  // namespace
}  // namespace sdlc::test
