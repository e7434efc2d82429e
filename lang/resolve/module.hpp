#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/code/code.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/table.hpp"
#include "lang/resolve/lost_names.hpp"
#include "lang/resolve/misspellings.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {

/// A let or param of a file's top level, or the import of a data file.
struct Global {
  std::string_view name;
  NodeIndex node = 0;              ///< the statement
  const TypeInfo* type = nullptr;  ///< declared; null: any
  bool is_param = false;
  bool uses_time = false;                        ///< may read `time`, directly or indirectly
  std::shared_ptr<const Table> table = nullptr;  ///< of an import of a data file
  std::uint32_t value = kNothing;                ///< expression
  std::uint32_t frame_size = 0;                  ///< slots of the locals in it
};

/// The import of a .scene file: its name denotes a module.
struct Import {
  std::uint32_t module = kNothing;  ///< kNothing: it could not be loaded
  NodeIndex node = 0;               ///< the statement
};

/// A .scene file with its declarations resolved. Its other statements are resolved one by one when
/// they are evaluated.
struct Module {
  Module(const SourceFile& file_, const SyntaxTree& tree_) : file(&file_), tree(tree_) {}

  const SourceFile* file;
  std::filesystem::path path;       ///< its imports are relative to its folder
  std::uint32_t parent = kNothing;  ///< the module that loaded it
  const SyntaxTree& tree;
  Code code{tree};
  std::vector<Global> globals;
  std::vector<Definition> functions, defs;
  std::unordered_map<std::string_view, std::uint32_t> global_names, function_names, def_names;
  std::unordered_map<std::string_view, Import> imports;
  std::vector<std::uint32_t> order;  ///< of evaluation: each global after those that it uses
  bool is_included = false;  ///< is the root or included: its other statements are resolved too
  bool is_resolved = false;  ///< they are: the files that they include are loaded

  // For diagnostics of unknown names: made for the first one.
  std::unique_ptr<const Misspellings> misspellings;
  std::unique_ptr<const LostNames> lost_names;
  std::optional<std::unordered_set<std::string_view>> object_names;
  std::uint64_t compared_names = 0;  ///< in all searches for similar names
};

/// The files of a program: the resolver's view of Program.
class Modules {
 public:
  virtual ~Modules() = default;

  virtual std::uint32_t module_count() const = 0;
  virtual Module& module_at(std::uint32_t index) = 0;
  /// The file that the String node names, loaded on first use: a module, a config (only if
  /// `is_include`), a data file (only if not), or kNothing, which is reported.
  virtual std::uint32_t load(std::uint32_t from, ast::Node name, bool is_include,
                             DiagnosticSink& sink) = 0;
  /// The table of a data file. `index`: the result of load(), at least kTables.
  virtual std::shared_ptr<const Table> table_at(std::uint32_t index) const = 0;
  /// Loads all files that any evaluation could include, without evaluating anything.
  virtual void load_all(DiagnosticSink& sink) = 0;
  virtual const Limits& limits() const = 0;
};

/// The first index of configs: the index of one is its index in the program's configs plus this.
inline constexpr std::uint32_t kConfigs = 0x80000000;
/// The same of data files; less than kConfigs.
inline constexpr std::uint32_t kTables = 0x40000000;

}  // namespace sdlc::lang
