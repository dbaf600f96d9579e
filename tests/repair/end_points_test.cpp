// The ends of passes: lines of the same lengths on every pass, up to the corner where it turns.

#include "repair/points/end_points.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "repair/line_edit.h"
#include "repair/optimizer.h"
#include "repair/parts.h"
#include "repair/points/resample.h"

namespace clsurf::end_points_test {
namespace {

std::vector<double> arc_lengths(const std::vector<AlignedPoint>& points) {
    std::vector<double> lengths;
    for (const AlignedPoint& point : points) lengths.push_back(point.arc_length);
    return lengths;
}

std::vector<AlignedPoint> every_half(double length) {
    std::vector<AlignedPoint> points;
    for (int k = 1; 0.5 * k < length; ++k) points.push_back({.arc_length = 0.5 * k, .number = 4 * k, .part = 0.125});
    return points;
}

TEST(EndPoints, ReplaceAlignedPointsUpToTheirReach) {
    const EndLines ends{.first = 0.25, .step = 1, .reach = 2.5};
    std::vector<AlignedPoint> points = every_half(8);
    fix_end_points(points, 8, true, true, ends);
    // Aligned points keep half a step from the last fixed one, at 2.25.
    EXPECT_EQ(arc_lengths(points),
              (std::vector<double>{0.25, 1.25, 2.25, 3, 3.5, 4, 4.5, 5, 8 - 2.25, 8 - 1.25, 8 - 0.25}));
    EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const AlignedPoint& p) { return p.fixed; }), 6);
    points = every_half(4);
    fix_end_points(points, 4, true, false, ends);
    EXPECT_EQ(arc_lengths(points), (std::vector<double>{0.25, 1.25, 2.25, 3, 3.5}));
    points = every_half(4);
    fix_end_points(points, 4, false, false, ends);
    EXPECT_EQ(arc_lengths(points), arc_lengths(every_half(4))) << "a section inside a pass";
}

TEST(EndPoints, OfAShortPassDoNotMeet) {
    std::vector<AlignedPoint> points = every_half(3);
    fix_end_points(points, 3, true, true, {.first = 0.25, .step = 1, .reach = 10});
    EXPECT_EQ(arc_lengths(points), (std::vector<double>{0.25, 1, 1.5, 2, 3 - 0.25}));
}

double uneven(int pass, double x) { return 0.3 + 0.11 * std::fmod(1.7 * pass + 3.1 * x, 1.0); }

TEST(EndPoints, LieAtTheSameDistancesFromAllCorners) {
    constexpr double length = 12, tolerance = 0.005;
    const Program program = read_text(wavy_zigzag(6, length, uneven, 0.1));  // flat enough for lines of 0.3 mm
    const ProgrammedSurface surface = build_programmed_surface(program);
    ResampleRules rules{.tolerance = tolerance, .spacing = 0.15, .chord_error = 0.001};
    rules.ends = {.first = 0.1, .step = 0.3, .reach = 1.5};
    LineEditor editor(program);
    for (const ResampledSegment& each : resample(program, surface, editor, rules, {}))
        editor.replace(each.first, each.last, each.points);
    const Program changed = read_text(editor.text(""));
    // Of each pass, the arc lengths of its points from both corners.
    std::vector<std::vector<double>> of_passes;
    for (int pass = 0; pass < 6; ++pass) {
        std::vector<Vec3> points;
        for (const Xyz& end : changed.motions.end) {
            const Vec3 p = end.vec();
            if (std::abs(p.y() - 0.4 * pass) < 1e-6 && p.z() < 2) points.push_back(p);
        }
        std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); });
        for (int side = 0; side < 2; ++side) {
            std::vector<double> distances;
            double distance = 0;
            for (std::size_t k = 1; k < points.size() && distance < 1.2; ++k) {
                distance += (points[k] - points[k - 1]).norm();
                distances.push_back(distance);
            }
            of_passes.push_back(distances);
            std::reverse(points.begin(), points.end());
        }
    }
    int alike = 0;
    for (const std::vector<double>& distances : of_passes) {
        ASSERT_GE(distances.size(), 4U);
        // The first pass begins with the plunge of the tool.
        alike += std::abs(distances[0] - 0.1) < 0.01 && std::abs(distances[1] - 0.4) < 0.01 &&
                         std::abs(distances[2] - 0.7) < 0.01 && std::abs(distances[3] - 1) < 0.01
                     ? 1
                     : 0;
    }
    EXPECT_GE(alike, 11);
}

Machine with_arc_blends() {
    Machine machine;
    machine.controller.planner = PlannerKind::trapezoidal;
    for (MachineAxis& axis : machine.axes) axis.max_acceleration = 2000, axis.max_jerk = 0;
    return machine;
}

// An even part whose passes differ within 4 mm of their ends alone. Aligned points lower the speed differences by 14 %.
TEST(EndPoints, MakeRampsAlike) {
    const auto lines = [](int pass, double x) {
        return x < 4 || x > 16 ? 0.5 + 0.9 * std::fmod(1.7 * pass + 3.1 * x, 1.0) : 0.9;
    };
    std::string text = wavy_zigzag(9, 20, lines, 0.03);
    text.replace(text.find("F3000"), 5, "F5000");
    const ReadProgram read = [](const std::string& changed) { return read_text(changed); };
    const Program program = read(text);
    Diagnostics diagnostics;
    const Optimized result = optimize(program, read, with_arc_blends(), {}, std::nullopt, {}, diagnostics);
    EXPECT_TRUE(result.evaluation.accepted) << result.evaluation.reason;
    EXPECT_LT(result.after.mismatch, 0.25 * result.before.mismatch);
    EXPECT_LE(result.after.duration, result.before.duration);
}

}  // namespace
}  // namespace clsurf::end_points_test
