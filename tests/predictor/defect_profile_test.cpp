#include "predictor/defect_profile.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/made_surface.h"

namespace clsurf::defect_profile_test {
namespace {

constexpr double apart = 0.4;
constexpr double length = 40;

/// Lines are numbered like the passes.
LineMap lines_of(const test::MadeSurface& made, std::vector<std::uint32_t>& columns) {
    columns.assign(static_cast<std::size_t>(made.path.count), 0);
    std::uint32_t line = 0;
    for (const Pass& pass : made.passes) {
        if (pass.kind == PassKind::cut) ++line;
        for (PointIndex i = pass.first; i <= pass.last; ++i) columns[static_cast<std::size_t>(i)] = line;
    }
    const ChannelView view = view_of(columns);
    Program none;
    none.files.emplace_back();
    return {view, none, nullptr};
}

/// A defect in the middle of a pass, `half` mm to each side.
Defect middle_of(const test::MadeSurface& made, std::size_t pass, double half) {
    std::size_t cut = 0;
    for (const Pass& p : made.passes) {
        if (p.kind != PassKind::cut || cut++ != pass) continue;
        Defect d;
        d.point = (p.first + p.last) / 2;
        const double step = (made.surface.positions[d.point + 1] - made.surface.positions[d.point]).norm();
        const auto points = static_cast<PointIndex>(std::lround(half / step));
        DefectSection run;
        run.points = {d.point - points, d.point + points};
        d.sections = {run};
        return d;
    }
    return {};
}

TEST(DefectProfile, HasTheSpeedsOfFivePassesOverTheSamePath) {
    std::vector<double> speeds(11, 50);
    for (std::size_t k = 3; k <= 7; ++k)
        speeds[k] = 40 + static_cast<double>(k);  // 43 … 47; the sixth pass has the defect
    const test::MadeSurface made = test::zigzag_of_speeds(speeds, length, apart);
    const Signals signals = made.signals();
    std::vector<std::uint32_t> columns;
    const LineMap lines = lines_of(made, columns);
    const DefectProfile profile = profile_of(middle_of(made, 5, 4), made.surface, signals, lines, {});
    EXPECT_NEAR(profile.section_length, 8, 0.1);
    ASSERT_FALSE(profile.along.empty());
    EXPECT_NEAR(profile.along.front(), -6, 0.1) << "three quarters of the section before it";
    EXPECT_NEAR(profile.along.back(), 14, 0.1);
    // The sixth pass runs along −X: its left is −Y, where the slower passes are.
    for (std::size_t i = 0; i < profile.along.size(); ++i) {
        for (std::size_t k = 0; k < DefectProfile::passes; ++k)
            EXPECT_NEAR(profile.speed[k][i], 43.0 + static_cast<double>(k), 0.1) << k << " of " << profile.along[i];
        EXPECT_NEAR(profile.usual_speed[i], 45, 0.1);
    }
    ASSERT_EQ(profile.lines.size(), 1U);
    EXPECT_EQ(profile.lines[0].line, 6U);
}

TEST(DefectProfile, ComparesWithPassesThatAreNotAtFault) {
    // The middle five of eleven passes are slow, as if a feed is lower over a feature.
    const test::MadeSurface made = test::zigzag_of_speeds({50, 50, 50, 35, 35, 35, 35, 35, 50, 50, 50}, length, apart);
    const Signals signals = made.signals();
    std::vector<std::uint32_t> columns;
    const LineMap lines = lines_of(made, columns);
    Defect defect = middle_of(made, 5, 4);
    for (const std::size_t pass : {3, 4, 6, 7}) defect.sections.push_back(middle_of(made, pass, 4).sections[0]);
    const DefectProfile profile = profile_of(defect, made.surface, signals, lines, {});
    for (std::size_t i = 0; i < profile.along.size(); ++i) {
        EXPECT_NEAR(profile.speed[DefectProfile::at_fault - 1][i], 35, 0.5) << "the curves are of the next passes";
        EXPECT_NEAR(profile.usual_speed[i], 50, 0.5) << "the band is of those that are not at fault";
    }
}

TEST(DefectProfile, ShowsAPassThatLiesLower) {
    const auto lower = [](const Vec3& p, const Vec3&) {
        return Vec3(p.x(), p.y(), std::abs(p.y() - 5 * apart) < 0.01 ? -0.008 : 0.0);
    };
    const test::MadeSurface made = test::flat_zigzag(11, length, apart, 50, lower);
    const Signals signals = made.signals();
    std::vector<std::uint32_t> columns;
    const LineMap lines = lines_of(made, columns);
    const DefectProfile profile = profile_of(middle_of(made, 5, 4), made.surface, signals, lines, {});
    EXPECT_EQ(profile.height_of, DefectProfile::HeightOf::measured);
    ASSERT_EQ(profile.across.size(), 11U);
    for (std::size_t k = 0; k < profile.across.size(); ++k) {
        EXPECT_NEAR(profile.across[k], apart * (static_cast<double>(k) - 5), 1e-4);
        EXPECT_NEAR(profile.across_height[k], k == 5 ? -0.008 : 0.0, 1e-5) << k;
    }
}

TEST(DefectProfile, OfAlternatingLagComparesPassesOfOneDirection) {
    // Passes along X are 6 µm higher than those along −X, and the sixth, along −X, 3 µm higher than the others.
    const auto alternating = [](const Vec3& p, const Vec3& feed) {
        const double fault = std::abs(p.y() - 5 * apart) < 0.01 ? 0.003 : 0.0;
        return Vec3(p.x(), p.y(), (feed.x() > 0 ? 0.006 : 0.0) + fault);
    };
    const test::MadeSurface made = test::flat_zigzag(11, length, apart, 50, alternating);
    const Signals signals = made.signals();
    std::vector<std::uint32_t> columns;
    const LineMap lines = lines_of(made, columns);
    QualityReport report;
    report.defects = {middle_of(made, 5, 4), middle_of(made, 3, 4)};
    EXPECT_EQ(height_peers_of(report.defects[0], report), HeightPeers::nearest);
    report.defects[1].systematic = true;
    EXPECT_EQ(height_peers_of(report.defects[0], report), HeightPeers::same_direction);
    EXPECT_EQ(height_peers_of(report.defects[1], report), HeightPeers::nearest) << "it is the difference itself";
    const DefectProfile profile =
        profile_of(report.defects[0], made.surface, signals, lines, {}, HeightPeers::same_direction);
    EXPECT_NEAR(profile.usual_across, 0, 1e-5);
    const std::size_t middle = profile.along.size() / 2;
    EXPECT_NEAR(profile.usual_height[middle], profile.usual_across, 1e-5) << "both charts have one level";
    EXPECT_NEAR(profile.height[DefectProfile::at_fault][middle], 0.003, 1e-5);
    const DefectProfile all = profile_of(report.defects[1], made.surface, signals, lines, {});
    EXPECT_NEAR(all.usual_across, all.usual_height[all.along.size() / 2], 1e-5);
}

TEST(DefectProfile, ShowsThePassesOfAProgrammedMarkOverThoseThatAreNotOnIt) {
    // Two passes are programmed 8 µm higher on a cylinder across the feed. The machine follows them, or there is no
    // measurement.
    const auto place = [](const Vec3& p) {
        const bool high = p.y() > 4.5 * apart && p.y() < 6.5 * apart;
        return Vec3(p.x(), p.y(), p.y() * p.y() / 100 + (high ? 0.008 : 0.0));
    };
    for (const bool measured : {false, true}) {
        const test::Measure follows = [](const Vec3& p, const Vec3&) { return p; };
        const test::MadeSurface made =
            test::made_zigzag(std::vector<double>(12, 50), length, apart, measured ? follows : test::Measure(), place);
        const Signals signals = made.signals();
        std::vector<std::uint32_t> columns;
        const LineMap lines = lines_of(made, columns);
        QualityReport report;
        report.defects = {middle_of(made, 5, 4)};
        report.defects[0].quantity = Quantity::relief;
        report.defects[0].sections.push_back(middle_of(made, 6, 4).sections[0]);
        const ProgrammedMarks marks(made.surface, signals, report);
        const DefectProfile profile = profile_of(report.defects[0], made.surface, signals, lines, marks);
        EXPECT_EQ(profile.height_of, DefectProfile::HeightOf::programmed) << "a relief is one of the program";
        ASSERT_EQ(profile.across.size(), 11U);
        // The sixth pass runs along −X: the seventh is on its right, at +0.4 mm.
        for (std::size_t k = 0; k < profile.across.size(); ++k)
            EXPECT_NEAR(profile.across_height[k], k == 5 || k == 6 ? 0.008 : 0.0, 1e-4) << k << ' ' << measured;
        const std::size_t middle = profile.along.size() / 2;
        EXPECT_NEAR(profile.height[DefectProfile::at_fault][middle], 0.008, 1e-4);
        EXPECT_NEAR(profile.usual_height[middle], 0.0, 1e-4) << "of the four others one is at fault, too";
    }
}

}  // namespace
}  // namespace clsurf::defect_profile_test
