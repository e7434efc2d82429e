#pragma once

#include <string>
#include <string_view>

#include "lang/syntax/syntax.hpp"
#include "tests/lang/token/tokenize.hpp"

namespace sdlc::test {

/// What is wrong with the shape of the tree; empty if every subtree lies within its parent's and
/// every span within its parent's, behind its elder sibling's.
inline std::string fault_of(const lang::SyntaxTree& tree) {
  const auto nodes = tree.nodes();
  if (nodes.empty() || nodes[0].extent != nodes.size()) return "the file is not the whole tree";
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& parent = nodes[i];
    if (parent.begin > parent.end || parent.end > tree.file().text().size()) {
      return "the span of node " + std::to_string(i);
    }
    std::uint32_t behind = parent.begin;
    std::size_t child = i + 1;
    while (child < i + parent.extent) {
      if (nodes[child].extent == 0) return "the extent of node " + std::to_string(child);
      if (nodes[child].begin < behind || nodes[child].end > parent.end) {
        return "node " + std::to_string(child) + " in node " + std::to_string(i);
      }
      behind = nodes[child].end;
      child += nodes[child].extent;
    }
    if (child != i + parent.extent) return "the children of node " + std::to_string(i);
  }
  return {};
}

/// The tokens of a text, one after the other.
inline std::string spelling_of(std::string_view text) {
  std::string spelling;
  for (const lang::Token& token : tokenize(text)) {
    if (token.span.begin != spelling.size()) return "a gap";
    spelling += text.substr(token.span.begin, token.span.size());
  }
  return spelling;
}

/// Whether the tree leaves out a part of its text, or the text has what no scene has.
inline bool has_skipped(const lang::SyntaxTree& tree) {
  for (const lang::SyntaxNode& node : tree.nodes()) {
    if (node.kind == lang::SyntaxKind::Error && node.span().size() > 0) return true;
  }
  for (const lang::Token& token : tokenize(tree.file().text())) {
    const bool is_foreign =
        token.kind == lang::TokenKind::Unknown || token.kind == lang::TokenKind::ForeignName;
    if (is_foreign) return true;
  }
  return false;
}

/// Every statement and every form of expression.
inline constexpr std::string_view kWholeLanguage = R"(/// A file.
scene 1                                   // language version
import "materials.scene" as mat
include "other.scene"
param count: number = 12
/// A ring of balls.
def ring(n: number, radius: number = 1,) {
  for i in range(n) {
    let a = i / n * 1turn + time / 2s * 1turn
    sphere { center: radius * (cos(a), 0, sin(a)), radius: 0.2 }
  }
  if n > 3 { sphere { radius: 1 } } else if n == 2 { } else { ring inner { n: n - 1 } }
}
fn lerp(a, b, t: number) = a + (b - a) * t
camera main {
  from: (0, 2, 6)   /* a /* nested */ comment */
  at: (0, 0, -0.5,)
  fov: 40deg, shutter: 0 .. 20ms
}
background { bottom: white, top: #80b3ff }
sphere ground { center: (0, -1000.5, 0), radius: 1_000, material: diffuse(color: rgb(120, 140, 90)) }
mat.kind big { n: count, material: mat.brushed, rotate: (0deg, 30deg, 0deg) for: true }
let list = [[1, 2.5e-3], [-2^-1, x[0].y.z], []]
let rows = [[i, b] for i, (a, b,) in list if a > 1 for c in [a]]
for i, x in rows { for (_, size) in x { sphere { radius: size } } }
let choice = if not a and b or c != d then "q\"\\\u00e9" else if false then f(1, x: 2) else (g(2)[3])
render { width: 960, output: "ring.####.png" }
assert count <= 1000, "count is a number of balls, at most 1000"
)";

}  // namespace sdlc::test
