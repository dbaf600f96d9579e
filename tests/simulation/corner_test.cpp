// Transition arcs and junction speeds compared with independently computed vectors, and properties of an arc
// between any two blocks.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "simulation/path/junction.h"
#include "simulation/path/transition_arc.h"
#include "support/made_motion.h"
#include "support/vector_rows.h"

namespace clsurf::corner_test {
namespace {

void near(double value, double expected, double relative, double absolute, const std::string& what) {
    EXPECT_NEAR(value, expected, absolute + relative * std::abs(expected)) << what;
}

void near(const Vec3& value, const Vec3& expected, double relative, double absolute, const std::string& what) {
    EXPECT_LE((value - expected).norm(), absolute + relative * expected.norm()) << what;
}

Vec3 point(VectorRow& row) {
    const std::vector<double> c = row.numbers(3);
    return {c[0], c[1], c[2]};
}

Vec3 point_in_plane(VectorRow& row) {
    const std::vector<double> c = row.numbers(2);
    return {c[0], c[1], 0};
}

PathElement line(const Vec3& from, const Vec3& to) { return element_of(MotionKind::feed, nullptr, from, to); }

/// An arc about the z axis through `from`, by an angle [rad].
PathElement arc(const Vec3& centre, const Vec3& from, double angle) {
    Arc a;
    a.centre = Xyz(centre);
    const Vec3 to = centre + Eigen::AngleAxisd(angle, Vec3::UnitZ()) * (from - centre);
    return element_of(angle > 0 ? MotionKind::ccw : MotionKind::cw, &a, from, to);
}

TEST(JunctionVectors, SpeedRules) {
    for (VectorRow& r : vector_rows("simulation", "junction_speed.txt")) {
        const double alpha = r.number(), a = r.number(), period = r.number(), chord_error = r.number(),
                     radius = r.number(), error = r.number();
        (void)r.number();  // of a corner without rounding, which no corner mode has
        near(arc_speed(radius, a), r.number(), 1e-9, 1e-12, r.name);
        near(chord_speed(radius, chord_error, period), r.number(), 1e-9, 1e-12, r.name);
        near(period_speed(radius, alpha, period), r.number(), 1e-9, 1e-12, r.name);
        near(arc_speed(radius_at_error(alpha, error), a), r.number(), 1e-9, 1e-12, r.name);
    }
}

TEST(TransitionArcVectors, BetweenLines) {
    const char* kinds[] = {"arc", "collinear", "reversal", "degenerate", "none"};
    for (VectorRow& r : vector_rows("simulation", "corner_line_line.txt")) {
        const Vec3 a = point(r), corner = point(r), b = point(r);
        const TransitionArc arc = transition_arc(line(a, corner), line(corner, b), r.number());
        EXPECT_EQ(kinds[static_cast<std::size_t>(arc.kind)], r.word()) << r.name;
        const double deflection = r.number();
        if (arc.kind != CornerKind::degenerate) near(arc.deflection, deflection, 1e-8, 1e-9, r.name);
        if (arc.kind != CornerKind::arc) continue;
        const double arc_length = r.number();
        near(arc.arc_length_before, arc_length, 1e-8, 1e-9, r.name);
        near(arc.arc_length_after, arc_length, 1e-8, 1e-9, r.name);
        near(arc.radius, r.number(), 1e-8, 1e-9, r.name);
        near(arc.error, r.number(), 1e-8, 1e-9, r.name);
        EXPECT_EQ(arc.limited == ArcLimit::error ? "error" : "length", r.word()) << r.name;
        near(arc.begin, point(r), 1e-8, 1e-9, r.name);
        near(arc.middle, point(r), 1e-8, 1e-9, r.name);
        near(arc.end, point(r), 1e-8, 1e-9, r.name);
        near(arc.centre, point(r), 1e-8, 1e-9, r.name);
        near(arc.element().length, r.number(), 1e-8, 1e-9, r.name);
    }
}

TEST(TransitionArcVectors, BetweenLineAndArcForthAndBack) {
    for (VectorRow& r : vector_rows("simulation", "corner_line_arc.txt")) {
        const Vec3 from = point_in_plane(r), corner = point_in_plane(r), middle = point_in_plane(r);
        const double rho = r.number();
        const double turn = r.number() > 0 ? 1 : -1;
        const double error = r.number(), most_line = r.number(), most_arc = r.number();
        EXPECT_EQ(r.word(), "arc") << r.name;
        const Vec3 start = corner + 2 * most_line * (from - corner).normalized();  // half of it may be used
        const double angle = turn * 2 * most_arc / rho;
        const TransitionArc forth = transition_arc(line(start, corner), arc(middle, corner, angle), error);
        const Vec3 end = middle + Eigen::AngleAxisd(angle, Vec3::UnitZ()) * (corner - middle);
        const TransitionArc back = transition_arc(arc(middle, end, -angle), line(corner, start), error);
        const double alpha = std::abs(r.number()), arc_length = r.number(), radius = r.number();
        const Vec3 centre = point_in_plane(r), begin = point_in_plane(r), stop = point_in_plane(r);
        const double e = r.number(), on_arc = r.number(), sweep = std::abs(r.number());
        for (const TransitionArc* found : {&forth, &back}) {
            EXPECT_EQ(found->kind, CornerKind::arc) << r.name;
            near(found->deflection, alpha, 1e-6, 1e-7, r.name);
            near(found->radius, radius, 1e-6, 1e-7, r.name);
            near(found->error, e, 1e-6, 1e-7, r.name);
            near(found->sweep, sweep, 1e-6, 1e-7, r.name);
            near(found->centre, centre, 1e-6, 1e-7, r.name);
        }
        near(forth.arc_length_before, arc_length, 1e-6, 1e-7, r.name);
        near(forth.arc_length_after, on_arc, 1e-6, 1e-7, r.name);
        near(back.arc_length_after, arc_length, 1e-6, 1e-7, r.name);
        near(back.arc_length_before, on_arc, 1e-6, 1e-7, r.name);
        near(forth.begin, begin, 1e-6, 1e-7, r.name);
        near(forth.end, stop, 1e-6, 1e-7, r.name);
        near(back.begin, stop, 1e-6, 1e-7, r.name);
        near(back.end, begin, 1e-6, 1e-7, r.name);
    }
}

/// Arcs about a centre, clockwise to the origin or from it, by an angle [rad].
PathElement clockwise_to_origin(const Vec3& centre, double sweep) {
    return arc(centre, centre + Eigen::AngleAxisd(sweep, Vec3::UnitZ()) * -centre, -sweep);
}
PathElement clockwise_from_origin(const Vec3& centre, double sweep) { return arc(centre, Vec3::Zero(), -sweep); }
double direction_to(const Vec3& from, const Vec3& to) { return std::atan2(to.y() - from.y(), to.x() - from.x()); }

// Two circles of R = 5 about (±4, −3) meet in the origin. A circle of radius r above it, between them, touches them from
// outside: 4² + (r + e + 3)² = (5 + r)², e its distance from the origin, so that r = e (e + 6)/(2 (2 − e)): 13/12 for e =
// 1/2.
TEST(TransitionArc, InTheValleyBetweenTwoArcs) {
    const Vec3 left(-4, -3, 0), right(4, -3, 0), middle(0, 19.0 / 12, 0);
    const TransitionArc a = transition_arc(clockwise_to_origin(left, 1), clockwise_from_origin(right, 1), 0.5);
    ASSERT_EQ(a.kind, CornerKind::arc);
    EXPECT_EQ(a.limited, ArcLimit::error);
    EXPECT_NEAR(a.deflection, 2 * std::atan2(4, 3), 1e-12);
    EXPECT_NEAR(a.radius, 13.0 / 12, 1e-8);
    near(a.centre, middle, 1e-8, 1e-8, "centre");
    const double arc_length = 5 * (direction_to(left, middle) - direction_to(left, Vec3::Zero()));
    EXPECT_NEAR(a.arc_length_before, arc_length, 1e-8);
    EXPECT_NEAR(a.arc_length_after, arc_length, 1e-8);
    near(a.middle, Vec3(0, 0.5, 0), 1e-8, 1e-8, "the point next to the corner");
}

// The same circles, along their inner sides: the tip of a lens. A circle below it touches them from inside:
// 4² + (3 − r − e)² = (5 − r)², so that r = e (6 − e)/(2 (2 + e)): 0.55 for e = 1/2.
TEST(TransitionArc, InTheTipOfALens) {
    const Vec3 left(-4, -3, 0), right(4, -3, 0), middle(0, -1.05, 0);
    const TransitionArc a = transition_arc(clockwise_to_origin(right, 1), clockwise_from_origin(left, 1), 0.5);
    ASSERT_EQ(a.kind, CornerKind::arc);
    EXPECT_EQ(a.limited, ArcLimit::error);
    EXPECT_NEAR(a.radius, 0.55, 1e-8);
    near(a.centre, middle, 1e-8, 1e-8, "centre");
    const double arc_length = 5 * (direction_to(left, Vec3::Zero()) - direction_to(left, middle));
    EXPECT_NEAR(a.arc_length_before, arc_length, 1e-8);
    EXPECT_NEAR(a.arc_length_after, arc_length, 1e-8);
}

// Circles of 5 about (−4, −3) and of 13 about (5, −12), half of the first arc ending in (−1, 1), in the direction u = (3/5,
// 4/5) from its centre. A circle that touches it there is about (−1, 1) + r u, and touches the second one where |D + r u| =
// 13 + r, D = (−6, 13): r = (205 − 169)/(2 (13 − 34/5)) = 90/31.
TEST(TransitionArc, AsLongAsHalfOfAnArcBetweenUnequalOnes) {
    const Vec3 first(-4, -3, 0), second(5, -12, 0), middle(23.0 / 31, 103.0 / 31, 0);
    const double half = std::atan2(4, 3) - std::atan2(3, 4);
    const TransitionArc a = transition_arc(clockwise_to_origin(first, 2 * half), clockwise_from_origin(second, 1), 1);
    ASSERT_EQ(a.kind, CornerKind::arc);
    EXPECT_EQ(a.limited, ArcLimit::length);
    EXPECT_NEAR(a.radius, 90.0 / 31, 1e-8);
    EXPECT_NEAR(a.error, (std::sqrt(11138.0) - 90) / 31, 1e-8);
    near(a.begin, Vec3(-1, 1, 0), 1e-8, 1e-8, "begin");
    near(a.centre, middle, 1e-8, 1e-8, "centre");
    EXPECT_NEAR(a.arc_length_before, 5 * half, 1e-9);
    EXPECT_NEAR(a.arc_length_after, 13 * (direction_to(second, Vec3::Zero()) - direction_to(second, middle)), 1e-8);
}

// The centre of an arc between two arcs is on the offsets of both: at |ρ ± r| from their centres.
TEST(TransitionArc, BetweenArcsTouchesBoth) {
    std::mt19937_64 random(7);
    const auto uniform = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int found = 0;
    constexpr int trials = 1000;
    for (int trial = 0; trial < trials; ++trial) {
        const auto arm = [&] { return std::pair(uniform(0, 2 * std::numbers::pi), uniform(0.5, 20)); };
        const auto [angle0, rho0] = arm();
        const auto [angle1, rho1] = arm();
        const double turn0 = uniform(0, 1) < 0.5 ? 1 : -1, turn1 = uniform(0, 1) < 0.5 ? 1 : -1;
        const Vec3 centre0 = rho0 * Vec3(std::cos(angle0), std::sin(angle0), 0),
                   centre1 = rho1 * Vec3(std::cos(angle1), std::sin(angle1), 0);
        const double sweep0 = uniform(0.1, 3), sweep1 = uniform(0.1, 3);
        const Vec3 begin = centre0 + Eigen::AngleAxisd(-turn0 * sweep0, Vec3::UnitZ()) * Vec3(-centre0);
        const PathElement before = arc(centre0, begin, turn0 * sweep0);
        const PathElement after = arc(centre1, Vec3::Zero(), turn1 * sweep1);
        const double error = std::exp(uniform(std::log(1e-4), std::log(0.1)));
        const TransitionArc a = transition_arc(before, after, error);
        if (a.kind != CornerKind::arc) continue;
        ++found;
        const PathElement e = a.element();
        EXPECT_LE(a.error, error * (1 + 1e-9));
        EXPECT_LE(a.arc_length_before, 0.5 * before.length + 1e-12);
        EXPECT_LE(a.arc_length_after, 0.5 * after.length + 1e-12);
        near(e.at(0), before.at(before.length - a.arc_length_before), 0, 1e-11, "begin");
        near(e.at(e.length), after.at(a.arc_length_after), 0, 1e-9, "end");
        near(e.tangent(0), before.tangent(before.length - a.arc_length_before), 0, 1e-10, "tangent in");
        near(e.tangent(e.length), after.tangent(a.arc_length_after), 0, 1e-8, "tangent out");
        const auto off = [&](const Vec3& centre, double rho) {
            const double distance = (a.centre - centre).norm();
            return std::min(std::abs(distance - std::abs(rho - a.radius)), std::abs(distance - (rho + a.radius)));
        };
        EXPECT_LT(off(centre0, rho0), 1e-8);
        EXPECT_LT(off(centre1, rho1), 1e-8);
        if (a.limited == ArcLimit::error) {
            near(a.error, error, 1e-6, 0, "as large as allowed");
        } else if (a.deflection < 2) {
            EXPECT_GT(std::max(a.arc_length_before / before.length, a.arc_length_after / after.length), 0.05);
        }
    }
    EXPECT_GT(found, 0.9 * trials);
}

TEST(TransitionArc, OfBlocksOutOfPlaneThereIsNone) {
    Arc a;
    a.centre = Xyz(0, 5, 0);
    const PathElement helix = element_of(MotionKind::ccw, &a, Vec3::Zero(), Vec3(5, 5, 3));
    EXPECT_EQ(transition_arc(line(Vec3(0, 5, 0), Vec3::Zero()), helix, 0.01).kind, CornerKind::none);
}

TEST(Corner, IsRoundedBesideAnExactPath) {
    // The second line continues straight from G64 to G61: no stop, and no rounding may extend into the exact part.
    Machine machine;
    const Recorded r = run_program(program_of("G21 G90 G64 P0.1\nG1 X5 F1800\nY0.05\nG61\nY5\nM2\n"), machine);
    EXPECT_TRUE(r.summary.limits_ok) << r.summary.max_acceleration.transpose() << ", jerk "
                                     << r.summary.max_jerk.transpose();
    EXPECT_GT(r.summary.path_deviation, 0.001);
    double aside = 0;  // off the exact path
    for (const SimulatedPoint& p : r.points) {
        if (p.commanded.y() > 0.05) aside = std::max(aside, std::abs(p.commanded.x() - 5));
    }
    EXPECT_LT(aside, 1e-9);
}

}  // namespace
}  // namespace clsurf::corner_test
