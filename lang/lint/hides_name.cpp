#include "lang/lint/context.hpp"

namespace sdlc::lang {

/// A let, loop variable or parameter has the same name as a value of the file that is visible
/// there, and hides it; or a fn or def in a block that of another function or kind. Names of the
/// language may be hidden without a warning, so that new ones break no file; so may names that
/// begin with `_`.
void check_hides_name(LintContext& context) {
  const SymbolTable& names = context.names();
  for (const Symbol& symbol : names.symbols()) {
    if (symbol.hides == kNothing || symbol.name.starts_with('_')) continue;
    const Location where = names.tree().location(symbol.where);
    const Location hidden = names.tree().location(names.find(symbol.hides)->where);
    Finding& finding =
        context.add(diag::hides_name, LintPlace::of(where), symbol.name, symbol.name);
    finding.labels.push_back({LintPlace::of(hidden), "which is declared here"});
  }
}

}  // namespace sdlc::lang
