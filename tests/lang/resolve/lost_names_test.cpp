#include "lang/resolve/lost_names.hpp"

#include <string>

#include <gtest/gtest.h>

// Names that unreadable statements probably declare.
namespace sdlc::lang {
namespace {

bool is_lost(const std::string& statements, std::string_view name) {
  const SourceFile file("test.scene", "scene 1\n" + statements);
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  EXPECT_TRUE(sink.has_errors()) << statements;
  return LostNames(tree).contains(name);
}

TEST(LostNames, AreThoseThatASkippedTextDeclares) {
  EXPECT_TRUE(is_lost("let a = 5 5 let foo = 1\n", "foo"));
  EXPECT_TRUE(is_lost("let a = 5 5 as foo\n", "foo"));
  EXPECT_TRUE(is_lost("foo = = 1\n", "foo"));
  EXPECT_FALSE(is_lost("let a = 5 5 + foo\n", "foo"));
}

TEST(LostNames, AreNotThoseOfCommentsAndStrings) {
  EXPECT_FALSE(is_lost("let a = 5 5 // let foo = 1\n", "foo"));
  EXPECT_FALSE(is_lost("let a = 5 5 /* let foo = 1 */\n", "foo"));
  EXPECT_FALSE(is_lost("let a = 5 5 \"let foo = 1\"\n", "foo"));
  EXPECT_FALSE(is_lost("import \"a.scene\" // as foo\n", "foo"));
}

TEST(LostNames, StopOnRequest) {
  const SourceFile file("test.scene", "scene 1\nlet a = 5 5\n");
  DiagnosticSink sink;
  const SyntaxTree tree = parse(file, sink);
  StopRequest stop;
  stop.make();
  EXPECT_THROW(LostNames(tree, &stop), StopRequested);
}

}  // namespace
}  // namespace sdlc::lang
