#include "lang/editor/links.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using namespace lang;

TEST(FileLinks, AreThePathsOfImportsAndIncludes) {
  const SourceFile file("folder/root.scene",
                        "scene 1\nimport \"lib.scene\" as lib\nimport \"../no.scene\" as no\n"
                        "group { if true { include \"a\\u0062.json\" } }\ninclude \"\"\n"
                        "let a = \"lib.scene\"\ninclude \"/top.scene\"\nimport \"x\\u0000\" as x\n"
                        "include");
  DiagnosticSink ignored;
  const SyntaxTree tree = parse(file, ignored);
  const TextFiles files({{"folder/lib.scene", ""}, {"folder/ab.json", ""}});
  std::vector<std::string> links;
  for (const FileLink& link : file_links(tree, file.name(), files)) {
    links.push_back(fmt::format("{} {}{}", file.text(link.where), link.target.generic_string(),
                                link.exists ? "" : " missing"));
  }
  EXPECT_THAT(links, testing::ElementsAre(
                         "\"lib.scene\" folder/lib.scene", "\"../no.scene\" no.scene missing",
                         "\"a\\u0062.json\" folder/ab.json", "\"/top.scene\" /top.scene missing"));
}

}  // namespace
}  // namespace sdlc::test
