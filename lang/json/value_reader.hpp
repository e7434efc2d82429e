#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/tape.hpp"
#include "lang/object/object.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// Reads the values of keys and reports those of a wrong type or range. Values that have been
/// reported, and incomplete arrays, are silently Nothing.
class ValueReader {
 public:
  ValueReader(const SourceFile& file, DiagnosticSink& sink) : file_(&file), sink_(&sink) {}

  /// The value of a key of any type except Object, Material and Spheres; Nothing if it is wrong.
  Value read(const JsonKey& key, const Tape& tape, std::uint32_t node);

  std::optional<std::string> read_string(std::string_view key, const Tape& tape,
                                         std::uint32_t node);

  /// Reports that the value is not of the type `wanted`.
  void diagnose_type(std::string_view key, std::string_view wanted, const JsonNode& node);

 private:
  Location at(Span span) const { return {file_, span}; }
  std::optional<double> read_number(std::string_view key, std::string_view wanted, Range range,
                                    const JsonNode& node);
  /// Reads an array of `type`, which has numbers.size() numbers in the key's range.
  bool read_numbers(const JsonKey& key, JsonType type, const Tape& tape, std::uint32_t array,
                    std::span<double> numbers);
  bool is_array_of(std::string_view key, JsonType type, std::size_t size, const Tape& tape,
                   std::uint32_t node);
  Value read_whole_number(const JsonKey& key, const JsonNode& node);
  Value read_bool(std::string_view key, const JsonNode& node);
  Value read_triple(const JsonKey& key, const Tape& tape, std::uint32_t node);
  Value read_color(const JsonKey& key, const Tape& tape, std::uint32_t node);
  Value read_interval(const JsonKey& key, const Tape& tape, std::uint32_t node);
  Value read_movement(const JsonKey& key, const Tape& tape, std::uint32_t node);

  const SourceFile* file_;
  DiagnosticSink* sink_;
};

}  // namespace sdlc::lang
