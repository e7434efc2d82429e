#include <algorithm>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/shell_quote.hpp"
#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/replace_all.hpp"
#include "render/image/atomic_file.hpp"

namespace sdlc::cli {

extern const std::string_view kNewScene;  // of new.scene

namespace {

namespace fs = std::filesystem;

/// What the scene's own comments and output call it: a name that needs no quotes anywhere.
std::string plain_name(const fs::path& path) {
  std::string name = path.stem().string();
  std::ranges::replace_if(
      name,
      [](char c) {
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                              (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
        return !is_plain;
      },
      '_');
  return name;
}

struct NewOptions {
  std::string name;
  bool is_quiet = false;
};

ExitCode make_scene(const NewOptions& options, Environment& env) {
  const std::string& name = options.name;
  fs::path path(name);
  if (path.extension() != ".scene") path += ".scene";
  const std::string shown = lang::printable(path.string());
  if (path.stem().empty() || name.ends_with('/')) {
    throw UsageError(fmt::format("`{}` names a folder; name a file", lang::printable(name)));
  }
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(path, ignored))) {
    throw UsageError(fmt::format("`{}` exists already; choose another name", shown));
  }
  // Not render::ParentFolders, which leaves a parent that is a file to the write.
  if (const fs::path folder = path.parent_path(); !folder.empty()) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      throw UsageError(fmt::format("cannot make the folder `{}`: {}",
                                   lang::printable(folder.string()), error.message()));
    }
  }
  const std::string text = lang::replace_all(std::string(kNewScene), "@name@", plain_name(path));
  render::write_file_atomically(path, std::as_bytes(std::span(text)));
  env.out << shown << '\n';
  if (options.is_quiet) return ExitCode::Success;
  const std::string argument = shell_quoted(path.string());
  env.err << fmt::format(
      "Show it while you write it:  sdlc serve {0}\n"
      "Render it:                   sdlc render {0}\n",
      argument);
  return ExitCode::Success;
}

}  // namespace

void add_new_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<NewOptions>();
  Command command = program.add_command("new", "Write a scene to begin with");
  command.add_text("NAME", options->name, "NAME.scene is written; it must not exist").required();
  command.add_flag("--quiet", options->is_quiet, "Only errors on standard error");
  command.footer(
      "Example:\n"
      "  sdlc new ball      writes ball.scene, ready to be rendered, with comments\n"
      "\n"
      "Prints the name of the file.");
  dispatcher.on(command, [options](Environment& env) { return make_scene(*options, env); });
}

}  // namespace sdlc::cli
