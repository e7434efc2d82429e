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
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/code.hpp"
#include "lang/program/lost_names.hpp"
#include "lang/program/misspellings.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/sandbox.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// A let or param of a file's top level.
struct Global {
  std::string_view name;
  NodeIndex node = 0;              ///< the statement
  const TypeInfo* type = nullptr;  ///< declared; null: any
  bool is_param = false;
  bool uses_time = false;          ///< perhaps, itself or through what it uses
  std::uint32_t value = kNothing;  ///< expression
};

struct Parameter {
  std::string_view name;
  NodeIndex node = 0;
  bool has_default = false;
  const TypeInfo* type = nullptr;
  std::uint32_t default_value = kNothing;  ///< expression, which may use the parameters before it
};

/// A fn or def: parameters are the first slots of its frame.
struct Definition {
  std::string_view name;
  NodeIndex node = 0;  ///< the statement
  std::vector<Parameter> parameters;
  std::uint32_t frame_size = 0;
  std::uint32_t body = kNothing;     ///< of a fn: expression
  std::vector<std::uint32_t> block;  ///< of a def: statements
  bool uses_time = false;            ///< of a fn: perhaps
  bool is_broken = false;            ///< its parameters are perhaps others
};

/// A file of the language, its declarations resolved. Its other statements are resolved when they
/// are evaluated, one at a time.
struct Module {
  Module(const SourceFile& file_, SyntaxTree tree_) : file(&file_), tree(std::move(tree_)) {}

  const SourceFile* file;
  std::filesystem::path path;       ///< by which its own imports are found
  std::uint32_t parent = kNothing;  ///< the module that asked for it first
  SyntaxTree tree;
  Code code{tree};
  std::vector<Global> globals;
  std::vector<Definition> functions, defs;
  std::unordered_map<std::string_view, std::uint32_t> global_names, function_names, def_names;
  std::unordered_map<std::string_view, std::uint32_t> imports;  ///< modules; kNothing: not readable
  std::vector<std::uint32_t> order;  ///< of the globals: each behind those it uses
  /// Made when an unknown name asks for them.
  std::unique_ptr<const Misspellings> misspellings;
  std::uint64_t compared_names = 0;  ///< in all searches for the nearest name
  std::unique_ptr<const LostNames> lost_names;
};

/// The value that the command line gives a param: the text behind `--set NAME=`.
struct SetOption {
  std::string name;
  std::string value;
};

/// Where the files of a program come from, and what holds for them.
struct ProgramOptions {
  const FileSystem* files = nullptr;  ///< null: there are none but the root
  Limits limits;
  bool is_sandboxed = false;  ///< nothing outside the root's folder is read
  std::vector<SetOption> sets = {};
};

/// Whether the file is no longer than files may be; if it is, that is reported.
bool check_file_size(const SourceFile& file, const Limits& limits, DiagnosticSink& sink);

/// A SetOption of the root's param `global`; `file` has its value as text.
struct ParamSetting {
  std::uint32_t global;
  const SourceFile* file;
};

/// Configs are included by their index plus this.
inline constexpr std::uint32_t kConfigs = 0x80000000;

/// A root file and all that it imports and includes, each read once.
class Program {
 public:
  static constexpr std::uint32_t kRoot = 0;

  /// Reads the root and what it imports; what is wrong is reported. `root` must outlive it.
  Program(const SourceFile& root, const ProgramOptions& options, DiagnosticSink& sink);

  const Module& module(std::uint32_t index) const { return *modules_[index]; }
  std::uint32_t module_count() const { return static_cast<std::uint32_t>(modules_.size()); }
  const SourceFile& config(std::uint32_t index) const { return *configs_[index - kConfigs]; }
  const Limits& limits() const noexcept { return options_.limits; }
  /// Every file but the root, in the order in which they were read.
  const std::vector<std::filesystem::path>& dependencies() const noexcept { return dependencies_; }

  /// What --set gives the root's param.
  std::optional<ParamSetting> setting_of(std::uint32_t global) const;
  /// The value of the setting as an expression over built-ins.
  const Code& resolve_setting(const ParamSetting& setting, std::uint32_t& expression,
                              DiagnosticSink& sink);

 private:
  friend class Resolver;

  /// What the String node names, read: a module, a config (only where `is_include`), or kNothing
  /// when there is none, which has been reported.
  std::uint32_t load(std::uint32_t from, ast::Node name, bool is_include, DiagnosticSink& sink);
  std::uint32_t add_module(const SourceFile& file, std::filesystem::path path, std::uint32_t parent,
                           DiagnosticSink& sink);
  void add_setting(const SetOption& option, DiagnosticSink& sink);
  /// What is the same for every way to write the path of one file.
  std::string identity(const std::filesystem::path& path) const;
  std::optional<std::string> read(const std::filesystem::path& path, ast::Node name,
                                  DiagnosticSink& sink) const;

  ProgramOptions options_;
  std::optional<Sandbox> sandbox_;
  std::vector<std::unique_ptr<Module>> modules_;
  std::vector<const SourceFile*> configs_;
  std::deque<SourceFile> sources_;                         ///< of all files but the root
  std::unordered_map<std::string, std::uint32_t> loaded_;  ///< by identity; kNothing: unreadable
  std::vector<std::filesystem::path> dependencies_;
  std::vector<ParamSetting> settings_;
};

}  // namespace sdlc::lang
