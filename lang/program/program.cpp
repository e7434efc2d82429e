#include "lang/program/program.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/program/nearest_file.hpp"
#include "lang/resolve/record_symbols.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

/// The version of the language that the parser reads.
constexpr std::string_view kVersion = "1";

bool has_include(ast::Node statement) {
  const auto nodes = statement.tree().nodes().subspan(statement.index());
  const auto own = nodes.first(nodes.front().extent);
  return std::ranges::find(own, SyntaxKind::Include, &SyntaxNode::kind) != own.end();
}

}  // namespace

bool check_file_size(const SourceFile& file, const Limits& limits, DiagnosticSink& sink) {
  const bool is_config = file.format() == SourceFormat::Json;
  const std::uint64_t most = is_config ? limits.config : limits.file;
  if (file.text().size() <= most) return true;
  sink.report(diag::file_too_large, {&file, {0, 0}}, most)
      .help(fmt::format("`--limit {}=N` allows more", is_config ? "config" : "file"));
  return false;
}

Program::Program(const Document& root, const ProgramOptions& options, DiagnosticSink& sink)
    : options_(options) {
  fs::path path = root.name();
  if (options_.workspace != nullptr) {
    if (options_.is_sandboxed) sandbox_.emplace(*options_.workspace, path);
    loaded_.emplace(identity(path), kRoot);
  }
  add_module(root, std::move(path), kNothing, sink);
  modules_[kRoot]->is_included = true;
  for (const SetOption& option : options_.sets) add_setting(option, sink);
}

const SymbolTable& Program::names_of(std::uint32_t module, const StopRequest* stop) {
  const auto known = names_.find(module);
  if (known != names_.end()) return known->second;
  return names_.emplace(module, record_symbols(*this, module, SymbolDetail::Declared, stop))
      .first->second;
}

void Program::add_setting(const SetOption& option, DiagnosticSink& sink) {
  const Module& root = module(kRoot);
  const SourceFile& file =
      setting_files_.emplace_back(fmt::format("--set {}", option.name), option.value);
  const auto found = root.global_names.find(option.name);
  const bool is_param = found != root.global_names.end() && root.globals[found->second].is_param;
  if (is_param) {
    settings_.push_back({.global = found->second, .file = &file});
    return;
  }
  std::vector<std::string_view> names;
  for (const Global& global : root.globals) {
    if (global.is_param) names.push_back(global.name);
  }
  auto report = sink.report(diag::unknown_param, {}, option.name);
  if (const auto nearest = nearest_name(option.name, names)) {
    report.help(fmt::format("did you mean `{}`?", *nearest));
  } else if (!names.empty()) {
    report.help(fmt::format("the scene's params are {}", fmt::join(names, ", ")));
  }
}

std::optional<ParamSetting> Program::setting_of(std::uint32_t global) const {
  // The last --set of a param takes precedence, as with other flags.
  const auto found = std::find_if(settings_.rbegin(), settings_.rend(),
                                  [&](const ParamSetting& s) { return s.global == global; });
  return found == settings_.rend() ? std::nullopt : std::optional(*found);
}

const Code& Program::resolve_setting(const ParamSetting& setting, std::uint32_t& expression,
                                     DiagnosticSink& sink) {
  auto known = setting_values_.find(setting.file);
  if (known == setting_values_.end()) {
    DiagnosticSink errors(sink.stop_request());
    const auto index = module_count();
    const SyntaxTree& tree = setting_trees_.emplace_back(parse_expression(*setting.file, errors));
    modules_.push_back(std::make_unique<Module>(*setting.file, tree));
    const auto value = Resolver(*this, index, errors).resolve_expression();
    known = setting_values_.emplace(setting.file, SettingValue{index, value}).first;
    known->second.errors.add(errors);
  }
  sink.add(known->second.errors);
  expression = known->second.expression;
  return module(known->second.module).code;
}

std::uint32_t Program::add_module(const Document& file, fs::path path, std::uint32_t parent,
                                  DiagnosticSink& sink) {
  const auto index = static_cast<std::uint32_t>(modules_.size());
  const bool is_readable = check_file_size(file, options_.limits, sink);
  const SyntaxTree& tree = (is_readable ? file : unread_).tree(sink);
  modules_.push_back(std::make_unique<Module>(file, tree));
  modules_[index]->path = std::move(path);
  modules_[index]->parent = parent;
  Resolver(*this, index, sink).resolve_declarations();
  return index;
}

void Program::load_all(DiagnosticSink& sink) {
  // Declarations were resolved when their file was loaded. Resolving a statement loads the files
  // that it includes, which may also include a file that was only imported before.
  const auto is_pending = [](const auto& module) {
    return module->is_included && !module->is_resolved;
  };
  for (auto next = std::ranges::find_if(modules_, is_pending); next != modules_.end();
       next = std::ranges::find_if(modules_, is_pending)) {
    Module& file = **next;
    Resolver resolver(*this, static_cast<std::uint32_t>(next - modules_.begin()), sink);
    Code code(file.tree);
    for (const ast::Node statement : ast::Node(file.tree, 0).children()) {
      if (sink.is_muted() && !has_include(statement)) continue;  // nothing to load or to report
      std::uint32_t frame_size = 0;
      code.clear();
      resolver.resolve_statement(statement, code, frame_size);
    }
    file.is_resolved = true;
  }
}

bool Program::has_loaded_all() const {
  return std::ranges::all_of(
      modules_, [](const auto& module) { return !module->is_included || module->is_resolved; });
}

std::string Program::identity(const fs::path& path) const {
  if (options_.workspace == nullptr) return path.string();
  if (!sandbox_) return options_.workspace->identity(path).string();
  return sandbox_->resolve(path).value_or(fs::absolute(path).lexically_normal()).string();
}

std::shared_ptr<const Document> Program::read(const fs::path& path, const FileRequest& request,
                                              DiagnosticSink& sink) {
  const ast::Node name = request.name;
  if (options_.workspace == nullptr) {
    sink.report(diag::unreadable_file, name.location(), path.string(),
                "this program cannot read other files");
    return nullptr;
  }
  if (sandbox_ && !sandbox_->resolve(path)) {
    sink.report(diag::outside_sandbox, name.location(), path.string());
    return nullptr;
  }
  wanted_.push_back(path);
  if (options_.workspace->is_special(path)) {
    sink.report(diag::unreadable_file, name.location(), path.string(), "it is not a regular file");
    return nullptr;
  }
  std::error_code error;
  // An imported "-" is a file with this name, not standard input.
  const fs::path read_path = path == "-" ? fs::path("./-") : path;
  auto document =
      options_.workspace->load(read_path, path.string(), options_.limits.any_file(), error);
  if (!document) {
    sink.report(diag::unreadable_file, name.location(), path.string(), error.message())
        .help("the path is relative to the folder of this file")
        .suggest(suggest_file(request));
  }
  return document;
}

std::optional<std::string> Program::suggest_file(const FileRequest& request) {
  constexpr int kMaxSuggestions = 50;  // each reads folders
  if (++suggested_files_ > kMaxSuggestions) return std::nullopt;
  const auto list = [&](const fs::path& folder) {
    const bool is_outside = sandbox_ && !sandbox_->resolve(folder);
    return is_outside ? std::vector<FolderEntry>() : options_.workspace->list(folder);
  };
  const auto nearest =
      nearest_file(modules_[request.from]->path, request.written, request.is_include, list);
  return nearest ? std::optional(fmt::format("\"{}\"", *nearest)) : std::nullopt;
}

std::uint32_t Program::load(std::uint32_t from, ast::Node name, bool is_include,
                            DiagnosticSink& sink) {
  const Value value = evaluate_string(name, sink);
  const auto* written = get_if<std::string>(&value);
  if (written == nullptr) return kNothing;
  const fs::path path = (modules_[from]->path.parent_path() / *written).lexically_normal();
  const std::string key = identity(path);
  if (const auto known = loaded_.find(key); known != loaded_.end()) {
    const std::uint32_t module = known->second;
    std::vector<std::string> circle;
    for (std::uint32_t i = from; i != kNothing; i = modules_[i]->parent) {
      circle.push_back(fmt::format("`{}`", modules_[i]->file->name()));
      if (i != module) continue;
      std::reverse(circle.begin(), circle.end());
      circle.push_back(circle.front());
      sink.report(diag::file_circle, name.location(), modules_[module]->file->name())
          .help(fmt::format("the cycle is {}", fmt::join(circle, " → ")));
      return kNothing;
    }
    const bool is_usable = module != kNothing && (is_include || module < kConfigs);
    if (!is_usable && module != kNothing) sink.report(diag::import_of_config, name.location());
    if (is_include && module < kConfigs) modules_[module]->is_included = true;
    return is_usable ? module : kNothing;
  }

  std::uint64_t depth = 0;
  for (std::uint32_t i = from; i != kNothing; i = modules_[i]->parent) ++depth;
  if (depth > options_.limits.include_depth) {
    sink.report(diag::too_many_files_deep, name.location(), options_.limits.include_depth);
    return kNothing;
  }

  loaded_.emplace(key, kNothing);
  const std::shared_ptr<const Document> document =
      read(path, {from, name, *written, is_include}, sink);
  if (!document) return kNothing;
  dependencies_.push_back(path);
  documents_.push_back(document);
  const Document& file = *document;
  if (file.format() == SourceFormat::Json) {
    if (!check_file_size(file, options_.limits, sink)) return kNothing;
    loaded_[key] = kConfigs + static_cast<std::uint32_t>(configs_.size());
    configs_.push_back(&file);
    if (is_include) return loaded_[key];
    sink.report(diag::import_of_config, name.location())
        .help("`include` places the spheres of a JSON config");
    return kNothing;
  }
  loaded_[key] = module_count();
  const std::uint32_t added = add_module(file, path, from, sink);
  // A file of another version or above the size limit is unusable. kNothing, so that other files
  // may use its names without an error for each.
  const auto version = ast::Node(modules_[added]->tree, 0).first(SyntaxKind::Version);
  const bool is_other = version && version->text() != kVersion;
  if (is_other || file.text().size() > options_.limits.file) loaded_[key] = kNothing;
  modules_[added]->is_included = is_include && loaded_[key] != kNothing;
  return loaded_[key];
}

}  // namespace sdlc::lang
