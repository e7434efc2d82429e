#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "cli/environment.hpp"
#include "cli/program.hpp"
#include "lang/source/source.hpp"
#include "tests/docs/markdown.hpp"
#include "tests/support/file_test.hpp"
#include "tests/support/folder_lock.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// Runs each code block of the documentation. The words after the opening fence select how; the
// first word is for syntax highlighting (GitHub does not know the language, so it is that of Rust).
//
//   rust scene [NAME FLAG…]
//     a complete file without findings of `sdlc inspect NAME FLAG…`; on the page of a warning, and
//     on that of `sdlc lint`, the command is `sdlc lint`
//   rust scene-part
//     the same without `scene 1`, and without a camera if it needs none
//   rust scene-values
//     lines `expression // result` or `expression // error: message`; text after a `;` is a remark;
//     declarations are visible in the lines below them
//   rust scene-wrong [NAME FLAG…]
//     a file whose mistakes the next block shows
//   rust scene-file NAME
//     a file that others of its section, or of the page, import or include
//   rust scene-unformatted         statements that `sdlc fmt` turns into the next block, a
//   rust scene-formatted           `scene-formatted`; SDLC_UPDATE=1 rewrites that
//   csv data-file NAME             (or `text`)
//     a data file that others import
//   json [config [NAME FLAG…]]
//     a config, treated like `scene`; so are `json config-wrong` and `json config-file`
//   text message [A => B]
//     the complete output about the last file above, after replacing A by B in it; SDLC_UPDATE=1
//     rewrites it
//   text session
//     lines `$ COMMAND`, each followed by its output, run in order in a folder with the files of
//     its section; SDLC_UPDATE=1 rewrites it
//   toml lint
//     a `.sdlc.toml` that `sdlc lint` takes
//   cpp, pbrt, pov or python
//     the same in another language; not run
//   sh
//     lines `sdlc …` that succeed without a word, in a folder with the files of the page that have
//     a NAME; the pictures are made small
//
// ⟦FF⟧ in a file is the byte with that hexadecimal number, ⟦a×9⟧ the letter nine times.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCamera = "camera main { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

struct Page {
  std::string path;
  std::vector<CodeBlock> blocks;
};

/// A block and the page that contains what it needs.
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

std::string kind_of(const CodeBlock& block) {
  const bool is_plain_json = word(block, 0) == "json" && block.words.size() == 1;
  return is_plain_json ? "config" : word(block, 1);
}

/// A block that is a complete text of one of the formats.
bool is_file(const CodeBlock& block) {
  static const std::vector<std::string> kinds{"scene",  "scene-wrong",  "scene-file",  "scene-part",
                                              "config", "config-wrong", "config-file", "data-file"};
  return std::ranges::find(kinds, kind_of(block)) != kinds.end();
}

/// A block of another program's language.
bool is_foreign(const CodeBlock& block) {
  static const std::vector<std::string> languages{"cpp", "pbrt", "pov", "python"};
  return std::ranges::find(languages, word(block, 0)) != languages.end();
}

std::string file_name(const CodeBlock& block) {
  const std::string name = word(block, 2);
  if (!name.empty()) return name;
  return kind_of(block).starts_with("config") ? "config.json" : "page.scene";
}

std::vector<std::string> flags_of(const CodeBlock& block) {
  constexpr std::size_t kFirst = 3;
  const auto count = static_cast<std::ptrdiff_t>(std::min(kFirst, block.words.size()));
  return {block.words.begin() + count, block.words.end()};
}

/// The block with the implied parts added: the version, and a camera, at the end so that line
/// numbers do not change.
std::string complete(std::string text) {
  if (!text.starts_with("scene 1")) text.insert(0, "scene 1\n");
  const bool has_camera = text.find("\ncamera ") != std::string::npos;
  return has_camera ? text : text + std::string(kCamera);
}

/// The named files of a page, those of the example's own section first, and the text of the
/// example.
class PageFiles final : public lang::FileSystem {
 public:
  PageFiles(const Example& example, std::string name, std::string text)
      : example_(example), name_(std::move(name)), text_(std::move(text)) {}

  std::optional<std::string> read(const fs::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    if (path.string() == name_) return text_;
    const CodeBlock* found = nullptr;
    for (const CodeBlock& block : example_.page->blocks) {
      if (!is_file(block) || word(block, 2) != path.string()) continue;
      if (found == nullptr || block.heading == example_.block().heading) found = &block;
    }
    if (found != nullptr) return with_bytes(found->text);
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

 private:
  const Example& example_;
  std::string name_, text_;
};

/// The command for the topic of the page: warnings are found by `lint`, which prints them on
/// standard output.
std::string command_of(const Page& page) {
  const fs::path path = page.path;
  const bool is_of_warning = path.parent_path() == "docs/explain" && path.stem().string()[0] != 'E';
  const bool is_about_lint = path == "docs/lint.md" || is_of_warning;
  return is_about_lint && path.stem() != "README" ? "lint" : "inspect";
}

/// The output of that command for a text.
std::string messages(const Example& example, const std::string& name, const std::string& text,
                     std::span<const std::string> flags = {}) {
  const PageFiles files(example, name, with_bytes(text));
  std::ostringstream out, err;
  lang::Workspace workspace(files);
  cli::Environment env{.workspace = workspace, .out = out, .err = err};
  std::vector<std::string> arguments{command_of(*example.page), name};
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  cli::run_program(arguments, env);
  return arguments.front() == "lint" ? out.str() : err.str();
}

/// The same for a block that is a file.
std::string messages(const Example& example) {
  const CodeBlock& block = example.block();
  return messages(example, file_name(block), block.text, flags_of(block));
}

/// Only the message of the first error or warning.
std::string first_message(const std::string& messages) {
  const std::string line = messages.substr(0, messages.find('\n'));
  const std::size_t behind_code = line.find("]: ");
  return behind_code == std::string::npos ? line : line.substr(behind_code + 3);
}

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
    const std::string told =
        messages(example, "page.scene", complete(declarations + "let it = " + expression + "\n"));
    EXPECT_EQ(first_message(told), result.substr(kError.size())) << line;
    return;
  }
  const std::string claimed = "assert (" + expression + ") == (" + result + "), \"it is not\"\n";
  EXPECT_EQ(messages(example, "page.scene", complete(declarations + claimed)), "") << line;
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

void update(const Example& example, const std::string& text) {
  const fs::path path = fs::path(SDLC_SOURCE_DIR) / example.page->path;
  const FolderLock lock(path.parent_path());
  write_text(path, replace_code_block(content_of(path), example.index, text));
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
  if (kind_of(file) == "scene-part") text = complete(text);
  const std::string told = messages(example, file_name(file), text, flags_of(file));
  if (std::getenv("SDLC_UPDATE") != nullptr) return update(example, told);
  EXPECT_EQ(told, example.block().text) << "SDLC_UPDATE=1 rewrites it.";
}

/// The result of `sdlc fmt` for statements.
std::string formatted(const Example& example, const std::string& statements) {
  constexpr std::string_view kVersion = "scene 1\n";
  const PageFiles files(example, "-", std::string(kVersion) + statements);
  std::ostringstream out, err;
  lang::Workspace workspace(files);
  cli::Environment env{.workspace = workspace, .out = out, .err = err};
  cli::run_program(std::vector<std::string>{"fmt", "-"}, env);
  EXPECT_EQ(err.str(), "");
  return out.str().substr(std::min(kVersion.size(), out.str().size()));
}

void check_formatted(const Example& example) {
  const std::string& text = example.block().text;
  ASSERT_GT(example.index, 0u);
  const CodeBlock& before = example.page->blocks[example.index - 1];
  ASSERT_EQ(kind_of(before), "scene-unformatted");
  const std::string outcome = formatted(example, before.text);
  if (std::getenv("SDLC_UPDATE") != nullptr) return update(example, outcome);
  EXPECT_EQ(outcome, text) << "SDLC_UPDATE=1 rewrites it.";
}

/// The command with the real program, and a small picture unless it sets the size.
std::string small_command(const std::string& line) {
  std::string command = "\"$SDLC\"" + line.substr(line.find(' '));
  command = command.substr(0, command.find(" #"));
  for (const auto& [flag, value] : {std::pair("--width", "16"), std::pair("--samples", "1")}) {
    if (command.find(flag) == std::string::npos) command += std::string(" ") + flag + " " + value;
  }
  return command + " --quiet";
}

void check_settings(const Example& example) {
  const TemporaryFolder folder;
  write_text(folder / ".sdlc.toml", example.block().text);
  write_text(folder / "page.scene", complete(""));
  const ProgramResult result = run_shell(folder.path(), "\"$SDLC\" lint page.scene --quiet");
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

/// Writes the named files of the page, or of the example's own section.
void write_files(const Example& example, bool of_page, const TemporaryFolder& folder) {
  for (const CodeBlock& block : example.page->blocks) {
    const bool is_near = of_page || block.heading == example.block().heading;
    if (!is_file(block) || word(block, 2).empty() || !is_near) continue;
    fs::create_directories((folder / word(block, 2)).parent_path());
    write_text(folder / word(block, 2), with_bytes(block.text));
  }
}

void check_session(const Example& example) {
  const TemporaryFolder folder;
  write_files(example, false, folder);
  std::string session;
  std::istringstream lines(example.block().text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("$ ")) continue;
    const std::string command = line.substr(2);
    const bool is_ours = command.starts_with("sdlc ");
    const ProgramResult result = run_shell(
        folder.path(), "( " + (is_ours ? "\"$SDLC\"" + command.substr(4) : command) + " ) 2>&1");
    session += line + "\n" + result.out;
  }
  if (std::getenv("SDLC_UPDATE") != nullptr) return update(example, session);
  EXPECT_EQ(session, example.block().text) << "SDLC_UPDATE=1 rewrites it.";
}

void check_commands(const Example& example) {
  const TemporaryFolder folder;
  write_files(example, true, folder);
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
  const std::string kind = kind_of(block);
  if (kind == "scene" || kind == "config") {
    EXPECT_EQ(messages(example), "");
  } else if (kind == "scene-part") {
    EXPECT_EQ(messages(example, "page.scene", complete(block.text)), "");
  } else if (kind == "scene-values") {
    check_values(example);
  } else if (kind == "scene-wrong" || kind == "config-wrong") {
    ASSERT_LT(example.index + 1, example.page->blocks.size());
    const std::string next = kind_of(example.page->blocks[example.index + 1]);
    EXPECT_TRUE(next == "message" || next == "session") << next;
  } else if (kind == "scene-file" || kind == "config-file" || kind == "data-file") {
    EXPECT_NE(word(block, 2), "");
  } else if (kind == "scene-unformatted") {
    ASSERT_LT(example.index + 1, example.page->blocks.size());
    EXPECT_EQ(kind_of(example.page->blocks[example.index + 1]), "scene-formatted");
  } else if (kind == "scene-formatted") {
    check_formatted(example);
  } else if (kind == "message") {
    check_message(example);
  } else if (kind == "session") {
    check_session(example);
  } else if (word(block, 0) == "toml") {
    check_settings(example);
  } else if (word(block, 0) == "sh") {
    check_commands(example);
  } else if (!is_foreign(block)) {
    FAIL() << "the kind of this block is unknown";
  }
}

/// The page, its heading and the number of the block in the section.
std::string test_name(const Page& page, const CodeBlock& block, int ordinal) {
  std::string name;
  for (const char c : fs::path(page.path).stem().string() + " " + block.heading) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (is_plain || (!name.empty() && name.back() != '_')) name += is_plain ? c : '_';
  }
  if (name.back() != '_') name += '_';
  return name + std::to_string(ordinal);
}

/// Every page whose blocks are run, relative to the root of the repository.
std::vector<std::string> page_paths() {
  const fs::path root = SDLC_SOURCE_DIR;
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(root / "docs/explain")) {
    paths.push_back(fs::relative(entry.path(), root).string());
  }
  std::ranges::sort(paths);
  paths.insert(paths.begin(),
               {"README.md", "docs/language.md", "docs/mistakes.md", "docs/json-config.md",
                "docs/format.md", "docs/convert.md", "docs/lint.md", "docs/aov.md",
                "docs/compare.md", "docs/coming-from-blender.md", "docs/coming-from-one-weekend.md",
                "docs/coming-from-pbrt.md", "docs/coming-from-povray.md"});
  return paths;
}

std::vector<Example> examples() {
  static const std::vector<Page> pages = [] {
    std::vector<Page> all;
    for (const std::string& path : page_paths()) {
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
