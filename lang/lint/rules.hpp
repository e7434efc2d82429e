#pragma once

#include <cstdint>
#include <span>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// What a rule looks at.
enum class RuleScope : std::uint8_t {
  Text,        ///< the root's syntax tree
  AnyFrame,    ///< the scene; of a film what is so in one of the frames looked at is told
  EveryFrame,  ///< the scene; of a film what is so in all frames is told
};

/// What can be done about a finding without its author.
enum class RuleFix : std::uint8_t { None, Unsafe, Safe };

/// A rule, one file each, whose comment says what it claims and why that is so.
struct Rule {
  const DiagnosticInfo* info;
  void (*check)(LintContext& context);
  RuleScope scope;
  RuleFix fix;  ///< of its findings, where they have one
};

std::span<const Rule> all_rules() noexcept;

}  // namespace sdlc::lang
