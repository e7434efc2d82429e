#pragma once

#include <array>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/object_reader.hpp"
#include "lang/json/tape.hpp"
#include "lang/json/value_reader.hpp"
#include "lang/object/object.hpp"

namespace sdlc::lang {

/// Reads `{ "type": …, … }`: the type decides which keys there are.
class MaterialReader {
 public:
  MaterialReader(const SourceFile& file, DiagnosticSink& sink);

  /// The material in tape[node]; Nothing if anything of it is wrong. `where` is its key.
  Value read(const Tape& tape, std::uint32_t node, Location where);

 private:
  /// The keys of a material of one kind, and the argument that each one is.
  struct Table {
    std::string name;
    std::vector<JsonKey> keys;
    std::vector<const Property*> arguments;  ///< null of `type`
  };

  void add_kind(const MaterialInfo& info, Table& table) const;
  std::optional<MaterialKind> read_kind(const Tape& tape, std::uint32_t node, Location where);
  std::optional<MaterialKind> read_type(const Tape& tape, std::uint32_t type);

  const SourceFile* file_;
  DiagnosticSink* sink_;
  ValueReader values_;
  std::vector<Table> kinds_;
  Table any_kind_;  ///< the keys of all, for a material whose type is not known
};

}  // namespace sdlc::lang
