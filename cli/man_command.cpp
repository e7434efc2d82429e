#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/usage_error.hpp"
#include "cli/version.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::cli {
namespace {

// The macros: man(7).

/// Text as roff takes it.
std::string roff(std::string_view text) {
  std::string escaped;
  bool is_line_start = true;
  for (const char c : text) {
    if (is_line_start && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '\\') {
      escaped += "\\e";
    } else if (c == '-') {
      escaped += "\\-";
    } else {
      escaped += c;
    }
    is_line_start = c == '\n';
  }
  return escaped;
}

std::string section(std::string_view title) { return fmt::format(".SH {}\n", title); }

/// Lines as they are.
std::string block(std::string_view text) { return fmt::format(".nf\n{}\n.fi\n", roff(text)); }

std::string option_text(const OptionInfo& option) {
  std::string names;
  for (const std::string& name : option.names) {
    if (!names.empty()) names += ", ";
    names += option.is_positional ? fmt::format("\\fI{}\\fR", roff(name))
                                  : fmt::format("\\fB{}\\fR", roff(name));
  }
  if (!option.is_positional && !option.words.empty()) {
    names += fmt::format(" {}", roff(fmt::to_string(fmt::join(option.words, "|"))));
  } else if (!option.is_positional && !option.value.empty()) {
    names += fmt::format(" \\fI{}\\fR", roff(option.value));
  }
  return fmt::format(".TP\n{}\n{}\n", names, roff(option.description));
}

std::string synopsis(const std::string& name, const CommandInfo& command) {
  std::string text = fmt::format("\\fB{}\\fR", roff(name));
  if (!command.commands.empty()) text += " \\fICOMMAND\\fR";
  text += " [\\fIOPTION\\fR]...";
  for (const OptionInfo& option : command.options) {
    if (!option.is_positional) continue;
    const std::string value = fmt::format("\\fI{}\\fR{}", roff(option.names.front()),
                                          option.is_repeated ? "..." : "");
    text += option.is_required ? " " + value : " [" + value + "]";
  }
  return text + "\n";
}

std::string page(const std::string& name, const CommandInfo& command) {
  std::string title = name;
  std::ranges::replace(title, ' ', '-');
  std::string text =
      fmt::format(".TH {} 1 \"\" \"sdlc {}\" \"sdlc\"\n", roff(lang::upper_case(title)), kVersion);
  text += section("NAME") + fmt::format("{} \\- {}\n", roff(title), roff(command.description));
  text += section("SYNOPSIS") + synopsis(name, command);
  if (!command.commands.empty()) {
    text += section("COMMANDS");
    for (const CommandInfo& part : command.commands) {
      text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(part.name), roff(part.description));
    }
  }
  text += section("OPTIONS");
  for (const OptionInfo& option : command.options) text += option_text(option);
  if (!command.footer.empty()) text += section("NOTES") + block(command.footer);
  return text;
}

std::string page_of(const CommandInfo& program, const std::string& name) {
  if (name.empty()) return page(program.name, program);
  std::vector<std::string_view> known;
  for (const CommandInfo& command : program.commands) {
    if (command.name == name) return page(program.name + " " + name, command);
    known.push_back(command.name);
  }
  throw UsageError(fmt::format("unknown command `{}`{}", lang::printable(name),
                               lang::did_you_mean(name, known)));
}

}  // namespace

void add_man_command(Command& program, Dispatcher& dispatcher) {
  auto name = std::make_shared<std::string>();
  Command command = program.add_command("man", "Print the manual page of a command");
  command.add_text("COMMAND", *name, "Which command; default: the program");
  command.add_flag("--quiet", "Has no effect here");
  command.footer(
      "Example:\n"
      "  sdlc man render | man -l -      shows it");
  dispatcher.on(command, [name, program](Environment& env) {
    env.out << page_of(program.info(), *name);
    return ExitCode::Success;
  });
}

}  // namespace sdlc::cli
