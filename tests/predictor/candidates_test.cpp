// Candidates: which sites differ from their adjacent passes, and which of them belong together.
#include "predictor/candidates.h"

#include <algorithm>
#include <deque>
#include <vector>

#include <gtest/gtest.h>

#include "predictor/sites.h"
#include "support/made_surface.h"

namespace clsurf::candidates_test {
namespace {

constexpr double apart = 0.4;

Thresholds thresholds_of_speed() {
    Thresholds thresholds;
    thresholds.of = {0.03F, 1000, 1, 1};
    thresholds.usual_speed = 50;
    thresholds.least_speed = 12.5F;
    return thresholds;
}

/// Passes of 40 mm at 50 mm/s, from `changed` on at other speeds.
test::MadeSurface passes_at(std::size_t changed, const std::vector<double>& speeds) {
    std::vector<double> all(21, 50);
    std::copy(speeds.begin(), speeds.end(), all.begin() + static_cast<std::ptrdiff_t>(changed));
    return test::zigzag_of_speeds(all, 40, apart);
}

/// The sites of a pass, counted without links.
std::vector<PointIndex> sites_of(const test::MadeSurface& made, const Signals& signals, std::size_t pass) {
    const Sites sites(made.surface, signals);
    const Pass& of = made.passes[2 * pass];
    std::vector<PointIndex> found;
    sites.for_each(of.first, of.last + 1, [&](PointIndex site) { found.push_back(site); });
    return found;
}

std::vector<PointIndex> points_of(const DefectCandidates& candidates) {
    std::vector<PointIndex> points;
    for (const DefectCandidate* candidate : candidates) points.push_back(candidate->point);
    return points;
}

TEST(FindCandidates, AreTheSitesOfThePassThatDiffersOnly) {
    // 10 % slower: (45 − 50) / 50 is more than three times the threshold. The passes on both sides have the same step, but
    // their residual is zero.
    const test::MadeSurface made = passes_at(10, {45});
    const Signals signals = made.signals();
    const ArcLength arc_length(made.surface.positions);
    const Thresholds thresholds = thresholds_of_speed();
    FoundCandidates found = find_candidates(made.surface, signals, arc_length, thresholds);
    const std::vector<PointIndex> sites = sites_of(made, signals, 10);
    ASSERT_GT(sites.size(), 150U);
    EXPECT_EQ(points_of(found.candidates), sites);
    constexpr std::size_t speed = index_of(Quantity::speed);
    for (const DefectCandidate* candidate : found.candidates) {
        EXPECT_EQ(candidate->pass, 20U);
        EXPECT_NEAR(candidate->comparison.residual[speed], -0.1, 1e-3);
        EXPECT_NEAR(candidate->share[speed], 0.1 / 0.03, 0.03);
        EXPECT_NEAR(candidate->score[speed], 0.1 / 0.03, 0.03);
    }
    EXPECT_EQ(found.with_share_of(Quantity::speed).size(), sites.size());
    EXPECT_TRUE(found.with_share_of(Quantity::normal_deviation).empty());
}

TEST(FindCandidates, OfOppositeSignsAreNextToEachOther) {
    const test::MadeSurface made = passes_at(10, {45, 55});
    const Signals signals = made.signals();
    const ArcLength arc_length(made.surface.positions);
    const FoundCandidates found = find_candidates(made.surface, signals, arc_length, thresholds_of_speed());
    std::vector<PointIndex> sites = sites_of(made, signals, 10);
    const std::vector<PointIndex> fast = sites_of(made, signals, 11);
    sites.insert(sites.end(), fast.begin(), fast.end());
    EXPECT_EQ(points_of(found.candidates), sites);
    for (const DefectCandidate* candidate : found.candidates) {
        const double expected = candidate->pass == 20 ? -0.1 : 0.1;
        EXPECT_NEAR(candidate->comparison.residual[index_of(Quantity::speed)], expected, 1e-3);
    }
    // Their signs do not separate them here.
    EXPECT_EQ(group_candidates(found.candidates, made.surface, arc_length, 1).size(), 1U);
}

TEST(FindCandidates, AreNoneWherePassesAgree) {
    const test::MadeSurface made = passes_at(10, {});
    const Signals signals = made.signals();
    const ArcLength arc_length(made.surface.positions);
    const Thresholds thresholds = thresholds_of_speed();
    EXPECT_TRUE(find_candidates(made.surface, signals, arc_length, thresholds).candidates.empty());
    EXPECT_TRUE(find_candidates(made.surface, signals, arc_length, thresholds, {}, {}).candidates.empty());
    // 1.4 % is less than half the threshold of 3 %, 1.6 % is more.
    for (const double percent : {1.4, 1.6}) {
        const test::MadeSurface other = passes_at(10, {50 * (1 - percent / 100)});
        const Signals of_other = other.signals();
        const FoundCandidates found =
            find_candidates(other.surface, of_other, ArcLength(other.surface.positions), thresholds);
        EXPECT_EQ(found.candidates.empty(), percent < 1.5);
    }
}

/// One-way passes along X with a point every 0.5 mm: point 100 k + i is at x = i / 2 on pass k. They are a little more than
/// a step-over apart: passes that are closer than that are also joined from the other side of two clean ones.
struct Grid {
    static constexpr PointIndex points = 100;
    static constexpr float spacing = 0.41F;
    ClSurface surface;
    std::deque<DefectCandidate> kept;

    explicit Grid(PointIndex passes) {
        surface.step_over = apart;
        for (PointIndex k = 0; k < passes; ++k) {
            surface.passes.push_back({k * points, (k + 1) * points - 1, PassKind::cut});
            for (PointIndex i = 0; i < points; ++i) {
                surface.positions.x.push_back(0.5F * static_cast<float>(i));
                surface.positions.y.push_back(spacing * static_cast<float>(k));
                surface.positions.z.push_back(0);
                surface.neighbours.left.push_back(k + 1 < passes ? points : Adjacency::none);
                surface.neighbours.right.push_back(k > 0 ? -points : Adjacency::none);
            }
        }
    }
    /// Groups of candidates at these points, joined along a pass if less than 1 mm apart.
    std::vector<std::vector<PointIndex>> groups(const std::vector<PointIndex>& at) {
        kept.clear();
        DefectCandidates candidates;
        for (const PointIndex point : at) {
            kept.emplace_back().point = point;
            candidates.push_back(&kept.back());
        }
        std::vector<std::vector<PointIndex>> result;
        for (const DefectCandidates& group : group_candidates(candidates, surface, ArcLength(surface.positions), 1))
            result.push_back(points_of(group));
        return result;
    }
};
using PointGroups = std::vector<std::vector<PointIndex>>;

TEST(GroupCandidates, MakesNoGroupOfNoneAndOneOfOne) {
    EXPECT_EQ(Grid(3).groups({}), PointGroups{});
    EXPECT_EQ(Grid(3).groups({142}), (PointGroups{{142}}));
}

TEST(GroupCandidates, JoinsRunsOfAPassThatTouch) {
    // Less than 1 mm apart along the pass: 12 and 13, but not 12 and 14.
    EXPECT_EQ(Grid(1).groups({10, 11, 12, 13, 14}), (PointGroups{{10, 11, 12, 13, 14}}));
    EXPECT_EQ(Grid(1).groups({10, 11, 12, 14, 15}), (PointGroups{{10, 11, 12}, {14, 15}}));
    // The last point of a pass and the first of the next one are far apart.
    EXPECT_EQ(Grid(2).groups({99, 100}), (PointGroups{{99}, {100}}));
}

TEST(GroupCandidates, JoinsAdjacentPassesAndAcrossOneCleanPass) {
    EXPECT_EQ(Grid(4).groups({10, 110}), (PointGroups{{10, 110}}));
    EXPECT_EQ(Grid(4).groups({10, 111}), (PointGroups{{10}, {111}})) << "0.5 mm along the feed: more than a step-over";
    EXPECT_EQ(Grid(4).groups({10, 210}), (PointGroups{{10, 210}}));
    EXPECT_EQ(Grid(4).groups({10, 310}), (PointGroups{{10}, {310}}));
    // Two groups side by side, which interleave in the order of their points; a run on pass 1 joins the first one.
    EXPECT_EQ(Grid(4).groups({10, 50, 110, 111, 112, 150, 212}), (PointGroups{{10, 110, 111, 112, 212}, {50, 150}}));
}

}  // namespace
}  // namespace clsurf::candidates_test
