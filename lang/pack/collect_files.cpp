#include "lang/pack/collect_files.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/resolve/module.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;

/// By the text of the path alone, as imports are resolved.
fs::path absolute_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

class Collector {
 public:
  Collector(const SourceFile& root, const Workspace& workspace)
      : workspace_(workspace), scene_(absolute_path(root.name())), folder_(scene_.parent_path()) {
    texts_.emplace(scene_, root.text());
  }

  CollectedFiles run(const Program* program) {
    if (program != nullptr) collect(*program);
    CollectedFiles collected;
    for (auto& [path, text] : texts_) {
      if (path != scene_) collected.files.push_back(path);
      collected.pack.files.emplace(name_of(path), std::move(text));
    }
    collected.pack.scene = name_of(scene_);
    return collected;
  }

 private:
  std::string name_of(const fs::path& path) const {
    return path.lexically_relative(folder_).generic_string();
  }

  void collect(const Program& program) {
    std::set<fs::path> loaded{workspace_.identity(scene_)};
    for (const fs::path& path : program.dependencies()) loaded.insert(workspace_.identity(path));
    for (std::uint32_t i = 0; i < program.module_count(); ++i) {
      const Module& module = program.module(i);
      for (NodeIndex node = 0; node < module.tree.nodes().size(); ++node) {
        const ast::Node statement(module.tree, node);
        if (!statement.is(SyntaxKind::Import) && !statement.is(SyntaxKind::Include)) continue;
        const auto name = statement.first(SyntaxKind::String);
        if (name) collect(*name, module, loaded, program.limits().any_file());
      }
    }
  }

  void collect(ast::Node name, const Module& module, const std::set<fs::path>& loaded,
               std::uint64_t max_bytes) {
    DiagnosticSink ignored;
    const Value value = evaluate_string(name, ignored);
    const auto* text = get_if<std::string>(&value);
    if (text == nullptr) return;
    const fs::path written = *text;
    const fs::path importer = absolute_path(module.path).parent_path();
    const fs::path path = (importer / written).lexically_normal();
    // The includes of a file that is only imported are not read.
    if (!loaded.contains(workspace_.identity(path))) return;
    if (written.is_absolute()) {
      const Position where = module.file->position(name.span().begin);
      throw ZipError(fmt::format(
          "{}:{}:{}: the path `{}` is absolute, and would not be in the pack; write it relative to "
          "the folder of this file",
          module.file->name(), where.line, where.column, *text));
    }
    // Where `..` leads, not where the path ends: `../rooms/door.scene` in rooms/ball.scene needs
    // the folder above.
    fs::path reached = importer;
    for (const fs::path& part : written) {
      if (part == "..") {
        reached = reached.parent_path();
        folder_ = common_folder(folder_, reached);
      } else if (part != ".") {
        reached /= part;
      }
    }
    add(path, max_bytes);
  }

  void add(const fs::path& path, std::uint64_t max_bytes) {
    if (texts_.contains(path)) return;
    std::error_code error;
    std::optional<std::string> text = workspace_.read(path, max_bytes, error);
    if (!text) throw ZipError(fmt::format("`{}`: {}", path.string(), error.message()));
    texts_.emplace(path, *std::move(text));
  }

  const Workspace& workspace_;
  fs::path scene_;
  fs::path folder_;  ///< of the pack: all files are in it or below
  std::map<fs::path, std::string> texts_;
};

}  // namespace

fs::path common_folder(const fs::path& a, const fs::path& b) {
  fs::path common;
  const auto end = std::ranges::mismatch(a, b).in1;
  for (auto name = a.begin(); name != end; ++name) common /= *name;
  return common;
}

CollectedFiles collect_files(const SourceFile& root, const Program* program,
                             const Workspace& workspace) {
  return Collector(root, workspace).run(program);
}

}  // namespace sdlc::lang
