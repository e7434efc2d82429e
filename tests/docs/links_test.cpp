#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

/// The anchors that GitHub generates for the headings of a page.
std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  std::ifstream file(page);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('#')) continue;
    std::string anchor;
    for (const char c : line.substr(std::min(line.find_first_not_of("# "), line.size()))) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == ' ') anchor += '-';
      if (std::isalnum(byte) != 0 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(byte));
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

void check_links(const fs::path& page) {
  static const std::regex link(R"(\]\(([^)#:]*)(#[^)]*)?\))");
  const std::string text = content_of(page);
  for (std::sregex_iterator i(text.begin(), text.end(), link), end; i != end; ++i) {
    const std::string file = (*i)[1], anchor = (*i)[2];
    const fs::path target = file.empty() ? page : page.parent_path() / file;
    EXPECT_TRUE(fs::exists(target)) << page << " links to " << target;
    if (anchor.empty() || !fs::exists(target)) continue;
    EXPECT_TRUE(anchors_of(target).contains(anchor.substr(1))) << page << " links to " << anchor;
  }
}

TEST(Pages, LinkToWhatIsThere) {
  const fs::path root = SDLC_SOURCE_DIR;
  for (const char* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "THIRD_PARTY.md"}) {
    check_links(root / page);
  }
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") check_links(entry.path());
  }
}

}  // namespace
}  // namespace sdlc::test
