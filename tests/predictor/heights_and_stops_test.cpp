// Reports on heights and stops on one pass of a plane.

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "planted_score.h"
#include "predictor/defects.h"
#include "support/plane_zigzag.h"

namespace clsurf::heights_and_stops_test {
namespace {

using test::lift;
using test::plane_zigzag;

constexpr std::uint32_t programmed_pass = 12;

/// Replaces the line of pass 12 by lines that end at `ends`, followed by its last point.
void program_pass(planted::PlantedLog& log, std::string_view lines, const std::vector<double>& ends) {
    constexpr std::uint32_t line_of_pass = 2 * programmed_pass + 2;
    std::size_t at = 0;
    for (std::uint32_t line = 1; line < line_of_pass; ++line) at = log.program.find('\n', at) + 1;
    log.program.replace(at, log.program.find('\n', at) + 1 - at, lines);
    for (std::size_t i = 0; i < log.line.size(); ++i) {
        if (log.line[i] == line_of_pass)
            for (const double end : ends) log.line[i] += log.commanded[0][i] > end ? 1 : 0;
        else if (log.line[i] > line_of_pass)
            log.line[i] += static_cast<std::uint32_t>(ends.size());
    }
}

/// A zigzag with the tool 8 µm above the plane on pass 12 from x = 10 to 14, as programmed or not, at `speed` [mm/s].
planted::PlantedLog raised_pass(bool programmed, double speed = 50) {
    planted::PlantedLog log = plane_zigzag(
        [speed](int k, double x, double) { return k == programmed_pass && x > 10 && x < 14 ? speed : 50.0; });
    lift(log, 0.008, 10, 14, [](int k) { return k == programmed_pass; });
    log.commanded[2] = log.measured[2];
    if (programmed) program_pass(log, "X10\nX10.5 Z0.008\nX13.5\nX14 Z0\nX24\n", {10.0, 10.5, 13.5, 14.0});
    return log;
}

/// A point of pass 12 that is programmed 20 µm too high, 0.4 mm from the next ones. The controller makes a peak of it that is
/// 2 mm wide on either side.
planted::PlantedLog rounded_peak() {
    planted::PlantedLog log = plane_zigzag([](int, double, double) { return 50.0; });
    for (std::size_t i = 0; i < log.pass.size(); ++i) {
        if (log.pass[i] == programmed_pass)
            log.commanded[2][i] = 0.020 * std::max(0.0, 1 - std::abs(log.commanded[0][i] - 12) / 2);
    }
    log.measured[2] = log.commanded[2];
    program_pass(log, "X11.6\nX12 Z0.020\nX12.4 Z0\nX24\n", {11.6, 12.0, 12.4});
    return log;
}

// A control may deviate from the programmed path within its tolerance if it merges lines or rounds corners. A search for
// uneven point spacing in the program would be in vain.
TEST(Defects, OffTheirProgramAreTheControls) {
    for (const bool programmed : {false, true}) {
        const QualityReport report = planted::judge(raised_pass(programmed));
        ASSERT_EQ(report.defects.size(), 1U) << programmed;
        const Defect& defect = report.defects.front();
        EXPECT_EQ(defect.quantity, Quantity::relief);
        EXPECT_EQ(defect.cause, programmed ? Cause::point_spacing : Cause::path_tolerance);
        EXPECT_NEAR(defect.depth, 0.008, 0.001);
        EXPECT_FALSE(defect.pit);
    }
}

// The path and the program agree at the peak only. Beside it, the path is up to 16 µm above the program. Most of the section is
// therefore off the program, but the point in the program is what makes the peak.
TEST(Defects, OfAPointThatTheControllerRoundsOffAreThePrograms) {
    const QualityReport report = planted::judge(rounded_peak());
    ASSERT_EQ(report.defects.size(), 1U);
    EXPECT_EQ(report.defects.front().cause, Cause::point_spacing);
    // The mean over 15 ms, 0.75 mm: 20 − 20 · (0.75 / 4) / 2 µm.
    EXPECT_NEAR(report.defects.front().depth, 0.018, 0.0015);
}

// A controller slows down for a point that is programmed too high. This does not cause the height, so the report must include
// it.
TEST(Defects, OfAProgrammedHeightHaveItsDepthWhateverTheSpeedDoes) {
    for (const double speed : {49.0, 36.0, 10.0}) {
        const QualityReport report = planted::judge(raised_pass(true, speed));
        // 80 % slower is a separate finding, which the height does not explain.
        ASSERT_EQ(report.defects.size(), speed < 20 ? 2U : 1U) << speed;
        if (speed < 20) { EXPECT_EQ(report.defects.front().quantity, Quantity::speed); }
        const Defect& defect = report.defects.back();
        EXPECT_EQ(defect.quantity, Quantity::relief);
        EXPECT_EQ(defect.cause, Cause::point_spacing);
        EXPECT_NEAR(defect.depth, 0.008, 0.001);
        EXPECT_FALSE(defect.pit);
        EXPECT_NEAR(defect.speed_jump, speed - 50, 1);
    }
}

/// Peaks at x = 12, 0.4 mm wide on either side: `height` [mm] on pass 12, where the tool is slow, as its program says, and `beside`
/// on pass 13.
planted::PlantedLog peaks(double height, double beside) {
    planted::PlantedLog log = plane_zigzag(
        [](int k, double x, double) { return k == programmed_pass && std::abs(x - 12) < 1.5 ? 20.0 : 50.0; });
    for (std::size_t i = 0; i < log.pass.size(); ++i) {
        const double shape = std::max(0.0, 1 - std::abs(log.commanded[0][i] - 12) / 0.4);
        if (log.pass[i] == programmed_pass) log.commanded[2][i] = height * shape;
        if (log.pass[i] == programmed_pass + 1) log.commanded[2][i] = beside * shape;
    }
    log.measured[2] = log.commanded[2];
    program_pass(log, fmt::format("X11.6\nX12 Z{}\nX12.4 Z0\nX24\n", height), {11.6, 12.0, 12.4});
    return log;
}

// Heights are means over 15 ms. That is 0.3 mm where the tool is slow, and 0.75 mm on the adjacent passes: there the effect of the
// peak is wider than the peak.
TEST(Defects, OfAPeakAreNotOfThePassesBesideIt) {
    for (const double height : {0.02, 0.1, -0.1}) {
        const QualityReport report = planted::judge(peaks(height, 0));
        int reliefs = 0;
        for (const Defect& defect : report.defects) {
            for (const DefectSection& section : defect.sections) EXPECT_EQ(section.pass, programmed_pass + 1) << height;
            if (defect.quantity != Quantity::relief) continue;
            ++reliefs;
            EXPECT_EQ(defect.pit, height < 0);
            EXPECT_NEAR(defect.depth, std::abs(height), 0.2 * std::abs(height));
        }
        EXPECT_EQ(reliefs, 1) << height;
    }
}

TEST(Defects, OfAPassBesideAPeakStayIfItLiesOffItself) {
    const QualityReport report = planted::judge(peaks(0.02, -0.03));
    EXPECT_TRUE(std::any_of(report.defects.begin(), report.defects.end(), [](const Defect& defect) {
        return defect.pit && defect.sections.front().pass == programmed_pass + 2;
    }));
}

// A feed hold: the tool brakes from 50 mm/s, and stands on the surface. With 2500 mm/s² it is slower than half of its speed over
// 25² / 2500 = 0.25 mm, less than a step-over.
TEST(Defects, OfAStopAreFoundHoweverShortTheyAre) {
    for (const double apart : {0.3, 1.0}) {
        for (const double braking : {500.0, 2500.0}) {
            for (const double place : {12.03, 12.08, 12.2}) {
                const planted::PlantedLog log = plane_zigzag(
                    [=](int k, double x, double) {
                        const double speed = std::sqrt(2 * braking * std::abs(x - place));
                        return k == programmed_pass ? std::clamp(speed, 0.05, 50.0) : 50.0;
                    },
                    apart);
                const QualityReport report = planted::judge(log);
                ASSERT_EQ(report.defects.size(), 1U) << apart << " mm, " << braking << " mm/s², " << place << " mm";
                const Defect& defect = report.defects.front();
                EXPECT_EQ(defect.quantity, Quantity::speed);
                EXPECT_EQ(defect.severity, 3);
                EXPECT_LT(defect.speed_jump, -25);
                EXPECT_NEAR(defect.place.tip.x(), place, 0.2);
                ASSERT_EQ(defect.sections.size(), 1U);
                EXPECT_EQ(defect.sections.front().pass, 13);
            }
        }
    }
}

}  // namespace
}  // namespace clsurf::heights_and_stops_test
