#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/code/code.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/table.hpp"
#include "lang/resolve/module.hpp"
#include "lang/resolve/symbol_table.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"

namespace sdlc::lang {

/// An option `--set NAME=VALUE`: the value of a param.
struct SetOption {
  std::string name;
  std::string value;
};

/// Sources and limits of a program.
struct ProgramOptions {
  Workspace* workspace = nullptr;  ///< null: no file except the root can be read
  Limits limits = {};
  bool is_sandboxed = false;  ///< no file outside the root's folder is read
  /// Names and files are known at once, but nothing has a value before resolve_declarations().
  bool resolves_later = false;
  std::vector<SetOption> sets = {};
};

/// Whether the file is within its size limit; reports an error if it is not.
bool check_file_size(const SourceFile& file, const Limits& limits, DiagnosticSink& sink);

/// A resolved SetOption. `global` is the index of the param in the root's globals; the text of
/// `file` is the value.
struct ParamSetting {
  std::uint32_t global;
  const SourceFile* file;
};

/// A root file and the files that it imports and includes, each loaded once.
class Program final : public Modules {
 public:
  static constexpr std::uint32_t kRoot = 0;

  /// Loads the root and its imports, and reports errors. `root` must outlive the program.
  Program(const Document& root, const ProgramOptions& options, DiagnosticSink& sink);

  const Module& module(std::uint32_t index) const { return *modules_[index]; }
  std::uint32_t module_count() const override {
    return static_cast<std::uint32_t>(modules_.size());
  }
  Module& module_at(std::uint32_t index) override { return *modules_[index]; }
  /// The symbols of a module, with SymbolDetail::Declared; recorded on first use.
  const SymbolTable& names_of(std::uint32_t module, const StopRequest* stop);
  const SourceFile& config(std::uint32_t index) const { return *configs_[index - kConfigs]; }
  std::shared_ptr<const Table> table_at(std::uint32_t index) const override {
    return tables_[index - kTables];
  }
  const Limits& limits() const noexcept override { return options_.limits; }
  void load_all(DiagnosticSink& sink) override;
  /// With `resolves_later`: resolves what has been loaded, before the first evaluation.
  void resolve_declarations(DiagnosticSink& sink);
  /// Whether no evaluation can include further files.
  bool has_loaded_all() const;
  /// All files that have been loaded except the root, in the order of loading.
  const std::vector<std::filesystem::path>& dependencies() const noexcept { return dependencies_; }
  /// The same with files that could not be read: they may be created later.
  const std::vector<std::filesystem::path>& wanted() const noexcept { return wanted_; }

  /// The setting of a global of the root; nullopt if no --set gives it a value.
  std::optional<ParamSetting> setting_of(std::uint32_t global) const;
  /// The resolved value of a setting, which can use only built-in names. Returns the code and sets
  /// `expression` to the index of the value in it. Reports its errors at every call.
  const Code& resolve_setting(const ParamSetting& setting, std::uint32_t& expression,
                              DiagnosticSink& sink);

 private:
  struct SettingValue {
    std::uint32_t module;
    std::uint32_t expression;
    DiagnosticSink errors = {};
  };

  std::uint32_t load(std::uint32_t from, ast::Node name, bool is_include,
                     DiagnosticSink& sink) override;
  std::uint32_t add_module(const Document& file, std::filesystem::path path, std::uint32_t parent,
                           DiagnosticSink& sink);
  void add_setting(const SetOption& option, DiagnosticSink& sink);
  /// A key of the file, the same for all paths of one file.
  std::string identity(const std::filesystem::path& path) const;
  /// An import or include.
  struct FileRequest {
    std::uint32_t from;        ///< the module
    ast::Node name;            ///< the string
    std::string_view written;  ///< its value
    bool is_include;
  };
  /// Reads a data file: its index, or kNothing if it has mistakes.
  std::uint32_t add_table(const Document& file, const FileRequest& request, DiagnosticSink& sink);
  std::shared_ptr<const Document> read(const std::filesystem::path& path,
                                       const FileRequest& request, DiagnosticSink& sink);
  /// The string with the existing file that a request for a missing one probably means.
  std::optional<std::string> suggest_file(const FileRequest& request);

  ProgramOptions options_;
  std::optional<Sandbox> sandbox_;
  std::vector<std::unique_ptr<Module>> modules_;
  std::vector<const SourceFile*> configs_;
  std::vector<std::uint32_t> unresolved_;  ///< modules, each after those that it imports
  std::vector<std::shared_ptr<const Table>> tables_;
  std::size_t bytes_of_tables_ = 0;
  CountedBytes table_bytes_;
  std::vector<std::shared_ptr<const Document>> documents_;  ///< all except the root
  const Document unread_{"", "scene 1"};                    ///< parsed for a file that is too large
  std::deque<SourceFile> setting_files_;
  std::deque<SyntaxTree> setting_trees_;
  std::unordered_map<const SourceFile*, SettingValue> setting_values_;  ///< resolved on first use
  std::unordered_map<std::string, std::uint32_t> loaded_;  ///< by identity; kNothing: unusable
  std::vector<std::filesystem::path> dependencies_, wanted_;
  int suggested_files_ = 0;  ///< how often folders were searched
  std::vector<ParamSetting> settings_;
  std::unordered_map<std::uint32_t, SymbolTable> names_;  ///< by module
};

}  // namespace sdlc::lang
