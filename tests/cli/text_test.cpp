#include "cli/text.h"

#include <gtest/gtest.h>

#include <limits>

#include "cli/progress_bar.h"

namespace clsurf::cli::text_test {
namespace {

TEST(Text, CountsCodePointsNotBytes) {
    EXPECT_EQ(columns_of("mm/s\u00b2"), 5U);
    EXPECT_EQ(columns_of("1 \u2026 100 \u00b5m"), 10U);
}

TEST(Text, BreaksBetweenWordsOnly) {
    // "aa bb" has 5 columns; a third word does not fit in 7.
    EXPECT_EQ(wrap("aa bb cc", 7), (std::vector<std::string>{"aa bb", "cc"}));
    EXPECT_EQ(wrap("aa bb cc", 8), (std::vector<std::string>{"aa bb cc"}));
    EXPECT_EQ(wrap("longest a", 3), (std::vector<std::string>{"longest", "a"}));
    EXPECT_TRUE(wrap("  \n ", 10).empty());
}

TEST(Text, BreaksByColumnsNotByBytes) {
    // Five letters of two bytes each and a blank between: 5 + 1 + 5 columns.
    const std::string word = "\u00b5\u00b5\u00b5\u00b5\u00b5";
    EXPECT_EQ(wrap(word + " " + word, 11).size(), 1U);
    EXPECT_EQ(wrap(word + " " + word, 10).size(), 2U);
}

TEST(Text, FillsParagraphsAndKeepsExamples) {
    const std::vector<Paragraph> paragraphs = paragraphs_of("one\ntwo\n\n  clsurf a\n  clsurf b\nthree");
    ASSERT_EQ(paragraphs.size(), 3U);
    EXPECT_EQ(paragraphs[0].text, "one two");
    EXPECT_TRUE(paragraphs[1].literal);
    EXPECT_EQ(paragraphs[1].text, "  clsurf a\n  clsurf b\n");
    EXPECT_EQ(paragraphs[2].text, "three");
}

TEST(ProgressLine, FillsItsBarByTheFraction) {
    EXPECT_EQ(progress_line("drawing", 0.5, 80), "[##########          ]  50 % drawing");
    EXPECT_EQ(progress_line("drawing", 1, 80), "[####################] 100 % drawing");
}

TEST(ProgressLine, TakesAnyNumber) {
    EXPECT_EQ(progress_line("x", -1, 80), progress_line("x", 0, 80));
    EXPECT_EQ(progress_line("x", 7, 80), progress_line("x", 1, 80));
    EXPECT_EQ(progress_line("x", std::numeric_limits<double>::quiet_NaN(), 80), progress_line("x", 0, 80));
}

TEST(ProgressLine, IsCutBetweenCharacters) {
    const std::string line = progress_line("\u00b5\u00b5\u00b5", 0, 31);
    EXPECT_EQ(columns_of(line), 31U);
    EXPECT_TRUE(line.ends_with("\u00b5"));
}

}  // namespace
}  // namespace clsurf::cli::text_test
