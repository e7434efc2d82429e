#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/command_line.hpp"
#include "cli/diagnostics_output.hpp"
#include "cli/dispatcher.hpp"
#include "cli/page_text.hpp"
#include "cli/usage_error.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/explain/explain.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::cli {
namespace {

using Diagnostics = std::vector<const lang::DiagnosticInfo*>;

struct ExplainOptions {
  std::vector<std::string> topics;
  DiagnosticsOptions diagnostics;
};

/// What one argument selects: a page, or the list of codes with a prefix.
struct Topic {
  Diagnostics diagnostics;
  bool is_list = false;
};

/// Converts a title to the name in the table: "unknown_property" for "Unknown property".
std::string as_name(std::string_view text) {
  std::string name = lang::lower_case(text);
  std::ranges::replace_if(
      name, [](char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

Topic find_topic(const std::string& text) {
  const std::string code = lang::upper_case(text), name = as_name(text);
  Diagnostics beginning;
  std::vector<std::string_view> known;
  for (const lang::DiagnosticInfo* info : lang::all_diagnostics()) {
    if (info->code == code || info->name == name) return {.diagnostics = {info}};
    if (info->code.starts_with(code)) beginning.push_back(info);
    known.push_back(info->code);
    known.push_back(info->name);
  }
  if (!beginning.empty()) return {.diagnostics = std::move(beginning), .is_list = true};
  throw UsageError(fmt::format("unknown diagnostic `{}`{}; `sdlc explain` lists all",
                               lang::printable(text), lang::did_you_mean(name, known)));
}

std::string topics_json(const std::vector<Topic>& topics) {
  using Json = nlohmann::ordered_json;
  Json json = Json::array();
  for (const Topic& topic : topics) {
    for (const lang::DiagnosticInfo* info : topic.diagnostics) {
      json.push_back({{"code", info->code},
                      {"name", info->name},
                      {"severity", info->severity == lang::Severity::Error ? "error" : "warning"},
                      {"page", lang::explanation(info->code).value_or("")}});
    }
  }
  return json.dump(2) + "\n";
}

std::string list_text(const Diagnostics& diagnostics, bool has_color) {
  std::string text;
  for (const lang::DiagnosticFamily& family : lang::kDiagnosticFamilies) {
    std::string rows;
    for (const lang::DiagnosticInfo* info : diagnostics) {
      if (!info->code.starts_with(family.prefix)) continue;
      rows += fmt::format("  {}  {}\n", info->code, title_of(*info));
    }
    if (rows.empty()) continue;
    text +=
        fmt::format("{}{}\n{}", text.empty() ? "" : "\n", heading(family.title, has_color), rows);
  }
  return text;
}

std::string topic_text(const Topic& topic, bool has_color) {
  if (topic.is_list) return list_text(topic.diagnostics, has_color);
  const lang::DiagnosticInfo& info = *topic.diagnostics.front();
  return page_text(lang::explanation(info.code).value_or(info.message), has_color);
}

ExitCode run_explain(const ExplainOptions& options, Environment& env) {
  std::vector<Topic> topics;
  for (const std::string& text : options.topics) topics.push_back(find_topic(text));
  if (topics.empty()) topics.push_back(find_topic(""));
  if (options.diagnostics.format == "json") {
    env.out << topics_json(topics);
    return ExitCode::Success;
  }
  const bool has_color = wants_color(options.diagnostics, env.out_is_terminal, env);
  for (const Topic& topic : topics) {
    if (options.diagnostics.format == "concise") {
      for (const lang::DiagnosticInfo* info : topic.diagnostics) {
        env.out << fmt::format("{}: {}\n", info->code, title_of(*info));
      }
    } else {
      env.out << (&topic == &topics.front() ? "" : "\n") << topic_text(topic, has_color);
    }
  }
  return ExitCode::Success;
}

}  // namespace

void add_explain_command(Command& program, Dispatcher& dispatcher) {
  auto options = std::make_shared<ExplainOptions>();
  Command command =
      program.add_command("explain", "Explain a diagnostic, with an example and its fix");
  command.add_texts(
      "CODE", options->topics,
      "A code, the name of a diagnostic, or a prefix of codes; default: a list of all");
  add_answer_options(command, options->diagnostics);
  command.option("--format")
      .description("human: the page; concise: one line per code; json: the page as Markdown");
  command.option("--color").description("Bold headings");
  command.footer(
      "Examples:\n"
      "  sdlc explain E104                the meaning of a code\n"
      "  sdlc explain unknown_property    the same by name\n"
      "  sdlc explain W4                  all codes with this prefix\n"
      "  sdlc explain                     all codes\n"
      "\n"
      "E0 syntax, E1 names, E2 types and values, E3 limits and files, W4 warnings, S6 style.");
  dispatcher.on(command, [options](Environment& env) { return run_explain(*options, env); });
}

}  // namespace sdlc::cli
