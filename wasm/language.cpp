#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/allowances/allowances.hpp"
#include "lang/compile/compile.hpp"
#include "lang/convert/convert.hpp"
#include "lang/explain/explain.hpp"
#include "lang/format/format.hpp"
#include "lang/lint/fix_text.hpp"
#include "lang/lint/linted_text.hpp"
#include "lang/lint_config/lint_config.hpp"
#include "lang/report/report.hpp"
#include "lang/source/limits.hpp"
#include "wasm/calls.hpp"

namespace sdlc::wasm {
namespace {

Json report(const lang::Findings& findings) {
  return Json::parse(
      lang::render_findings(findings, {.format = lang::MessageFormat::Json, .facts = {}}));
}

/// Checks a text by the `.sdlc.toml` of its folder.
std::unique_ptr<lang::CheckedText> linted(std::shared_ptr<const lang::Document> document,
                                          const lang::ProgramOptions& program,
                                          lang::LintConfigs& configs) {
  const auto is_wanted = [&configs, scene = document->name()](const lang::DiagnosticInfo& info,
                                                              const lang::SourceFile* file) {
    const std::string place = file == nullptr ? scene : file->name();
    return configs.of(place, scene)
        .wants(info.code, std::filesystem::absolute(place).lexically_normal());
  };
  return std::make_unique<lang::LintedText>(std::move(document), program,
                                            lang::FindingsFilter{.is_wanted = is_wanted});
}

/// Files as they are now.
struct Files {
  lang::DiskFileSystem disk;
  lang::Workspace workspace{disk};
};

void refuse_wrong_configs(const lang::LintConfigs& configs) {
  if (!configs.errors().empty()) {
    throw WrongParameter(fmt::format("{}", fmt::join(configs.errors(), "\n")));
  }
}

std::optional<std::string> text_of(const Json& parameters, const char* name) {
  const auto found = parameters.find(name);
  if (found == parameters.end() || found->is_null()) return std::nullopt;
  return found->get<std::string>();
}

}  // namespace

lang::ProgramOptions program_options(const Json& parameters, lang::Workspace& workspace) {
  lang::ProgramOptions options{.workspace = &workspace, .limits = kLimits};
  options.is_sandboxed = parameters.value("sandbox", false);
  const Json limits = parameters.value("limits", Json::object());
  for (const auto& [name, value] : limits.items()) {
    const auto info = std::ranges::find(lang::kLimits, name, &lang::LimitInfo::name);
    if (info == lang::kLimits.end()) {
      throw WrongParameter(fmt::format("`limits`: there is no limit `{}`", name));
    }
    options.limits.*(info->limit) = value.get<std::uint64_t>();
  }
  const Json sets = parameters.value("sets", Json::object());
  for (const auto& [name, value] : sets.items()) {
    options.sets.push_back({name, value.get<std::string>()});
  }
  return options;
}

std::shared_ptr<const lang::Document> read_file(const Json& parameters,
                                                const lang::ProgramOptions& options) {
  const auto file = parameters.at("file").get<std::string>();
  std::error_code error;
  auto document = options.workspace->load(file, options.limits.any_file(), error);
  if (!document) {
    throw WrongParameter(fmt::format("cannot read `{}`: {}", file, error.message()));
  }
  return document;
}

Json findings_json(const lang::DiagnosticSink& sink) { return report(select_unallowed(sink)); }

Json lint(const Json& parameters) {
  Files files;
  lang::LintConfigs configs({}, files.workspace);
  const lang::ProgramOptions options = program_options(parameters, files.workspace);
  const auto checked = linted(read_file(parameters, options), options, configs);
  refuse_wrong_configs(configs);
  return report(checked->findings());
}

Json fix(const Json& parameters) {
  Files files;
  lang::LintConfigs configs({}, files.workspace);
  const lang::ProgramOptions options = program_options(parameters, files.workspace);
  auto document = read_file(parameters, options);
  const std::string name = document->name();
  const auto check = [&](std::string text) {
    return linted(std::make_shared<const lang::Document>(name, std::move(text)), options, configs);
  };
  const lang::FixResult result = lang::fix_text(linted(std::move(document), options, configs),
                                                parameters.value("unsafe", false), check);
  refuse_wrong_configs(configs);
  return {{"text", result.checked->file().text()},
          {"applied", result.applied},
          {"refused", result.refused},
          {"findings", report(result.checked->findings())}};
}

Json format(const Json& parameters) {
  const lang::Document document(parameters.value("file", "text.scene"),
                                parameters.at("text").get<std::string>());
  lang::DiagnosticSink sink;
  std::optional<lang::LineRange> lines;
  if (const auto range = parameters.find("lines"); range != parameters.end()) {
    lines = {range->at(0).get<std::uint32_t>(), range->at(1).get<std::uint32_t>()};
  }
  const std::optional<std::string> text = lang::format_file(document, sink, lines);
  return {{"text", text ? Json(*text) : Json()}, {"findings", findings_json(sink)}};
}

Json convert(const Json& parameters) {
  Files files;
  const lang::ProgramOptions options = program_options(parameters, files.workspace);
  const auto document = read_file(parameters, options);
  lang::ConvertOptions choices{.camera = text_of(parameters, "camera"),
                               .tone = text_of(parameters, "tone")};
  if (parameters.contains("frame")) choices.frame = parameters.at("frame").get<int>();
  lang::DiagnosticSink sink;
  lang::Conversion conversion(*document, options, sink);
  const std::optional<std::string> text = conversion.run(choices);
  return {{"text", text ? Json(*text) : Json()}, {"findings", findings_json(sink)}};
}

Json explain(const Json& parameters) {
  const auto page = lang::explanation(parameters.at("code").get<std::string>());
  return {{"page", page ? Json(*page) : Json()}};
}

}  // namespace sdlc::wasm
