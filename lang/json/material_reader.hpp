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

/// Reads `{ "type": …, … }`. The type determines the other keys.
class MaterialReader {
 public:
  MaterialReader(const SourceFile& file, DiagnosticSink& sink);

  /// The material in tape[node]; Nothing if it has a mistake. `where` is its key.
  Value read(const Tape& tape, std::uint32_t node, Location where);

 private:
  /// The keys of a kind of material.
  struct Table {
    std::string name;
    std::vector<JsonKey> keys;

    void add_keys(MaterialKind kind);
  };

  std::optional<MaterialKind> read_kind(const Tape& tape, std::uint32_t node, Location where);
  std::optional<MaterialKind> read_type(const Tape& tape, std::uint32_t type);

  const SourceFile* file_;
  DiagnosticSink* sink_;
  ValueReader values_;
  std::vector<Table> kinds_;
  Table any_kind_;  ///< all keys, for a material of unknown type
};

}  // namespace sdlc::lang
