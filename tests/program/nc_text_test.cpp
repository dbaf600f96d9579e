// Numbers of NC programs.

#include <gtest/gtest.h>

#include "program/text/nc_text.h"

namespace clsurf::nc_text_test {
namespace {

TEST(NcText, WritesNumbers) {
    EXPECT_EQ(nc_number(-12.5, 3), "-12.500");
    EXPECT_EQ(nc_number(0.0004, 3), "0.000");
    EXPECT_EQ(nc_number(-0.0004, 3), "0.000");
    EXPECT_EQ(nc_number(-0.0, 0), "0");
    EXPECT_EQ(nc_number(-0.4, 0), "0");
    EXPECT_EQ(nc_number(7.6, 0), "8");
}

TEST(NcText, WritesSigns) {
    EXPECT_EQ(signed_nc_number(12.5, 2), "+12.50");
    EXPECT_EQ(signed_nc_number(-12.5, 2), "-12.50");
    EXPECT_EQ(signed_nc_number(-0.001, 2), "+0.00");
}

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
