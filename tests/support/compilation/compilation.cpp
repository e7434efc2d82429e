#include "tests/support/compilation/compilation.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "lang/allowances/allowances.hpp"
#include "lang/diagnostics/fixes.hpp"
#include "lang/eval/eval.hpp"

namespace sdlc::test {
namespace {

std::string with_version(const std::string& text) {
  const bool is_whole =
      text.starts_with("scene ") || text.starts_with("{") || text.starts_with("//");
  return is_whole ? text : "scene 1\n" + text;
}

std::map<std::string, std::string> with_versions(std::map<std::string, std::string> texts) {
  for (auto& [name, text] : texts) {
    if (name.ends_with(".scene")) text = with_version(text);
  }
  return texts;
}

lang::Document make_root(const std::string& text) {
  return {text.starts_with("{") ? "test.json" : "test.scene", with_version(text)};
}

lang::ProgramOptions options_of(const Sources& sources, lang::Workspace& workspace) {
  return {.workspace = &workspace,
          .limits = sources.limits,
          .is_sandboxed = sources.is_sandboxed,
          .sets = sources.sets};
}

std::string text_at(const lang::Location& where) {
  return where.file == nullptr ? std::string() : std::string(where.file->text(where.span));
}

std::vector<Told> told_by(const lang::DiagnosticSink& sink) {
  std::vector<Told> all;
  for (const lang::Diagnostic* diagnostic : select_unallowed(sink).shown) {
    Told told{.code = std::string(diagnostic->info->code),
              .message = diagnostic->message,
              .at = text_at(diagnostic->where),
              .labels = {},
              .help = diagnostic->help,
              .fixes = {},
              .chain = {}};
    for (const lang::Label& label : diagnostic->labels) {
      told.labels.push_back(label.message + ": " + text_at(label.where));
    }
    for (const lang::Fix& fix : diagnostic->fixes) told.fixes.push_back(fix.replacement);
    for (const lang::ChainLink& link : diagnostic->chain) {
      told.chain.push_back(link.message + ": " + text_at(link.where));
    }
    all.push_back(std::move(told));
  }
  return all;
}

std::vector<std::string> codes_in(const std::vector<Told>& told) {
  std::vector<std::string> codes;
  for (const Told& one : told) codes.push_back(one.code);
  return codes;
}

class RecordedObjects final : public lang::ObjectSink {
 public:
  void add(const lang::Object& object) override { list.push_back(object); }
  void enter(const lang::Object& group) override { list.push_back(group); }
  std::vector<lang::Object> list;
};

}  // namespace

std::optional<std::string> MemoryFiles::read(const std::filesystem::path& path,
                                             std::uint64_t /*most*/, std::error_code& error) const {
  const auto found = texts_.find(path.generic_string());
  if (found != texts_.end()) return found->second;
  error = std::make_error_code(std::errc::no_such_file_or_directory);
  return std::nullopt;
}

Compilation::Compilation(Sources sources)
    : sources_(std::move(sources)),
      files_(with_versions(sources_.files)),
      workspace_(files_),
      root_(make_root(sources_.root)),
      compiler_(std::make_unique<lang::Compiler>(root_, options_of(sources_, workspace_), sink_)) {}

std::vector<Told> Compilation::told() const { return told_by(sink_); }
std::vector<std::string> Compilation::codes() const { return codes_in(told()); }
std::vector<std::string> Evaluated::codes() const { return codes_in(told); }

std::vector<Told> told_about(Sources sources) {
  Compilation compilation(std::move(sources));
  compilation.lower();
  return compilation.told();
}

std::vector<std::string> codes_of(Sources sources) {
  return codes_in(told_about(std::move(sources)));
}

lang::LoweredScene scene_of(Sources sources, std::optional<int> frame) {
  const std::string text = sources.root;
  Compilation compilation(std::move(sources));
  auto lowered = compilation.lower({}, frame);
  for (const Told& told : compilation.told()) {
    ADD_FAILURE() << text << "\n" << told.code << ": " << told.message << " at " << told.at;
  }
  return lowered.value_or(lang::LoweredScene{});
}

Evaluated evaluated(Sources sources) {
  const MemoryFiles files(with_versions(sources.files));
  lang::Workspace workspace(files);
  const lang::Document root = make_root(sources.root);
  lang::DiagnosticSink sink;
  lang::Program program(root, options_of(sources, workspace), sink);
  RecordedObjects objects;
  lang::Evaluation(program, {}, sink).run(objects);
  return {.objects = std::move(objects.list), .told = told_by(sink)};
}

std::string with_fixes(const std::string& root) {
  const lang::Document file = make_root(root);
  lang::DiagnosticSink sink;
  lang::Program program(file, {}, sink);
  RecordedObjects objects;
  lang::Evaluation(program, {}, sink).run(objects);
  return lang::apply_fixes(file, select_unallowed(sink).shown, true).text;
}

}  // namespace sdlc::test
