// Text of programs and file names in a page.

#include "io/page/html_text.h"

#include <gtest/gtest.h>

namespace clsurf::io::html_text_test {
namespace {

TEST(HtmlText, MarkupIsText) {
    EXPECT_EQ(html("a < b > c & \"d\" 'e'"), "a &lt; b &gt; c &amp; &quot;d&quot; &#39;e&#39;");
    EXPECT_EQ(html("</script><img src=x onerror=\"f()\">"), "&lt;/script&gt;&lt;img src=x onerror=&quot;f()&quot;&gt;");
}

TEST(HtmlText, LettersOfAllLanguagesStay) {
    EXPECT_EQ(html("Gr\u00f6\u00dfe \u00b5m \u6a21\u5177 \U0001f527"),
              "Gr\u00f6\u00dfe \u00b5m \u6a21\u5177 \U0001f527");
}

TEST(HtmlText, ControlCharactersAreSeen) {
    EXPECT_EQ(html(std::string_view("a\0b\x1b[31m\x7f", 9)), "a&#x2400;b&#x241b;[31m&#x2421;");
    EXPECT_EQ(html("a\tb\nc"), "a\tb\nc");
    EXPECT_EQ(html("\u0085"), "[U+0085]");
}

TEST(HtmlText, MarksThatTurnTextAreSeen) { EXPECT_EQ(html("a\u202eb\u2066c\u200fd"), "a[U+202E]b[U+2066]c[U+200F]d"); }

TEST(HtmlText, BytesThatAreNoUtf8BecomeTheReplacementCharacter) {
    EXPECT_EQ(html("a\xff"
                   "b"),
              "a\ufffd"
              "b");
    EXPECT_EQ(html("\xc0\xaf"), "\ufffd\ufffd");                      // overlong
    EXPECT_EQ(html("\xed\xa0\x80"), "\ufffd\ufffd\ufffd");            // half of a surrogate pair
    EXPECT_EQ(html("\xf4\x90\x80\x80"), "\ufffd\ufffd\ufffd\ufffd");  // beyond U+10FFFF
    EXPECT_EQ(html("\xe2\x82"), "\ufffd\ufffd");                      // cut short
}

TEST(HtmlText, JsonHasNoLessThan) {
    EXPECT_EQ(json_for_html("{\"a\":\"</script><!--\"}"), "{\"a\":\"\\u003c/script>\\u003c!--\"}");
}

}  // namespace
}  // namespace clsurf::io::html_text_test
