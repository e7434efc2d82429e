#include "lang/resolve/outline.hpp"

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {
namespace {

TEST(Outline, ListsDeclarationsAndObjectsWithWhatTheyContain) {
  const SourceFile file("test.scene", R"(scene 1
import "lib.scene" as lib
param count = 3
def ring(n) {
  let step = 1turn / n
  for i in range(n) { sphere { radius: 1 } }
}
group moved {
  lib.pair second { gap: 1 }
  if count > 2 { sphere last { radius: 1 } }
}
let rest = = 2
background { color: black }
)");
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  std::string text;
  for (const OutlineItem& item : outline_of(tree)) {
    text += fmt::format("{}{} {}{}{}\n", std::string(2 * item.depth, ' '), describe(item.kind),
                        item.name, item.object_kind.empty() ? "" : ": ", item.object_kind);
    EXPECT_EQ(tree.text(item.where), item.name);
    EXPECT_LE(item.whole.begin, item.where.begin);
    EXPECT_GE(item.whole.end, item.where.end);
  }
  EXPECT_EQ(text, R"(import lib
param count
kind ring
  value step
  object sphere: sphere
object moved: group
  object second: lib.pair
  object last: sphere
value rest
object background: background
)");
}

}  // namespace
}  // namespace sdlc::lang
