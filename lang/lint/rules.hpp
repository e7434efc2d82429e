#pragma once

#include <cstdint>
#include <span>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// What a rule checks.
enum class RuleScope : std::uint8_t {
  Text,        ///< the root's syntax tree
  AnyFrame,    ///< the scene; in a film, reports what holds in one of the checked frames
  EveryFrame,  ///< the scene; in a film, reports what holds in all frames
};

/// How the findings of a rule can be fixed automatically.
enum class RuleFix : std::uint8_t { None, Unsafe, Safe };

/// A rule. Each has its own file; the comment there states what it reports, and why.
struct Rule {
  const DiagnosticInfo* info;
  void (*check)(LintContext& context);
  RuleScope scope;
  RuleFix fix;  ///< of findings that have a fix
};

std::span<const Rule> all_rules() noexcept;

}  // namespace sdlc::lang
