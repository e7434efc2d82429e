#include "lang/lint/rules.hpp"

#include <array>

namespace sdlc::lang {

#define SDLC_RULE(scope, name, fix) void check_##name(LintContext& context);
#include "lang/lint/rules.def"
#undef SDLC_RULE

std::span<const Rule> all_rules() noexcept {
  static constexpr auto kRules = std::to_array<Rule>({
#define SDLC_RULE(scope, name, fix) {&diag::name, check_##name, RuleScope::scope, RuleFix::fix},
#include "lang/lint/rules.def"
#undef SDLC_RULE
  });
  return kRules;
}

}  // namespace sdlc::lang
