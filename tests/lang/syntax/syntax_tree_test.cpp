#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "lang/repair/scene_repair.hpp"
#include "lang/syntax/syntax.hpp"
#include "tests/lang/syntax/tree_checks.hpp"

namespace sdlc::lang {
namespace {

/// The tree of an expression in prefix form, leaves as they are spelled.
class Shape {
 public:
  explicit Shape(const SyntaxTree& tree) : tree_(tree) {}

  std::string of(NodeIndex index) const {
    const SyntaxNode& node = tree_[index];
    if (node.extent == 1) return std::string(tree_.text(node.span()));
    std::string shape = "(";
    shape += name(node);
    for (NodeIndex child = index + 1; child < index + node.extent; child += tree_[child].extent) {
      shape += ' ';
      shape += op(tree_[child].op);
      shape += of(child);
    }
    shape += ')';
    return shape;
  }

 private:
  std::string name(const SyntaxNode& node) const {
    switch (node.kind) {
      case SyntaxKind::Error: return "error";
      case SyntaxKind::Conditional: return "if";
      case SyntaxKind::LetIn: return "let";
      case SyntaxKind::Binding: return "=";
      case SyntaxKind::Or: return "or";
      case SyntaxKind::And: return "and";
      case SyntaxKind::Not: return "not";
      case SyntaxKind::Comparison: return "compare";
      case SyntaxKind::Interval: return "..";
      case SyntaxKind::Sum: return "sum";
      case SyntaxKind::Product: return "product";
      case SyntaxKind::Negative: return "-";
      case SyntaxKind::Power: return "^";
      case SyntaxKind::Postfix: return "postfix";
      case SyntaxKind::Index: return "index";
      case SyntaxKind::Group: return "group";
      case SyntaxKind::Triple: return "triple";
      case SyntaxKind::List: return "list";
      case SyntaxKind::Comprehension: return "comprehension";
      case SyntaxKind::ForClause: return "for";
      case SyntaxKind::IfClause: return "if";
      case SyntaxKind::Pattern: return "names";
      case SyntaxKind::RowPattern: return "row";
      default: return std::string(tree_.text({node.begin, node.begin + node.head}));
    }
  }
  static std::string op(Operator op) {
    constexpr const char* kSpellings[] = {"", "+", "-", "*", "/", "==", "!=", "<=", ">=", "<", ">"};
    return kSpellings[static_cast<std::size_t>(op)];
  }

  const SyntaxTree& tree_;
};

std::string shape_of(std::string_view expression) {
  const SourceFile file("test.scene", "scene 1 x: " + std::string(expression));
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_FALSE(sink.has_errors()) << expression;
  return Shape(tree).of(3);  // behind the file, its version and the property
}

TEST(SyntaxTree, BindsOperatorsByTheirPrecedence) {
  EXPECT_EQ(shape_of("-2^2"), "(- (^ 2 2))");
  EXPECT_EQ(shape_of("2^-1"), "(^ 2 (- 1))");
  EXPECT_EQ(shape_of("2^3^2"), "(^ 2 (^ 3 2))");
  EXPECT_EQ(shape_of("a + b * c - d"), "(sum a +(product b *c) -d)");
  EXPECT_EQ(shape_of("not a == b and c or d"), "(or (and (not (compare a ==b)) c) d)");
  EXPECT_EQ(shape_of("1 + 2 .. 3 * 4"), "(.. (sum 1 +2) (product 3 *4))");
  EXPECT_EQ(shape_of("a <= b .. c"), "(compare a <=(.. b c))");
}

TEST(SyntaxTree, KeepsChainsFlat) {
  EXPECT_EQ(shape_of("a + b - c + d"), "(sum a +b -c +d)");
  EXPECT_EQ(shape_of("a or b or c"), "(or a b c)");
  EXPECT_EQ(shape_of("if a then b else if c then d else e"), "(if a b c d e)");
  EXPECT_EQ(shape_of("let a = 1, b = a in a + b"), "(let (= a 1) (= b a) (sum a +b))");
  EXPECT_EQ(shape_of("\n let a = let in = 1 in in in a"), "(let (= a (let (= in 1) in)) a)");
}

TEST(SyntaxTree, TellsGroupsFromTriples) {
  EXPECT_EQ(shape_of("(1)"), "(group 1)");
  EXPECT_EQ(shape_of("(1, 2, 3)"), "(triple 1 2 3)");
  EXPECT_EQ(shape_of("(1, 2, 3,).x"), "(postfix (triple 1 2 3) .x)");
}

TEST(SyntaxTree, TellsReferencesFromCalls) {
  EXPECT_EQ(shape_of("mat.brushed"), "mat.brushed");
  EXPECT_EQ(shape_of("f(1, g(), b: h(2))"), "(f 1 g() (b (h 2)))");
  EXPECT_EQ(shape_of("a[1].b.c[2]"), "(postfix a (index 1) .b .c (index 2))");
}

TEST(SyntaxTree, TellsListsFromComprehensions) {
  EXPECT_EQ(shape_of("[]"), "[]");
  EXPECT_EQ(shape_of("[1, x]"), "(list 1 x)");
  EXPECT_EQ(shape_of("[x for x in a]"), "(comprehension x (for (names x) a))");
  EXPECT_EQ(shape_of("[x + 1 for i, x in a if i for (b, c) in x]"),
            "(comprehension (sum x +1) (for (names i x) a) (if i) (for (names (row b c)) x))");
  EXPECT_EQ(shape_of("[[y for y in x] for i, (x, _) in if a then b else c]"),
            "(comprehension (comprehension y (for (names y) x)) "
            "(for (names i (row x _)) (if a b c)))");
}

TEST(SyntaxTree, ReadsPlainNumbersAsItReadsAllOthers) {
  for (const std::string number : {"1", "1.5", "-2", "-0.25"}) {
    // A comment behind the number sends it the way of all expressions.
    std::string plain = "f(", other = "f(";
    plain += number + ")";
    other += number + "/**/)";
    EXPECT_EQ(shape_of(plain), shape_of(other));
  }
  EXPECT_EQ(shape_of("[1 , -2 ]"), "(list 1 (- 2))");
}

TEST(SyntaxTree, SpellsItsFile) {
  const SourceFile file("test.scene", std::string(test::kWholeLanguage));
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_FALSE(sink.has_errors());
  EXPECT_EQ(test::fault_of(tree), "");
  EXPECT_EQ(test::spelling_of(file.text()), test::kWholeLanguage);
  EXPECT_FALSE(test::has_skipped(tree));
}

TEST(SyntaxTree, KeepsCommentsAndTellsDocs) {
  const SourceFile file(
      "test.scene", "/// doc\nscene 1 // line\n//// no doc\n/* block /* nested */ */ let a = b//x");
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  const auto comments = tree.comments();
  ASSERT_EQ(comments.size(), 5u);
  EXPECT_EQ(comments[0].kind, CommentKind::Doc);
  EXPECT_EQ(comments[1].kind, CommentKind::Line);
  EXPECT_EQ(comments[2].kind, CommentKind::Line);
  EXPECT_EQ(comments[3].kind, CommentKind::Block);
  EXPECT_EQ(tree.text(comments[3].span), "/* block /* nested */ */");
  EXPECT_EQ(tree.text(comments[4].span), "//x");
}

TEST(SyntaxTree, KeepsWhatItCouldReadOfABrokenStatement) {
  const SourceFile file("test.scene",
                        "scene 1\nsphere a { center: (1 2), radius: 3 }\nlet b = \nlet c = 4\n");
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_EQ(sink.error_count(), 2u);
  int lets = 0, properties = 0, errors = 0;
  for (const SyntaxNode& node : tree.nodes()) {
    lets += node.kind == SyntaxKind::Let;
    properties += node.kind == SyntaxKind::Property;
    errors += node.kind == SyntaxKind::Error;
  }
  EXPECT_EQ(lets, 2);
  EXPECT_EQ(properties, 2);
  EXPECT_GT(errors, 0);
}

class CountedPolls final : public StopRequest {
 public:
  bool is_made() const override { return ++count < 0; }
  mutable int count = 0;
};

TEST(SyntaxTree, PollsWhileItRepairs) {
  std::string text = "scene 1\n";
  for (int i = 0; i < 100; ++i) text += "sphere { center: (1 2, 0), radius: 1 }\n";
  const SourceFile file("test.scene", text);
  const CountedPolls of_spelling, of_structure, of_all;
  DiagnosticSink spelling(&of_spelling), structure(&of_structure), all(&of_all);
  RepairedText repaired(text);
  repair_spelling({file, repaired, spelling});
  repair_structure({file, repaired, structure}, false);
  EXPECT_GT(of_structure.count, 1000);
  parse(file, all);
  EXPECT_GE(of_all.count, of_spelling.count + of_structure.count);
}

}  // namespace
}  // namespace sdlc::lang
