#include "lang/workspace/workspace.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"

namespace sdlc::lang {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

namespace fs = std::filesystem;

class Files final : public FileSystem {
 public:
  std::vector<FolderEntry> list(const fs::path& /*folder*/) const override { return entries; }
  std::optional<std::string> read(const fs::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    ++reads;
    const auto found = texts.find(path.lexically_normal().string());
    if (found != texts.end()) return found->second;
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }

  std::map<std::string, std::string> texts;
  std::vector<FolderEntry> entries;
  mutable int reads = 0;
};

class WorkspaceTest : public testing::Test {
 protected:
  std::shared_ptr<const Document> load(const fs::path& path, std::uint64_t max_bytes = 100) {
    std::error_code error;
    auto document = workspace_.load(path, max_bytes, error);
    EXPECT_EQ(document == nullptr, bool(error));
    return document;
  }

  /// The number of errors in the file.
  std::size_t check(const fs::path& path, const Limits& limits = {}) {
    const auto document = load(path);
    DiagnosticSink sink;
    Compiler(*document, {.workspace = &workspace_, .limits = limits}, sink).check();
    return sink.error_count();
  }

  Files files_;
  Workspace workspace_{files_};
};

TEST_F(WorkspaceTest, ListsOpenTextsAmongTheFilesOfTheirFolder) {
  files_.entries = {{"b.scene", false}, {"lib", true}};
  workspace_.open("./a.scene", "only in the editor");
  workspace_.open("b.scene", "also on disk");
  workspace_.open("lib/c.scene", "in another folder");
  const FolderEntry a{"a.scene", false}, b{"b.scene", false}, lib{"lib", true};
  EXPECT_THAT(workspace_.list(""), ElementsAre(a, b, lib));
  files_.entries = {};
  EXPECT_THAT(workspace_.list("lib"), ElementsAre(FolderEntry{"c.scene", false}));
}

TEST_F(WorkspaceTest, PrefersOpenTextsToFiles) {
  files_.texts["a.scene"] = "disk";
  workspace_.open("a.scene", "editor", 7);
  EXPECT_EQ(load("a.scene")->text(), "editor");
  EXPECT_EQ(load("./a.scene")->version(), 7);
  EXPECT_TRUE(workspace_.is_open("./a.scene"));
  workspace_.close("a.scene");
  EXPECT_EQ(load("a.scene")->text(), "disk");
  EXPECT_EQ(load("a.scene")->version(), 0);
}

TEST_F(WorkspaceTest, OpensTextsWithoutFiles) {
  EXPECT_EQ(load("new.scene"), nullptr);
  workspace_.open("new.scene", "scene 1");
  EXPECT_EQ(load("new.scene")->text(), "scene 1");
  EXPECT_EQ(load("new.scene", 3)->text(), "scen");
}

TEST_F(WorkspaceTest, SharesWhatIsInUseAndUnchanged) {
  files_.texts["a.scene"] = "scene 1";
  const auto first = load("a.scene");
  EXPECT_EQ(load("a.scene"), first);
  files_.texts["a.scene"] = "scene 1 ";
  const auto second = load("a.scene");
  EXPECT_NE(second, first);
  EXPECT_EQ(second->text(), "scene 1 ");
  EXPECT_EQ(first->text(), "scene 1");  // still whole for those who use it
}

TEST_F(WorkspaceTest, KeepsDocumentsWhileATextIsOpen) {
  files_.texts = {{"root.scene", "root"}, {"lib.scene", "lib"}};
  workspace_.open("root.scene", "scene 1");
  const std::weak_ptr<const Document> root = load("root.scene"), lib = load("lib.scene");
  workspace_.open("root.scene", "scene 1 ");
  EXPECT_EQ(load("lib.scene"), lib.lock());
  EXPECT_NE(load("root.scene"), root.lock());
  EXPECT_TRUE(root.expired());
  workspace_.close("root.scene");
  EXPECT_TRUE(lib.expired());
}

TEST_F(WorkspaceTest, CallsADocumentByTheGivenName) {
  files_.texts["-"] = "scene 1";
  std::error_code error;
  EXPECT_EQ(workspace_.load("-", "<stdin>", 100, error)->name(), "<stdin>");
}

TEST_F(WorkspaceTest, ParsesADocumentOnceAndReportsItsErrorsEachTime) {
  files_.texts["a.scene"] = "scene 1\nlet = 3";
  const auto document = load("a.scene");
  DiagnosticSink first, second;
  const SyntaxTree& tree = document->tree(first);
  EXPECT_EQ(&document->tree(second), &tree);
  EXPECT_EQ(first.error_count(), 1u);
  EXPECT_EQ(second.error_count(), 1u);
}

TEST_F(WorkspaceTest, ReadsATableOnceAndReportsItsErrorsEachTime) {
  const Document good("a.csv", "x\n1\n"), wrong("b.csv", "x\n1\na\n");
  DiagnosticSink sink;
  EXPECT_EQ(good.table(sink), good.table(sink));
  for (int i = 0; i < 2; ++i) {
    DiagnosticSink errors;
    EXPECT_EQ(wrong.table(errors), nullptr);
    EXPECT_EQ(errors.error_count(), 1u);
  }
}

TEST_F(WorkspaceTest, ParsesAgainAfterAStop) {
  const Document document("a.scene", "scene 1\nlet = 3");
  StopRequest stop;
  stop.make();
  DiagnosticSink stopped(&stop), sink;
  EXPECT_THROW(document.tree(stopped), StopRequested);
  document.tree(sink);
  EXPECT_EQ(sink.error_count(), 1u);
}

TEST_F(WorkspaceTest, KnowsWhoDependsOnAFile) {
  workspace_.set_dependencies("root.scene", {"lib/a.scene"});
  workspace_.set_dependencies("lib/a.scene", {"lib/b.scene"});
  workspace_.set_dependencies("other.scene", {"lib/./b.scene"});
  EXPECT_THAT(workspace_.dependents("lib/b.scene"),
              ElementsAre("lib/a.scene", "other.scene", "root.scene"));
  EXPECT_THAT(workspace_.roots("lib/b.scene"), ElementsAre("other.scene", "root.scene"));
  workspace_.set_dependencies("other.scene", {});
  EXPECT_THAT(workspace_.roots("lib/b.scene"), ElementsAre("root.scene"));
  EXPECT_THAT(workspace_.dependents("root.scene"), IsEmpty());
}

TEST_F(WorkspaceTest, LearnsFromTheCompilerWhatAFileDependsOn) {
  files_.texts = {
      {"root.scene", "scene 1\nimport \"lib.scene\" as lib\ngroup { include \"part.scene\" }\n"},
      {"lib.scene", "scene 1\n"},
      {"part.scene", "scene 1\nimport \"base.scene\" as base\n"},
      {"base.scene", "scene 1\n"}};
  check("root.scene");
  EXPECT_THAT(workspace_.roots("lib.scene"), ElementsAre("root.scene"));
  EXPECT_THAT(workspace_.roots("base.scene"), ElementsAre("root.scene"));
}

TEST_F(WorkspaceTest, KnowsIncludesThatNoEvaluationReaches) {
  files_.texts = {{"part.scene", "scene 1\ninclude \"deep.scene\"\n"}, {"deep.scene", "scene 1\n"}};
  files_.texts["root.scene"] = "scene 1\nif false { include \"part.scene\" }\n";
  EXPECT_EQ(check("root.scene"), 0u);
  EXPECT_THAT(workspace_.roots("deep.scene"), ElementsAre("root.scene"));
  files_.texts["root.scene"] =
      "scene 1\nfor i in range(999) { let a = i }\ninclude \"part.scene\"\n";
  EXPECT_EQ(check("root.scene", {.steps = 100}), 1u) << "too many steps";
  EXPECT_THAT(workspace_.roots("deep.scene"), ElementsAre("root.scene"));
}

TEST_F(WorkspaceTest, KnowsWhoWantsAFileThatIsMissing) {
  files_.texts["root.scene"] = "scene 1\nimport \"new.scene\" as lib\n";
  EXPECT_EQ(check("root.scene"), 1u);
  EXPECT_THAT(workspace_.roots("new.scene"), ElementsAre("root.scene"));
  workspace_.open("new.scene", "scene 1\n");
  EXPECT_EQ(check("root.scene"), 0u);
}

TEST_F(WorkspaceTest, IdentifiesAFileBeforeItExists) {
  const DiskFileSystem disk;
  EXPECT_TRUE(disk.identity("no such file").is_absolute());
  EXPECT_EQ(disk.identity("no such folder/../no such file"), disk.identity("no such file"));
}

TEST_F(WorkspaceTest, ReleasesDocumentsThatNoOpenTextUses) {
  files_.texts = {{"lib.scene", "scene 1"}, {"root.scene", "scene 1"}, {"other.scene", "scene 1"}};
  workspace_.open("open.scene", "scene 1");
  const std::weak_ptr<const Document> lib = load("lib.scene"), root = load("root.scene"),
                                      other = load("other.scene");
  workspace_.set_dependencies("root.scene", {"open.scene", "lib.scene"});
  EXPECT_FALSE(lib.expired());
  EXPECT_FALSE(root.expired());
  EXPECT_TRUE(other.expired());
  workspace_.set_dependencies("root.scene", {"open.scene"});
  EXPECT_TRUE(lib.expired());
  workspace_.set_dependencies("root.scene", {});
  EXPECT_TRUE(root.expired());
}

TEST_F(WorkspaceTest, ReleasesLargeDocumentsThatNoOpenTextReads) {
  const std::string large = "scene 1\n//" + std::string(3 << 20, '-');
  files_.texts = {{"lib.scene", large}, {"a.scene", large}, {"b.scene", large}};
  workspace_.open("open.scene", "scene 1");
  workspace_.set_dependencies("open.scene", {"lib.scene"});
  workspace_.set_dependencies("a.scene", {"open.scene"});
  workspace_.set_dependencies("b.scene", {"open.scene"});
  const std::weak_ptr<const Document> a = load("a.scene");
  EXPECT_FALSE(a.expired()) << "one is not too much";
  const std::weak_ptr<const Document> lib = load("lib.scene"), b = load("b.scene");
  EXPECT_FALSE(lib.expired());
  EXPECT_TRUE(a.expired());
}

TEST_F(WorkspaceTest, EndsWhereFilesDependOnEachOther) {
  workspace_.set_dependencies("a.scene", {"b.scene"});
  workspace_.set_dependencies("b.scene", {"a.scene"});
  EXPECT_THAT(workspace_.dependents("a.scene"), ElementsAre("b.scene"));
  EXPECT_THAT(workspace_.roots("a.scene"), ElementsAre("b.scene"));
  workspace_.set_dependencies("b.scene", {"a.scene", "lib.scene"});
  workspace_.set_dependencies("root.scene", {"mid.scene"});
  workspace_.set_dependencies("mid.scene", {"lib.scene"});
  EXPECT_THAT(workspace_.roots("lib.scene"), ElementsAre("a.scene", "b.scene", "root.scene"));
  workspace_.set_dependencies("root.scene", {"a.scene"});
  workspace_.set_dependencies("mid.scene", {});
  EXPECT_THAT(workspace_.roots("lib.scene"), ElementsAre("root.scene"));
}

}  // namespace
}  // namespace sdlc::lang
