#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/dispatcher.hpp"
#include "cli/report_failure.hpp"
#include "cli/scene_names.hpp"
#include "cli/scene_options.hpp"
#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::cli {

namespace {

/// What a word may be completed to.
struct Candidate {
  std::string text;
  std::string description = {};
};
using Candidates = std::vector<Candidate>;

const OptionInfo* find_flag(const CommandInfo& command, std::string_view name) {
  const auto found = std::ranges::find_if(command.options, [&](const OptionInfo& option) {
    return !option.is_positional && std::ranges::find(option.names, name) != option.names.end();
  });
  return found == command.options.end() ? nullptr : &*found;
}

/// The words of an incomplete command line, the program first, and the one to complete.
class Line {
 public:
  Line(const CommandInfo& program, std::vector<std::string> words, std::size_t index)
      : words_(std::move(words)), index_(index), command_(&program) {
    words_.resize(std::max(words_.size(), index_ + 1));
    for (std::size_t i = 1; i < index_; ++i) {
      const auto found = std::ranges::find(command_->commands, words_[i], &CommandInfo::name);
      if (found != command_->commands.end()) command_ = &*found;
    }
  }

  const CommandInfo& command() const noexcept { return *command_; }
  const std::string& word() const noexcept { return words_[index_]; }
  /// The `back`-th word before it; empty before the first.
  std::string_view before(std::size_t back) const {
    return back > index_ ? std::string_view() : std::string_view(words_[index_ - back]);
  }
  /// The first scene that is named.
  std::optional<std::string> scene() const {
    const auto found = std::ranges::find_if(
        words_, [](const std::string& word) { return word.ends_with(".scene"); });
    return found == words_.end() ? std::nullopt : std::optional(*found);
  }

 private:
  std::vector<std::string> words_;
  std::size_t index_;
  const CommandInfo* command_;
};

Candidates codes() {
  Candidates all;
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
    all.push_back({std::string(info->code), title_of(*info)});
  }
  return all;
}

/// What a scene declares; nothing if it cannot be read.
Candidates names_in(const Line& line, Environment& env,
                    std::vector<std::string> (*names)(const lang::Document&),
                    std::string_view ending = "") {
  Candidates all;
  const auto file = line.scene();
  if (!file) return all;
  std::ostringstream ignored;
  Environment quiet = env.with_err(ignored);
  report_failure(quiet, [&] {
    SceneOptions options;
    options.file = *file;
    for (const std::string& name : names(*read_scene(options, quiet))) {
      all.push_back({name + std::string(ending)});
    }
    return ExitCode::Success;
  });
  return all;
}

Candidates values_of(const OptionInfo& option, const Line& line, Environment& env) {
  Candidates all;
  for (const std::string& word : option.words) all.push_back({word});
  if (!all.empty() || option.names.empty()) return all;
  const std::string& name = option.names.front();
  if (name == "--camera") return names_in(line, env, camera_names);
  if (name == "--set") return names_in(line, env, param_names, "=");
  const bool is_code = name == "--select" || name == "--ignore" ||
                       (option.is_positional && line.command().name == "explain");
  return is_code ? codes() : Candidates();
}

Candidates flags_of(const CommandInfo& command) {
  Candidates all;
  for (const OptionInfo& option : command.options) {
    if (!option.is_positional) all.push_back({option.names.front(), option.description});
  }
  return all;
}

Candidates commands_of(const CommandInfo& command) {
  Candidates all;
  for (const CommandInfo& part : command.commands) all.push_back({part.name, part.description});
  return all;
}

/// All that may stand where the line ends, whatever the word begins with. Empty where a file name
/// may stand.
Candidates candidates_for(const CommandInfo& program, const Line& line, Environment& env) {
  const CommandInfo& command = line.command();
  const auto values = [&](std::string_view flag) -> std::optional<Candidates> {
    const OptionInfo* const option = find_flag(command, flag);
    if (option == nullptr || option->value.empty()) return std::nullopt;
    return values_of(*option, line, env);
  };
  // bash makes three words of `--flag=value`.
  if (line.word() == "=") return values(line.before(1)).value_or(Candidates());
  if (line.before(1) == "=") return values(line.before(2)).value_or(Candidates());
  if (const std::size_t end = line.word().find('=');
      line.word().starts_with("--") && end != std::string::npos) {
    const std::string flag = line.word().substr(0, end);
    Candidates all = values(flag).value_or(Candidates());
    for (Candidate& candidate : all) candidate.text = flag + "=" + candidate.text;
    return all;
  }
  if (const auto of_flag = values(line.before(1))) return *of_flag;
  if (line.word().starts_with('-')) return flags_of(command);
  if (line.before(1) == "help") return commands_of(program);
  if (!command.commands.empty()) return commands_of(command);
  for (const OptionInfo& option : command.options) {
    if (option.is_positional) return values_of(option, line, env);
  }
  return {};
}

/// One line for each candidate: its text, a tab, and its description.
ExitCode complete(const CommandInfo& program, const std::vector<std::string>& arguments,
                  Environment& env) {
  std::size_t index = 0;
  const std::string& first = arguments.front();
  const auto [end, error] = std::from_chars(first.data(), first.data() + first.size(), index);
  if (error != std::errc() || index == 0 || index > arguments.size()) return ExitCode::Success;
  const Line line(program, {arguments.begin() + 1, arguments.end()}, index);
  const std::string prefix = line.word() == "=" ? std::string() : line.word();
  for (const Candidate& candidate : candidates_for(program, line, env)) {
    if (!candidate.text.starts_with(prefix)) continue;
    const std::string description =
        candidate.description.substr(0, candidate.description.find('\n'));
    env.out << candidate.text << '\t' << description << '\n';
  }
  return ExitCode::Success;
}

}  // namespace

void add_complete_command(Command& program, Dispatcher& dispatcher) {
  auto words = std::make_shared<std::vector<std::string>>();
  Command command = program.add_hidden_command("complete", "For the scripts of `completions`");
  command.add_texts("WORD", *words, "The index of the word to complete, and all words").required();
  dispatcher.on(command, [words, program](Environment& env) {
    return complete(program.info(), *words, env);
  });
}

}  // namespace sdlc::cli
