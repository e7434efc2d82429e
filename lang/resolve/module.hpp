#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/code/code.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/resolve/lost_names.hpp"
#include "lang/resolve/misspellings.hpp"
#include "lang/source/limits.hpp"
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
  bool uses_time = false;          ///< may read `time`, itself or through what it uses
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
  bool uses_time = false;            ///< of a fn: may read `time`
  bool is_broken = false;            ///< parameters may be missing that could not be read
};

/// The name that an import statement gives to a file.
struct Import {
  std::uint32_t module = kNothing;  ///< kNothing: not readable
  NodeIndex node = 0;               ///< the statement
};

/// A file of the language with its declarations resolved. Its other statements are resolved one at
/// a time, when they are evaluated.
struct Module {
  Module(const SourceFile& file_, const SyntaxTree& tree_) : file(&file_), tree(tree_) {}

  const SourceFile* file;
  std::filesystem::path path;       ///< its own imports are relative to its folder
  std::uint32_t parent = kNothing;  ///< the module that asked for it first
  const SyntaxTree& tree;
  Code code{tree};
  std::vector<Global> globals;
  std::vector<Definition> functions, defs;
  std::unordered_map<std::string_view, std::uint32_t> global_names, function_names, def_names;
  std::unordered_map<std::string_view, Import> imports;
  std::vector<std::uint32_t> order;  ///< of the globals: each after those it uses

  // For reports on unknown names: made when the first one is found.
  std::unique_ptr<const Misspellings> misspellings;
  std::unique_ptr<const LostNames> lost_names;
  std::uint64_t compared_names = 0;  ///< by all searches for the nearest name
};

/// The files of a program as the resolver sees them.
class Modules {
 public:
  virtual ~Modules() = default;

  virtual std::uint32_t module_count() const = 0;
  virtual Module& module_at(std::uint32_t index) = 0;
  /// The file that the String node names, read on first use: a module, a config (if `is_include`),
  /// or kNothing after reporting why there is none.
  virtual std::uint32_t load(std::uint32_t from, ast::Node name, bool is_include,
                             DiagnosticSink& sink) = 0;
  virtual const Limits& limits() const = 0;
};

/// A config is numbered from here on: its index in the program's configs plus this.
inline constexpr std::uint32_t kConfigs = 0x80000000;

}  // namespace sdlc::lang
