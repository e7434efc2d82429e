#pragma once

#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/tape.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Receives a config part by part, so that only one part is in memory at a time.
class ConfigParts {
 public:
  virtual ~ConfigParts() = default;

  /// The config's opening bracket.
  virtual void begin(Span bracket) = 0;
  /// An element of the streamed array: tape[element] and its children.
  virtual void take_element(const Tape& tape, std::uint32_t element) = 0;
  /// A member of the config: tape[0] is its name, tape[1] its value. The streamed array is empty.
  virtual void take_member(const Tape& tape) = 0;
};

/// The key of the array whose elements are passed on one by one: that of the spheres.
std::string_view streamed_key() noexcept;

/// Parses the config and reports its syntax errors. Text that is not JSON is read by its meaning if
/// that is clear. Returns false if the parse stopped before the end or a part was left out: `parts`
/// has received what was read, with incomplete nodes marked.
bool parse_config(const SourceFile& file, ConfigParts& parts, DiagnosticSink& sink);

}  // namespace sdlc::lang
