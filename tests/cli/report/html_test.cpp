#include "cli/report/html.hpp"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "cli/report/table.hpp"

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

TEST(Html, IsPlainTextInATerminal) {
  EXPECT_EQ(plain_text("<p class=\"x\">2\u00a0s &lt; <b>3</b>\u00a0s</p> &amp;lt; &quot;&#39;"),
            "2 s < 3 s &lt; \"'");
  EXPECT_EQ(plain_text("a <unfinished"), "a ");
}

TEST(Table, HasHeadingsOfColumnsRowsAndGroups) {
  Table table("Fruit & more", "Name|#Weight");
  table.row({"apple", {"3", "2 to 4"}});
  table.group("Nuts");
  table.row({"almond", "1"});
  EXPECT_EQ(table.html(),
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

TEST(Table, AlignsItsColumnsInATerminal) {
  Table table("Fruit & more", "Name|-Only on the page|#Weight|Remark");
  table.group("<b>Stone</b> fruit");
  table.row({"plum &amp; co", "x", {"3", "2 to 4"}, "<i>sweet</i>"});
  table.row({"cherry", "y", "1", ""});
  EXPECT_EQ(table.text(), R"(Fruit & more
  Name       Weight      Remark
Stone fruit
  plum & co  3 (2 to 4)  sweet
  cherry     1
)");
}

}  // namespace
}  // namespace sdlc::cli
