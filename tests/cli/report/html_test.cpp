#include "cli/report/html.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace sdlc::cli {
namespace {

TEST(Html, WhatMeansSomethingIsAnEntity) {
  EXPECT_EQ(escaped(R"(<a href="x">Tom & 'Jerry'</a>)"),
            "&lt;a href=&quot;x&quot;&gt;Tom &amp; &#39;Jerry&#39;&lt;/a&gt;");
}

TEST(Html, ControlCharactersAreMadeVisible) {
  EXPECT_EQ(escaped("a\x1b[1m\nb\tü"), "a␛[1m␊b␉ü");
  EXPECT_EQ(escaped(std::string("\0", 1)), "␀");
  EXPECT_EQ(escaped("\xff"), "\uFFFD");
  EXPECT_EQ(escaped("\u202Etxt"), "\uFFFDtxt") << "would turn round what follows";
}

// RFC 4648, section 10.
TEST(Base64, AgreesWithTheVectorsOfTheRfc) {
  const std::pair<std::string, std::string> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) EXPECT_EQ(base64(bytes), text);
}

TEST(Base64, TakesAllBytes) {
  EXPECT_EQ(base64(std::string("\xff\xfe\xfd\x00\x80", 5)), "//79AIA=");
}

TEST(HtmlTable, HasHeadingsOfColumnsRowsAndGroups) {
  HtmlTable table("Fruit & more", "Name|#Weight");
  table.row().cell("apple").cell("3", "2 to 4");
  table.group("Nuts");
  table.row().cell("almond").cell("1");
  EXPECT_EQ(std::move(table).finish(),
            R"(<div class="scroll" tabindex="0" role="region" aria-label="Fruit &amp; more"><table>
<caption>Fruit &amp; more</caption>
<thead><tr><th scope="col">Name</th><th scope="col" class="number">Weight</th></tr></thead>
<tbody>
<tr><th scope="row">apple</th><td class="number">3 <small>2 to 4</small></td></tr>
</tbody>
<tbody><tr><th scope="rowgroup" colspan="2" class="group">Nuts</th></tr>
<tr><th scope="row">almond</th><td class="number">1</td></tr>
</tbody>
</table></div>
)");
}

}  // namespace
}  // namespace sdlc::cli
