#include "cli/command_line.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/nearest_name.hpp"

namespace sdlc::cli {
namespace {

/// The names of a flag with their dashes, the long ones first; none for a positional argument.
std::vector<std::string> flag_names(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  return names;
}

std::vector<std::string> flags_of(const CLI::App& app) {
  std::vector<std::string> flags;
  for (const CLI::Option* option : app.get_options()) {
    std::ranges::move(flag_names(*option), std::back_inserter(flags));
  }
  return flags;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& candidates) {
  const std::vector<std::string_view> views(candidates.begin(), candidates.end());
  return lang::did_you_mean(name, views);
}

const CLI::App& chosen_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? app : chosen_command(*chosen.front());
}

/// The message for arguments that do not parse, for which CLI11 says `error`.
std::string parse_error(const CLI::App& app, const char* error,
                        std::span<const std::string> arguments) {
  const CLI::App& command = chosen_command(app);
  const bool has_command = &command != &app;
  if (!has_command && !arguments.empty() && !arguments[0].starts_with('-')) {
    return fmt::format("unknown command `{}`{}", arguments[0],
                       suggestion(arguments[0], command_names(app)));
  }
  for (const std::string& extra : app.remaining(true)) {
    if (!extra.starts_with('-') || extra == "-")
      return fmt::format("unexpected argument `{}`", extra);
    const std::string flag = extra.substr(0, extra.find('='));
    const std::vector<std::string> known = flags_of(command);
    if (has_command && std::find(known.begin(), known.end(), flag) != known.end()) {
      return fmt::format("`{}` belongs after `{}`", flag, command.get_name());
    }
    return fmt::format("unknown flag `{}`{}", flag, suggestion(flag, known));
  }
  for (const CLI::Option* option : command.get_options()) {
    const bool takes_one = option->get_items_expected_max() == 1 &&
                           option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
    if (!takes_one || option->count() < 2) continue;
    return fmt::format("{}: given {} times; give it once", option->get_name(), option->count());
  }
  return error;
}

Option repeated(CLI::Option& option) {
  // Positional arguments may follow the value.
  return Option(*option.take_all()->expected(1)->allow_extra_args(false));
}

/// "a|b|c" of one_of().
std::vector<std::string> words_of(CLI::Option& option) {
  std::vector<std::string> words;
  try {
    std::string text = option.get_validator(0)->get_description();
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find('|', begin), text.size());
      words.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  } catch (const CLI::OptionNotFound&) {
    // It takes any text.
  }
  return words;
}

OptionInfo info_of(CLI::Option& option) {
  OptionInfo info;
  info.description = option.get_description();
  info.is_positional = option.get_positional();
  info.is_required = option.get_required();
  info.is_repeated = option.get_items_expected_max() > 1;
  info.names = flag_names(option);
  if (info.is_positional) info.names.push_back(option.get_name(true));
  if (option.get_items_expected_max() > 0) {
    info.words = words_of(option);
    const std::string value = option.get_type_name();
    info.value = value.substr(0, value.find(':'));
  }
  return info;
}

CommandInfo info_of(CLI::App& app) {
  CommandInfo info;
  info.name = app.get_name();
  info.description = app.get_description();
  info.footer = app.get_footer();
  for (CLI::Option* const option : app.get_options()) info.options.push_back(info_of(*option));
  for (CLI::App* const command : app.get_subcommands([](CLI::App*) { return true; })) {
    if (!command->get_group().empty()) info.commands.push_back(info_of(*command));
  }
  return info;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::one_of(std::span<const std::string_view> words) {
  const auto check = [words](std::string& text) -> std::string {
    if (std::find(words.begin(), words.end(), text) != words.end()) return {};
    return fmt::format("`{}` is not one of {}{}", text, fmt::join(words, ", "),
                       lang::did_you_mean(text, words));
  };
  option_->check(CLI::Validator(check, fmt::format("{}", fmt::join(words, "|"))));
  return *this;
}

Option& Option::comma_separated() {
  option_->delimiter(',');
  return *this;
}

Option& Option::takes_several() {
  option_->allow_extra_args(true);
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::description(const std::string& doc) {
  option_->description(doc);
  return *this;
}

Command Command::add_command(const std::string& name, const std::string& doc) {
  return Command(*app_->add_subcommand(name, doc));
}

Command Command::add_hidden_command(const std::string& name, const std::string& doc) {
  return Command(*app_->add_subcommand(name, doc)->group(""));
}

CommandInfo Command::info() const { return info_of(*app_); }

Option Command::add_flag(const std::string& name, bool& is_given, const std::string& doc) {
  return Option(*app_->add_flag(name, is_given, doc));
}

Option Command::add_flag(const std::string& name, const std::string& doc) {
  return Option(*app_->add_flag(name)->description(doc));
}

Option Command::add_text(const std::string& name, std::string& text, const std::string& doc) {
  return Option(*app_->add_option(name, text, doc));
}

Option Command::add_text(const std::string& name, std::optional<std::string>& text,
                         const std::string& doc) {
  return Option(*app_->add_option(name, text, doc));
}

Option Command::add_text(const std::string& name, Take take, const std::string& doc) {
  return Option(*app_->add_option_function<std::string>(name, std::move(take), doc));
}

Option Command::add_texts(const std::string& name, std::vector<std::string>& texts,
                          const std::string& doc) {
  return Option(*app_->add_option(name, texts, doc));
}

Option Command::add_repeated(const std::string& name, std::vector<std::string>& texts,
                             const std::string& doc) {
  return repeated(*app_->add_option(name, texts, doc));
}

Option Command::add_repeated(const std::string& name, TakeAll take, const std::string& doc) {
  return repeated(*app_->add_option_function<std::vector<std::string>>(name, std::move(take), doc));
}

Option Command::option(const std::string& name) { return Option(*app_->get_option(name)); }

void Command::remove_option(const std::string& name) {
  app_->remove_option(app_->get_option(name));
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::on_chosen(std::function<void()> run) { app_->callback(std::move(run)); }

std::vector<GivenFlag> Command::given_flags() const {
  std::vector<GivenFlag> given;
  const CLI::App& app = *app_;
  const auto is_given = [](const CLI::Option* option) { return option->count() > 0; };
  for (const CLI::Option* option : app.get_options(is_given)) {
    if (option->get_lnames().empty()) continue;
    given.push_back({.name = "--" + option->get_lnames().front(),
                     .takes_value = option->get_items_expected_max() > 0,
                     .values = option->results()});
  }
  return given;
}

CommandLine::CommandLine(const std::string& program, const std::string& doc)
    : app_(std::make_unique<CLI::App>(doc, program)) {
  app_->require_subcommand(0, 1);
}

CommandLine::~CommandLine() = default;

bool CommandLine::parse(std::span<const std::string> arguments) {
  try {
    // CLI11 takes its arguments in reverse order.
    app_->parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
    return true;
  } catch (const CLI::CallForHelp&) {
    return false;
  } catch (const CLI::ParseError& error) {
    throw ArgumentError(parse_error(*app_, error.what(), arguments));
  } catch (const ArgumentError& error) {
    throw ArgumentError(parse_error(*app_, error.what(), arguments));
  }
}

std::string CommandLine::help() const { return app_->help(); }

}  // namespace sdlc::cli
