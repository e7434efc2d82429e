#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "lang/resolve/symbol_index.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/workspace.hpp"
#include "tests/support/compilation/compilation.hpp"

namespace sdlc::test {

/// A program from memory with the index of its names. A place is given as text: "count" is the
/// first `count` of the file, "count#3" the third.
class IndexedProgram {
 public:
  explicit IndexedProgram(const std::string& root, std::map<std::string, std::string> files = {});

  const lang::SymbolIndex& index() const { return *index_; }
  const lang::SymbolTable& table(const std::string& file = "test.scene") const;
  std::uint32_t file(const std::string& name) const;

  /// The offset of the place; fails the test if it does not exist.
  std::uint32_t offset(const std::string& place, const std::string& file = "test.scene") const;
  lang::SymbolId at(const std::string& place, const std::string& file = "test.scene") const;
  /// The symbol of the name at the place: "value 2:5", "parameter lib.scene 1:8", "built-in pi" or
  /// "unknown".
  std::string meaning(const std::string& place, const std::string& file = "test.scene") const;
  std::string describe(lang::SymbolId id) const;
  /// "2:5" or "lib.scene 2:5"
  std::string describe(const lang::FileSpan& place) const;
  std::vector<std::string> references(const std::string& place,
                                      const std::string& file = "test.scene") const;
  /// Names that are visible before the place.
  std::vector<std::string> visible(const std::string& place,
                                   lang::NameSpace space = lang::NameSpace::Values) const;
  std::vector<std::string> unknown() const;

  /// The texts after a rename of the symbol at the place; "conflict 2:5" and the like if refused.
  std::map<std::string, std::string> renamed(const std::string& place,
                                             const std::string& new_name) const;
  std::string refusal(const std::string& place, const std::string& new_name) const;

 private:
  MemoryFiles files_;
  lang::Workspace workspace_{files_};
  lang::Document root_;
  lang::DiagnosticSink sink_;
  std::optional<lang::Program> program_;
  std::optional<lang::SymbolIndex> index_;
};

}  // namespace sdlc::test
