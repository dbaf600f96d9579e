// Texts of NC programs.

#include <gtest/gtest.h>

#include "program/text/nc_text.h"

namespace clsurf::nc_text_test {
namespace {

TEST(NcText, LeavesOutZeros) {
    EXPECT_EQ(without_end_zeros("12.500"), "12.5");
    EXPECT_EQ(without_end_zeros("+12.000"), "+12");
    EXPECT_EQ(without_end_zeros("0.0000"), "0");
    EXPECT_EQ(without_end_zeros("100"), "100");
}

TEST(NcText, FindsTheEndOfLines) {
    EXPECT_EQ(line_end_of("G1\r\nX1\n"), "\r\n");
    EXPECT_EQ(line_end_of("G1\nX1\r\n"), "\n");
    EXPECT_EQ(line_end_of("G1"), "\n");
    EXPECT_EQ(line_end_of("\n"), "\n");
}

}  // namespace
}  // namespace clsurf::nc_text_test
