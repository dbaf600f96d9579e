#include "program/text/lexer.h"

#include <charconv>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace clsurf::lexer_test {
namespace {

double decimal(std::string_view text) {
    double value = -1;
    EXPECT_EQ(read_decimal(text, 0, value), text.size()) << text;
    return value;
}

TEST(Decimal, TakesWhatTapesWrite) {
    EXPECT_EQ(decimal("1"), 1.0);
    EXPECT_EQ(decimal("1."), 1.0);
    EXPECT_EQ(decimal(".5"), 0.5);
    EXPECT_EQ(decimal("-.5"), -0.5);
    EXPECT_EQ(decimal("+007.10"), 7.1);
}

TEST(Decimal, StopsBeforeAnExponentAndRefusesAnEmptyNumber) {
    double value = 0;
    EXPECT_EQ(read_decimal("1E5", 0, value), 1u);
    EXPECT_EQ(read_decimal("-.", 0, value), 0u);
    EXPECT_EQ(read_decimal("", 0, value), 0u);
}

TEST(Decimal, IsCorrectlyRounded) {
    // Compared with the standard library's reader on 10^5 random texts of up to 22 digits.
    std::mt19937_64 random(1);
    for (int i = 0; i < 100'000; ++i) {
        std::string text;
        const int whole = static_cast<int>(random() % 12);
        const int decimals = static_cast<int>(random() % 11);
        for (int k = 0; k <= whole; ++k) text += static_cast<char>('0' + random() % 10);
        text += '.';
        for (int k = 0; k < decimals; ++k) text += static_cast<char>('0' + random() % 10);
        double expected = 0;
        std::from_chars(text.data(), text.data() + text.size(), expected, std::chars_format::fixed);
        ASSERT_EQ(decimal(text), expected) << text;
    }
}

TEST(PlainBlock, ReadsWordsWithAndWithoutBlanks) {
    Words words;
    ASSERT_EQ(read_plain("n10g1x1.5 Y-2f300", words), PlainResult::plain);
    EXPECT_EQ(words.g_count, 1);
    EXPECT_EQ(words.g[0], 10);
    EXPECT_EQ(words.of('X'), 1.5);
    EXPECT_EQ(words.of('Y'), -2.0);
    EXPECT_EQ(words.of('F'), 300.0);
}

TEST(PlainBlock, LeavesExpressionsCommentsAndControlWordsToTheDialect) {
    Words words;
    for (const char* text : {"X[1+2]", "X1 (note)", "O100 sub", "#1=5", "TRAORI", "X=AC(5)", "X1 X2", "X"}) {
        EXPECT_EQ(read_plain(text, words), PlainResult::complex) << text;
    }
}

}  // namespace
}  // namespace clsurf::lexer_test
