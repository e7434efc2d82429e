#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// Checks the layout of the code: a folder declares what it includes in its CMakeLists.txt, and
// dependencies between folders point one way.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

struct Module {
  std::string folder;
  std::set<std::string> links;
};

/// The modules known to CMake, one per line: "sdlc::name folder : public links : private links".
std::map<std::string, Module> read_modules() {
  std::map<std::string, Module> modules;
  std::ifstream file(SDLC_MODULES_FILE);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name, folder;
    words >> name >> folder;
    Module module{.folder = folder, .links = {}};
    for (std::string word; words >> word;) {
      if (word.starts_with("sdlc::")) module.links.insert(word);
    }
    modules[name] = module;
  }
  return modules;
}

std::vector<std::string> project_includes(const fs::path& source) {
  std::vector<std::string> includes;
  std::ifstream file(source);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("#include \"")) continue;
    const std::size_t end = line.find('"', 10);
    includes.push_back(line.substr(10, end - 10));
  }
  return includes;
}

TEST(Architecture, FoldersIncludeOnlyWhatTheyDeclare) {
  const auto modules = read_modules();
  ASSERT_GT(modules.size(), 10u);
  std::map<std::string, std::string> module_of_folder;
  for (const auto& [name, module] : modules) module_of_folder[module.folder] = name;

  for (const auto& [name, module] : modules) {
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / module.folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".cpp" && extension != ".hpp" && extension != ".h") continue;
      for (const std::string& include : project_includes(entry.path())) {
        const std::string folder = fs::path(include).parent_path().string();
        if (folder == module.folder) continue;
        const auto used = module_of_folder.find(folder);
        ASSERT_NE(used, module_of_folder.end()) << entry.path() << " includes " << include;
        EXPECT_TRUE(module.links.contains(used->second))
            << entry.path() << " includes " << include << ", but " << module.folder
            << "/CMakeLists.txt does not name " << used->second;
      }
    }
  }
}

TEST(Architecture, DeclaredDependenciesAreUsed) {
  const auto modules = read_modules();
  for (const auto& [name, module] : modules) {
    std::set<std::string> folders;
    for (const auto& entry : fs::directory_iterator(fs::path(SDLC_SOURCE_DIR) / module.folder)) {
      for (const std::string& include : project_includes(entry.path())) {
        folders.insert(fs::path(include).parent_path().string());
      }
    }
    for (const std::string& link : module.links) {
      ASSERT_TRUE(modules.contains(link)) << name << " links " << link;
      EXPECT_TRUE(folders.contains(modules.at(link).folder))
          << module.folder << "/CMakeLists.txt names " << link << ", which nothing there includes";
    }
  }
}

TEST(Architecture, TheRendererKnowsNothingOfTheLanguage) {
  for (const auto& [name, module] : read_modules()) {
    if (!module.folder.starts_with("render")) continue;
    for (const std::string& link : module.links) {
      EXPECT_TRUE(link.starts_with("sdlc::render")) << name << " links " << link;
    }
  }
}

TEST(Architecture, EachLibraryIsUsedInOnePlace) {
  const std::map<std::string, std::vector<std::string>> users{
      {"<OpenImageIO/", {"render/image/openimageio"}},
      {"<OpenEXR/", {"render/image/standard"}},
      {"<png.h", {"render/image/standard"}},
      {"<CLI/", {"cli"}},
      {"<hwy/", {"render/denoise", "render/kernel", "render/lanes", "render/shading"}},
      {"<tao/", {"grammar", "lang/json", "lang/syntax", "lang/token"}},
      {"<zlib.h", {"cli/terminal", "lang/pack"}},
  };
  for (const char* area : {"grammar", "lang", "render", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SDLC_SOURCE_DIR) / area)) {
      if (entry.is_directory()) continue;
      const std::string folder =
          fs::relative(entry.path().parent_path(), SDLC_SOURCE_DIR).generic_string();
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("#include <")) continue;
        for (const auto& [library, folders] : users) {
          if (!line.substr(9).starts_with(library)) continue;
          EXPECT_NE(std::find(folders.begin(), folders.end(), folder), folders.end())
              << entry.path() << " uses " << library;
        }
      }
    }
  }
}

/// Two classes with the same name share their inline members: the linker keeps the first that it
/// finds.
TEST(Architecture, NoClassHasTheNameOfAnother) {
  const std::regex class_head(R"(^(?:struct|class) (?:alignas\(\w+\) )?(\w+)\b(?!::)[^;<>(]*\{)");
  std::map<std::string, std::string> headers;
  std::size_t classes = 0;
  for (const char* area : {"lang", "render", "cli", "grammar"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SDLC_SOURCE_DIR) / area)) {
      if (entry.path().extension() != ".hpp") continue;
      std::ifstream file(entry.path());
      std::string scope;
      for (std::string line; std::getline(file, line);) {
        if (line.starts_with("namespace ")) scope = line;
        std::smatch match;
        if (!std::regex_search(line, match, class_head)) continue;
        ++classes;
        const std::string name = scope + match[1].str();
        const auto [known, is_new] = headers.emplace(name, entry.path().string());
        EXPECT_TRUE(is_new) << name << " is in " << known->second << " and in " << entry.path();
      }
    }
  }
  EXPECT_GT(classes, 100u);
}

TEST(Architecture, ArrowsNeverFormACycle) {
  const auto modules = read_modules();
  std::map<std::string, int> state;  // 1: in progress, 2: done
  const auto visit = [&](const auto& self, const std::string& name) -> void {
    state[name] = 1;
    for (const std::string& link : modules.at(name).links) {
      ASSERT_NE(state[link], 1) << "a cycle through " << name << " and " << link;
      if (state[link] == 0) self(self, link);
    }
    state[name] = 2;
  };
  for (const auto& [name, module] : modules) {
    if (state[name] == 0) visit(visit, name);
  }
}

}  // namespace
}  // namespace sdlc::test
