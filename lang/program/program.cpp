#include "lang/program/program.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/program/nearest_file.hpp"
#include "lang/resolve/record_symbols.hpp"
#include "lang/resolve/resolver.hpp"
#include "lang/source/data_format.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {

namespace fs = std::filesystem;

namespace {

/// The version of the language that the parser reads.
constexpr std::string_view kVersion = "1";

std::uint32_t report_include_of_data(ast::Node name, std::string_view written,
                                     DiagnosticSink& sink) {
  sink.report(diag::include_of_data, name.location())
      .help(fmt::format("`import \"{}\" as {}` gives the list of its rows", written,
                        name_for_file(written)));
  return kNothing;
}

void report_data_as_scene(const SourceFile& file, DiagnosticSink& sink) {
  sink.report(diag::unknown_format, {&file, {0, 0}}, file.name(), "a scene")
      .help(fmt::format("a scene reads it by `import \"{}\" as {}`",
                        fs::path(file.name()).filename().string(), name_for_file(file.name())));
}

/// Whether the file has neither an extension of scenes nor the beginning of one.
bool is_of_unknown_format(const SourceFile& file) {
  const std::string extension = fs::path(file.name()).extension().string();
  if (extension.empty() || extension == ".scene" || file.format() == SourceFormat::Json)
    return false;
  const std::uint32_t begin = skip_space(file.text(), 0);
  return file.text().substr(begin, end_of_identifier(file.text(), begin) - begin) != "scene";
}

std::vector<std::string_view> data_extensions() {
  std::vector<std::string_view> extensions;
  for (const DataFormatInfo& format : kDataFormats) extensions.push_back(format.extension);
  return extensions;
}

bool has_include(ast::Node statement) {
  const auto nodes = statement.tree().nodes().subspan(statement.index());
  const auto own = nodes.first(nodes.front().extent);
  return std::ranges::find(own, SyntaxKind::Include, &SyntaxNode::kind) != own.end();
}

}  // namespace

bool check_file_size(const SourceFile& file, const Limits& limits, DiagnosticSink& sink) {
  const std::uint64_t Limits::*limit = data_format_of(file.name())           ? &Limits::data
                                       : file.format() == SourceFormat::Json ? &Limits::config
                                                                             : &Limits::file;
  if (file.text().size() <= limits.*limit) return true;
  sink.report(diag::file_too_large, {&file, {0, 0}}, limits.*limit)
      .help(fmt::format("`--limit {}=N` allows more",
                        std::ranges::find(kLimits, limit, &LimitInfo::limit)->name));
  return false;
}

Program::Program(const Document& root, const ProgramOptions& options, DiagnosticSink& sink)
    : options_(options) {
  fs::path path = root.name();
  if (options_.workspace != nullptr) {
    if (options_.is_sandboxed) sandbox_.emplace(*options_.workspace, path);
    loaded_.emplace(identity(path), kRoot);
  }
  const bool is_data = data_format_of(path).has_value();
  if (is_data) report_data_as_scene(root, sink);
  add_module(is_data ? unread_ : root, std::move(path), kNothing, sink);
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
  collect_declarations(*this, index, sink);
  unresolved_.push_back(index);
  // Resolving a body loads the files that it includes.
  if (!options_.resolves_later || has_include({tree, 0})) resolve_declarations(sink);
  return index;
}

void Program::resolve_declarations(DiagnosticSink& sink) {
  for (const std::uint32_t module : std::exchange(unresolved_, {})) {
    Resolver(*this, module, sink).resolve_declarations();
  }
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
      code.clear();
      resolver.resolve_statement(statement, code);
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
  if (nearest == request.written) return std::nullopt;  // it is there, and cannot be read
  return nearest ? std::optional(fmt::format("\"{}\"", *nearest)) : std::nullopt;
}

std::uint32_t Program::add_table(const Document& file, const FileRequest& request,
                                 DiagnosticSink& sink) {
  if (!check_file_size(file, options_.limits, sink)) return kNothing;
  std::shared_ptr<const Table> table = file.table(sink);
  if (table == nullptr) return kNothing;
  bytes_of_tables_ += table->bytes();
  if (bytes_of_tables_ > options_.limits.memory) {
    sink.report(diag::too_much_memory, request.name.location(), options_.limits.memory)
        .help("`--limit memory=N` allows more");
    return kNothing;
  }
  table_bytes_.set(bytes_of_tables_);
  tables_.push_back(std::move(table));
  return kTables + static_cast<std::uint32_t>(tables_.size() - 1);
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
    if (module == kNothing) return kNothing;
    const bool is_config = module >= kConfigs, is_data = !is_config && module >= kTables;
    if (is_config && !is_include) {
      sink.report(diag::import_of_config, name.location());
      return kNothing;
    }
    if (is_data && is_include) return report_include_of_data(name, *written, sink);
    if (is_include && !is_config) modules_[module]->is_included = true;
    return module;
  }

  std::uint64_t depth = 0;
  for (std::uint32_t i = from; i != kNothing; i = modules_[i]->parent) ++depth;
  if (depth > options_.limits.include_depth) {
    sink.report(diag::too_many_files_deep, name.location(), options_.limits.include_depth);
    return kNothing;
  }

  const bool is_data = data_format_of(path).has_value();
  if (is_data && is_include) return report_include_of_data(name, *written, sink);
  loaded_.emplace(key, kNothing);
  const FileRequest request{from, name, *written, is_include};
  const std::shared_ptr<const Document> document = read(path, request, sink);
  if (!document) return kNothing;
  dependencies_.push_back(path);
  documents_.push_back(document);
  const Document& file = *document;
  if (is_data) return loaded_[key] = add_table(file, request, sink);
  if (is_of_unknown_format(file)) {
    sink.report(diag::unknown_format, name.location(), *written, "a scene or a data file")
        .help(fmt::format("data files have the extensions {}; other files begin with `scene 1`",
                          fmt::join(data_extensions(), ", ")));
    return kNothing;
  }
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
