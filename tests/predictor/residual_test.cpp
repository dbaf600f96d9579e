// Residuals near a border, with few passes on one side: which pass has the fault, with numbers computed by hand.
#include "predictor/residual.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace clsurf::residual_test {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// Values on the passes next to pass `k`, the adjacent one first, as many as the predictor uses: five on each side, or nine
/// in all.
struct Beside {
    std::vector<float> left, right;
};
Beside beside_pass(const std::vector<float>& all, std::size_t k) {
    const std::size_t before = k, after = all.size() - k - 1;
    Beside result;
    const auto aside = [](std::size_t here, std::size_t there) { return std::min(here, there < 5 ? 9 - there : 5); };
    for (std::size_t i = 1; i <= aside(before, after); ++i) result.left.push_back(all[k - i]);
    for (std::size_t i = 1; i <= aside(after, before); ++i) result.right.push_back(all[k + i]);
    return result;
}

std::vector<float> residuals_of(const std::vector<float>& all) {
    std::vector<float> result;
    for (std::size_t k = 0; k < all.size(); ++k) {
        const Beside beside = beside_pass(all, k);
        result.push_back(all[k] - usual_around(all[k], beside.left, beside.right));
    }
    return result;
}

/// The reliefs of passes with these heights on a plane: above the chord between both neighbours.
std::vector<float> reliefs_of(const std::vector<float>& heights) {
    std::vector<float> result(heights.size(), none);
    for (std::size_t k = 1; k + 1 < heights.size(); ++k)
        result[k] = heights[k] - 0.5F * (heights[k - 1] + heights[k + 1]);
    return result;
}

/// The residual of each pass; 0 if it is unknown.
std::vector<float> marks_of(const std::vector<float>& heights) {
    const std::vector<float> reliefs = reliefs_of(heights);
    std::vector<float> result;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        const Beside beside = beside_pass(reliefs, k);
        const float mark = relief_mark(reliefs[k], beside.left, beside.right);
        result.push_back(mark == mark ? mark : 0);
    }
    return result;
}

/// 16 passes; those from `first` to `last` differ by −30.
std::vector<float> with_band(std::size_t first, std::size_t last, std::size_t count = 16, float each = 0) {
    std::vector<float> all;
    for (std::size_t k = 0; k < count; ++k)
        all.push_back(100 + each * static_cast<float>(k) - (k >= first && k <= last ? 30.0F : 0.0F));
    return all;
}

void expect_near(const std::vector<float>& found, const std::vector<float>& expected, float room, std::size_t first,
                 std::size_t last) {
    for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_NEAR(found[k], expected[k], room) << "pass " << k + 1 << ", off " << first + 1 << " to " << last + 1;
}

TEST(Residual, OfOneToFourPassesIsTheirsWhereverTheyLie) {
    for (const float each : {0.0F, 2.0F}) {  // all equal; a constant change from pass to pass
        for (std::size_t width = 1; width <= (each > 0 ? 2U : 4U); ++width) {
            for (std::size_t first = 0; first + width <= 16; ++first) {
                const std::size_t last = first + width - 1;
                std::vector<float> truth(16, 0.0F);
                for (std::size_t k = first; k <= last; ++k) truth[k] = -30;
                // The median of an even number of values is up to three changes away.
                expect_near(residuals_of(with_band(first, last, 16, each)), truth, 3 * each, first, last);
            }
        }
    }
}

TEST(Residual, OfOnePassOfAFewIsItsOwn) {
    for (const std::size_t count : {3U, 4U, 5U, 6U, 7U}) {
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<float> truth(count, 0.0F);
            truth[k] = -30;
            expect_near(residuals_of(with_band(k, k, count)), truth, 0, k, k);
        }
    }
}

TEST(Residual, OfAnEvenChangeIsNothing) {
    for (const std::size_t count : {3U, 4U, 5U, 8U, 16U}) {
        std::vector<float> all;
        for (std::size_t k = 0; k < count; ++k) all.push_back(40 + 2 * static_cast<float>(k));
        const std::vector<float> found = residuals_of(all);
        for (std::size_t k = 1; k + 1 < count; ++k) EXPECT_NEAR(found[k], 0, 1e-4F) << k << " of " << count;
    }
}

TEST(Residual, OfPassesThatScatterIsNothingWithinTheirScatter) {
    // Pass 2 next to eight others, whose median is 100 and median absolute deviation 1.
    const std::vector<float> left{101}, right{99, 102, 98, 100, 101, 99, 100, 100};
    EXPECT_EQ(usual_around(97.1F, left, right, 3), 97.1F);
    EXPECT_EQ(usual_around(96.9F, left, right, 3), 100);
    EXPECT_EQ(usual_around(97.1F, left, right), 100);
}

TEST(Residual, OfPassesThatAlternateIsTheirWholeDifference) {
    std::vector<float> all;
    for (int k = 0; k < 16; ++k) all.push_back(k % 2 == 0 ? 1.0F : -1.0F);
    const std::vector<float> found = residuals_of(all);
    for (std::size_t k = 0; k < all.size(); ++k) EXPECT_EQ(found[k], 2 * all[k]) << k;
}

TEST(Residual, OfOnePassBesideOneIsUnknown) { EXPECT_TRUE(std::isnan(usual_around(1, std::vector{2.0F}, {}))); }

TEST(ReliefMark, OfAPassThatLiesOffIsItsHeight) {
    for (const std::size_t count : {5U, 6U, 7U, 16U}) {
        for (std::size_t k = 1; k + 1 < count; ++k) {
            std::vector<float> heights(count, 0.0F), truth(count, 0.0F);
            heights[k] = truth[k] = 6;
            expect_near(marks_of(heights), truth, 1e-5F, k, k);
        }
    }
}

TEST(ReliefMark, OfAPassThatLiesOffOnABarrelIsItsHeight) {
    for (std::size_t k = 1; k < 15; ++k) {
        std::vector<float> heights, truth(16, 0.0F);
        for (int i = 0; i < 16; ++i) heights.push_back(-0.5F * static_cast<float>(i * i));
        heights[k] += truth[k] = -6;
        expect_near(marks_of(heights), truth, 1e-4F, k, k);
    }
}

TEST(ReliefMark, OfTheOutermostPassIsUnknown) {
    // The surface may turn there: pass 2 and those beyond may be on it.
    for (const std::size_t k : {0U, 15U}) {
        std::vector<float> heights(16, 0.0F);
        heights[k] = 6;
        expect_near(marks_of(heights), std::vector<float>(16, 0.0F), 0, k, k);
    }
}

TEST(ReliefMark, OfThePassesBesideAPairIsNothingAtTheBorder) {
    // A pair rises above the chord from one of its passes to the adjacent one by half its height.
    for (const bool mirrored : {false, true}) {
        for (const std::size_t first : {0U, 1U}) {
            std::vector<float> heights(16, 0.0F);
            heights[first] = heights[first + 1] = 6;
            if (mirrored) std::reverse(heights.begin(), heights.end());
            std::vector<float> found = marks_of(heights);
            if (mirrored) std::reverse(found.begin(), found.end());
            EXPECT_NEAR(found[1], 3, 1e-5F);
            EXPECT_NEAR(found[2], first == 1 ? 3 : 0, 1e-5F);
        }
    }
}

TEST(ReliefMark, OfASurfaceThatTurnsAtTheBorderIsNothing) {
    for (std::size_t at = 1; at < 5; ++at) {
        for (const float part : {0.0F, 0.3F, 0.7F}) {  // of a step-over, where the crease lies between two passes
            std::vector<float> crease, fillet;
            for (int k = 0; k < 16; ++k) {
                const float along = static_cast<float>(k) - static_cast<float>(at) - part;
                crease.push_back(10 * std::max(0.0F, along));
                fillet.push_back(along > 0 ? along * along : 0);
            }
            for (const float mark : marks_of(crease)) EXPECT_NEAR(mark, 0, 1e-4F) << at << ' ' << part;
            for (const float mark : marks_of(fillet)) EXPECT_NEAR(mark, 0, 1e-4F) << at << ' ' << part;
            std::reverse(fillet.begin(), fillet.end());
            for (const float mark : marks_of(fillet)) EXPECT_NEAR(mark, 0, 1e-4F) << at << ' ' << part;
        }
    }
}

}  // namespace
}  // namespace clsurf::residual_test
