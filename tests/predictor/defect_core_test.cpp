#include "predictor/defect_core.h"

#include <vector>

#include <gtest/gtest.h>

namespace clsurf::defect_core_test {
namespace {

constexpr double joined = 1.0;  // [mm]

/// Candidates every 0.2 mm of one straight pass, with these multiples of the speed threshold.
struct Group {
    Positions positions;
    std::vector<DefectCandidate> kept;
    DefectCandidates candidates;

    explicit Group(const std::vector<float>& shares) {
        for (std::size_t k = 0; k < shares.size(); ++k) {
            positions.x.push_back(0.2F * static_cast<float>(k));
            positions.y.push_back(0);
            positions.z.push_back(0);
            DefectCandidate candidate{};
            candidate.point = static_cast<PointIndex>(k);
            candidate.share[index_of(Quantity::speed)] = candidate.share[index_of(Quantity::normal_deviation)] =
                shares[k];
            kept.push_back(candidate);
        }
        for (const DefectCandidate& candidate : kept) candidates.push_back(&candidate);
    }

    [[nodiscard]] CoreSites sites(Quantity quantity = Quantity::speed) const {
        return core_of(candidates, quantity, ArcLength(positions), joined);
    }
    [[nodiscard]] std::vector<PointIndex> core() const { return points(sites().core); }
    [[nodiscard]] double length(double enough = 10) const {
        return length_above_threshold(sites().core, candidates, Quantity::speed, ArcLength(positions), joined, enough);
    }
    [[nodiscard]] std::vector<PointIndex> rest() const { return points(sites().rest); }

    [[nodiscard]] static std::vector<PointIndex> points(const DefectCandidates& sites) {
        std::vector<PointIndex> found;
        for (const DefectCandidate* s : sites) found.push_back(s->point);
        return found;
    }
};

using Points = std::vector<PointIndex>;

TEST(DefectCore, EndsAtHalfOfThePeak) {
    const Group group({1, 3, 6, 10, 10, 6, 4, 2, 1});
    EXPECT_EQ(group.core(), (Points{2, 3, 4, 5}));
    EXPECT_TRUE(group.rest().empty());
}

TEST(DefectCore, OfASharpDipIsAsLongAsItPassesTheThreshold) {
    // At half of 33 the dip is 0.2 mm long, above the threshold 1.2 mm.
    Group group({0.6F, 1, 5, 15, 33, 20, 8, 2, 0.7F, 1, 1});
    EXPECT_EQ(group.core(), (Points{4, 5}));
    EXPECT_NEAR(group.length(), 1.2, 1e-6);
    EXPECT_GE(group.length(0.5), 0.5) << "that is enough";
    EXPECT_LT(group.length(0.5), 1.2);
    group.kept[2].comparison.residual[index_of(Quantity::speed)] = -1;  // overshoot before the dip
    EXPECT_NEAR(group.length(), 0.8, 1e-6);
    group.kept[6].pass = 1;
    EXPECT_NEAR(group.length(), 0.4, 1e-6);
}

TEST(DefectCore, OfAWeakPeakIsNotAsLongAsAStrongOneBesideIt) {
    const Group group({2, 3, 2, 2, 9, 9, 9});
    EXPECT_NEAR(length_above_threshold(CandidateSpan(group.candidates).first(2), group.candidates, Quantity::speed,
                                       ArcLength(group.positions), joined, 10),
                0.6, 1e-6);
}

TEST(DefectCore, BridgesTheZerosOfAnOscillation) {
    const Group group({4, 0, 4, 4, 0, 4});
    EXPECT_EQ(group.core(), (Points{0, 1, 2, 3, 4, 5}));
}

TEST(DefectCore, KeepsAPeakThatIsLessThanHalfOfAnotherOneBeyondADip) {
    // A slow section, 1.4 mm of small values, and an oscillation: 4 is less than half of 10.
    const Group group({10, 10, 10, 2, 0.5, 0.3, 0.2, 0.3, 0.5, 4, 1, 4, 1, 4});
    EXPECT_EQ(group.core(), (Points{0, 1, 2, 9, 10, 11, 12, 13}));
    EXPECT_TRUE(group.rest().empty());
    EXPECT_EQ(Group::points(group.sites(Quantity::normal_deviation).core), (Points{0, 1, 2})) << "heights swing";
    // The same in reverse order.
    const Group mirrored({4, 1, 4, 1, 4, 0.5, 0.3, 0.2, 0.3, 0.5, 2, 10, 10, 10});
    EXPECT_EQ(mirrored.core(), (Points{0, 1, 2, 3, 4, 11, 12, 13}));
}

TEST(DefectCore, ADipShorterThanWhatJoinsBelongsToThePeak) {
    // Overshoot 0.6 mm after a slow section: part of it.
    const Group group({10, 10, 10, 2, 0.5, 4, 4});
    EXPECT_EQ(group.core(), (Points{0, 1, 2}));
    EXPECT_TRUE(group.rest().empty());
}

TEST(DefectCore, ATailIsNoPeakOfItsOwn) {
    const Group falling({10, 10, 4, 4, 3, 3, 2, 2, 2, 1, 1, 1, 1, 1});
    EXPECT_EQ(falling.core(), (Points{0, 1}));
    EXPECT_TRUE(falling.rest().empty());
    const Group level({10, 10, 4, 3, 3, 3, 3, 3, 3, 4, 4, 4, 3, 3});  // no dip to half of what comes after it
    EXPECT_EQ(level.core(), (Points{0, 1}));
}

TEST(DefectCore, LeavesWhatIsMuchWeakerToItself) {
    // 3 is a fifth of 15.
    const Group group({15, 15, 15, 2, 0.5, 0.3, 0.2, 0.2, 0.3, 3, 3, 3});
    EXPECT_EQ(group.core(), (Points{0, 1, 2}));
    EXPECT_EQ(group.rest(), (Points{5, 6, 7, 8, 9, 10, 11}));
}

TEST(DefectCore, APeakBelowThreeThresholdsIsNone) {
    const Group group({10, 10, 10, 2, 0.1, 0.1, 0.1, 0.1, 0.1, 2.9, 2.9, 0.1});
    EXPECT_EQ(group.core(), (Points{0, 1, 2}));
    EXPECT_TRUE(group.rest().empty());
}

}  // namespace
}  // namespace clsurf::defect_core_test
