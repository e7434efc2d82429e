#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/material_reader.hpp"
#include "lang/json/object_reader.hpp"
#include "lang/json/parser.hpp"
#include "lang/json/value_reader.hpp"
#include "lang/object/object.hpp"

namespace sdlc::lang {

/// Makes objects of the parts of a config, by the tables of keys.
class ConfigReader final : public ConfigParts {
 public:
  ConfigReader(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink);

  void begin(Span bracket) override;
  void take_element(const Tape& tape, std::uint32_t element) override;
  void take_member(const Tape& tape) override;

  /// Checks the config as a whole and hands on its camera, background and settings.
  void finish();

 private:
  /// A member of the config that has been read.
  struct Part {
    Span name;
    Span value;
    bool is_given = false;
    bool is_guess = false;   ///< its key is misspelt
    bool has_value = false;  ///< it is not null
  };

  Location at(Span span) const { return {file_, span}; }
  Part& part(std::string_view key);
  void read_part(const JsonKey& key, const Tape& tape);
  void read_object(const JsonKey& key, const Tape& tape);
  void set(const JsonKey& key, Value value, Span span);
  void check_parts();
  void check_plain_picture();
  void set_tone();
  void set_threads();

  const SourceFile* file_;
  ObjectSink* objects_;
  DiagnosticSink* sink_;
  ValueReader values_;
  MaterialReader materials_;

  Span bracket_;
  std::array<Part, kMaxJsonKeys> parts_;
  Object sphere_, camera_, background_, render_;
  Slot gamma_correct_, in_parallel_, number_cores_;
};

}  // namespace sdlc::lang
