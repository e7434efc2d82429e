#include "lang/lint/context.hpp"
#include "lang/lint/names.hpp"

namespace sdlc::lang {

/// A let, loop variable or parameter has the name of a value of the file that is visible there too,
/// and from there on means the inner one. Names of the language are hidden without a word, so that
/// new ones break no file (ruling 10); so are names that begin with `_`.
void check_hides_name(LintContext& context) {
  const FileNames names(*context.tree());
  for (const DeclaredName& declared : names.declared()) {
    if (!declared.hides || declared.name.starts_with('_')) continue;
    Finding& finding =
        context.add(diag::hides_name, LintPlace::of(declared.where), declared.name, declared.name);
    finding.labels.push_back({LintPlace::of(*declared.hides), "which is declared here"});
  }
}

}  // namespace sdlc::lang
