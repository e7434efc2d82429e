#include "lsp/checked_scene.hpp"

#include <map>
#include <utility>

#include "lang/allowances/allowances.hpp"
#include "lang/lint/lint.hpp"
#include "render/image/io_error.hpp"

namespace sdlc::lsp {

CheckedScene::CheckedScene(std::shared_ptr<const lang::Document> root,
                           const lang::ProgramOptions& options, const lang::StopRequest* stop)
    : root_(std::move(root)), sink_(stop), compiler_(*root_, options, sink_) {
  lang::lint(compiler_, *root_, sink_);
  select(options);
}

void CheckedScene::select(const lang::ProgramOptions& options) {
  lang::LintConfigs configs({.file = {}, .is_sandboxed = options.is_sandboxed}, *options.workspace);
  std::map<const lang::SourceFile*, const lang::LintConfig*> known;
  const auto config_of = [&](const lang::SourceFile& file) {
    const auto [entry, is_new] = known.emplace(&file, nullptr);
    if (is_new) {
      try {
        entry->second = &configs.of(file.name(), root_->name());
      } catch (const render::IoError& error) {
        config_errors_.emplace_back(error.what());
      }
    }
    return entry->second;
  };
  const auto is_wanted = [&](const lang::DiagnosticInfo& info, const lang::SourceFile* place) {
    const lang::SourceFile& file = place == nullptr ? *root_ : *place;
    const lang::LintConfig* config = config_of(file);
    return config == nullptr ||
           config->wants(info.code, std::filesystem::absolute(file.name()).lexically_normal());
  };
  config_of(*root_);  // its mistakes are reported even if there is nothing to select
  findings_ = select_unallowed(sink_, {.is_wanted = is_wanted, .max_per_severity = kMaxShown});
  config_errors_.insert(config_errors_.end(), configs.errors().begin(), configs.errors().end());
}

}  // namespace sdlc::lsp
