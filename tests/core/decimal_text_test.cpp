// Numbers with a fixed number of decimals.

#include "core/decimal_text.h"

#include <gtest/gtest.h>

namespace clsurf::decimal_text_test {
namespace {

TEST(DecimalText, HasSoManyDecimalsAndNoNegativeZero) {
    EXPECT_EQ(fixed_text(-12.5, 3), "-12.500");
    EXPECT_EQ(fixed_text(0.0004, 3), "0.000");
    EXPECT_EQ(fixed_text(-0.0004, 3), "0.000");
    EXPECT_EQ(fixed_text(-0.0, 0), "0");
    EXPECT_EQ(fixed_text(-0.4, 0), "0");
    EXPECT_EQ(fixed_text(7.6, 0), "8");
}

TEST(DecimalText, HasASignWhereItIsAskedFor) {
    EXPECT_EQ(signed_text(12.5, 2), "+12.50");
    EXPECT_EQ(signed_text(-12.5, 2), "-12.50");
    EXPECT_EQ(signed_text(-0.001, 2), "+0.00");
}

}  // namespace
}  // namespace clsurf::decimal_text_test
