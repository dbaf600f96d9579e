#include "core/spelling.h"

#include <array>

#include <gtest/gtest.h>

namespace clsurf::spelling_test {
namespace {

constexpr std::array<std::string_view, 3> words{"speed", "acceleration", "jerk"};

TEST(Spelling, FindsAWordWithOneLetterWrong) { EXPECT_EQ(nearest_word("sped", words), "speed"); }
TEST(Spelling, CountsSwappedLettersOnce) { EXPECT_EQ(nearest_word("jrek", words), "jerk"); }
TEST(Spelling, SaysNothingWhenNothingIsNear) { EXPECT_EQ(did_you_mean("colour", words), ""); }

}  // namespace
}  // namespace clsurf::spelling_test
