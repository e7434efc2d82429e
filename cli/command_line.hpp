#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// CLI11, which takes seconds to compile wherever it is included.
namespace CLI {
class App;
class Option;
}  // namespace CLI

/// The command line: commands with flags and positional arguments.
namespace sdlc::cli {

/// An invalid argument; the message is for the user.
class ArgumentError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// An invalid value of a flag.
  ArgumentError(const std::string& flag, const std::string& message)
      : std::runtime_error(flag + ": " + message) {}
};

/// A flag or positional argument of a command.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option& required();
  /// Accepts only these words, which must outlive the command; errors suggest the nearest.
  Option& one_of(std::span<const std::string_view> words);
  /// One argument may hold several values.
  Option& comma_separated();
  /// One occurrence of a repeated flag takes all arguments that can be values.
  Option& takes_several();
  Option& excludes(const Option& other);
  /// The name of the value in the help.
  Option& type_name(const std::string& name);
  Option& description(const std::string& doc);

 private:
  CLI::Option* option_;
};

/// A flag on the command line, with the values of all its occurrences.
struct GivenFlag {
  std::string name;  ///< with its dashes
  bool takes_value;
  std::vector<std::string> values;
};

/// What the help says of a flag or a positional argument.
struct OptionInfo {
  std::vector<std::string> names;  ///< flags with their dashes, the long ones first
  std::string value;               ///< the name of the value: "N"; empty for a flag without one
  std::vector<std::string> words;  ///< all values; empty if there are others
  std::string description;
  bool is_positional = false;
  bool is_required = false;
  bool is_repeated = false;  ///< takes any number of values
};

/// The same of a command, or of the program.
struct CommandInfo {
  std::string name;
  std::string description;
  std::string footer;
  std::vector<OptionInfo> options;
  std::vector<CommandInfo> commands;
};

/// A command. Names are `--long`, `-s,--long`, or without dashes for positional arguments. Targets
/// and functions are used while the command line is parsed; functions may throw ArgumentError.
class Command {
 public:
  using Take = std::function<void(const std::string&)>;
  using TakeAll = std::function<void(const std::vector<std::string>&)>;

  explicit Command(CLI::App& app) : app_(&app) {}

  Command add_command(const std::string& name, const std::string& doc);
  /// The same, which help does not list.
  Command add_hidden_command(const std::string& name, const std::string& doc);
  /// All that the command line has. Hidden commands are left out.
  CommandInfo info() const;

  Option add_flag(const std::string& name, bool& is_given, const std::string& doc);
  /// A flag without effect.
  Option add_flag(const std::string& name, const std::string& doc);
  Option add_text(const std::string& name, std::string& text, const std::string& doc);
  Option add_text(const std::string& name, std::optional<std::string>& text,
                  const std::string& doc);
  Option add_text(const std::string& name, Take take, const std::string& doc);
  /// A positional argument that may be repeated.
  Option add_texts(const std::string& name, std::vector<std::string>& texts,
                   const std::string& doc);
  /// A flag that may be repeated, each time with one value.
  Option add_repeated(const std::string& name, std::vector<std::string>& texts,
                      const std::string& doc);
  Option add_repeated(const std::string& name, TakeAll take, const std::string& doc);

  /// Precondition: the command has it.
  Option option(const std::string& name);
  void remove_option(const std::string& name);

  void footer(const std::string& text);
  void on_chosen(std::function<void()> run);

  /// The flags on the command line, in the order in which they were added. Call it after parsing.
  std::vector<GivenFlag> given_flags() const;

 private:
  CLI::App* app_;
};

/// The command line of a program.
class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& doc);
  ~CommandLine();

  /// The program itself, which has the commands.
  Command program() { return Command(*app_); }

  /// Returns false if help was requested. Throws ArgumentError.
  bool parse(std::span<const std::string> arguments);
  /// Help for the chosen command, or for the program.
  std::string help() const;

 private:
  std::unique_ptr<CLI::App> app_;
};

}  // namespace sdlc::cli
