#include "limits/finding_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/not_finite.h"

namespace clsurf::finding_runs_test {
namespace {

struct Record {
    double factor = 0, uncertainty = 0, noise = uncertainty;
};

constexpr PointIndex longest_gap = 100;

/// Findings of records judged in blocks of `block`, on lines of `line` records.
std::vector<LimitFinding> found(const std::vector<Record>& records, std::size_t block = 1000, PointIndex line = 1000) {
    const StatedLimit limit{LimitedQuantity::acceleration, 'x', 2000};
    RecordRuns all;
    for (std::size_t begin = 0; begin < records.size(); begin += block) {
        RunFinder finder(limit);
        for (std::size_t i = begin; i < std::min(records.size(), begin + block); ++i)
            finder.add(static_cast<PointIndex>(i),
                       {2000 * records[i].factor, 2000 * records[i].uncertainty, 2000 * records[i].noise}, 2000);
        all.append(finder.finish());
    }
    return findings_of(all, longest_gap, [&](PointIndex point) { return static_cast<LineNumber>(1 + point / line); });
}

/// A constant 1.003, which noise hides in all but every seventh record.
std::vector<Record> steady(int records) {
    std::vector<Record> made;
    for (int i = 0; i < records; ++i) made.push_back({i % 7 == 3 ? 1.004 : 1.002, 0.0025});
    return made;
}

TEST(FindingRuns, ASteadyExcessThatNoiseHidesInPartsIsOneFinding) {
    for (const std::size_t block : {1000U, 64U, 3U, 1U}) {
        const std::vector<LimitFinding> findings = found(steady(700), block);
        ASSERT_EQ(findings.size(), 1u) << block;
        EXPECT_EQ(findings[0].points.first, 3);
        EXPECT_EQ(findings[0].points.last, 696);
        EXPECT_DOUBLE_EQ(findings[0].factor, 1.004);
    }
}

TEST(FindingRuns, AFactorIsThatOfThePeakWhateverTheBendMakesOfIt) {
    // As on a blend of micro_segments.parabolic: the curvature is largest at the peak.
    const std::vector<Record> bend{
        {0.55, 0.04, 0.002}, {1.044, 0.024, 0.002}, {1.067, 0.066, 0.002}, {0.9, 0.09, 0.002}};
    ASSERT_EQ(found(bend).size(), 1u);
    EXPECT_DOUBLE_EQ(found(bend)[0].factor, 1.067);
    EXPECT_DOUBLE_EQ(found(bend)[0].uncertainty, 0.066);
    EXPECT_EQ(found(bend)[0].point, 2);
    // Noise also makes larger values, which are not peaks.
    EXPECT_DOUBLE_EQ(found({{1.2, 0.01}, {1.23, 0.05}})[0].factor, 1.2);
}

TEST(FindingRuns, ItEndsWithItsLine) { EXPECT_EQ(found(steady(700), 64, 350).size(), 2u); }

TEST(FindingRuns, PeaksWithLessBetweenThemAreSeparatePlaces) {
    std::vector<Record> records(100, {0.999, 0.0025});
    records[40] = records[60] = {1.2, 0.0025};
    for (const std::size_t block : {1000U, 50U}) EXPECT_EQ(found(records, block).size(), 2u) << block;
}

TEST(FindingRuns, WhatLiesFarApartOrIsNotKnownBetweenIsSeparate) {
    std::vector<Record> records(400, {1.0, 0.01});
    records[10] = records[10 + longest_gap + 2] = {1.005, 0.004};
    EXPECT_EQ(found(records).size(), 2u);
    records[10 + longest_gap + 1] = {1.005, 0.004};
    EXPECT_EQ(found(records).size(), 1u);
    records[50].factor = missing<double>;
    EXPECT_EQ(found(records).size(), 2u);
}

}  // namespace
}  // namespace clsurf::finding_runs_test
