#pragma once

#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/tape.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Receives a config part by part, so that no more than one part is held as values.
class ConfigParts {
 public:
  virtual ~ConfigParts() = default;

  /// The config's opening bracket.
  virtual void begin(Span bracket) = 0;
  /// An element of the streamed array: tape[element] and what is in it.
  virtual void take_element(const Tape& tape, std::uint32_t element) = 0;
  /// A member of the config: tape[0] is its name, tape[1] its value. The streamed array comes
  /// empty.
  virtual void take_member(const Tape& tape) = 0;
};

/// Parses the config and reports what is wrong with its syntax. Mistakes whose meaning is clear are
/// read as if mended. Returns false if the text could not be read to its end: what was read by then
/// has been handed over too, marked as incomplete. `streamed` names the config's member whose
/// elements come one by one.
bool parse_config(const SourceFile& file, std::string_view streamed, ConfigParts& parts,
                  DiagnosticSink& sink);

}  // namespace sdlc::lang
