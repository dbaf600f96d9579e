// Where two arcs nearly reverse, the rounded path almost stops with respect to its programmed arc length: |p′| falls to a
// minimum and rises again within 0.1 µm. The jerk of the path stays within its limit even there.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "program/motion_source.h"
#include "simulation/path/path_stream.h"
#include "support/made_motion.h"

namespace clsurf::near_reversal_test {
namespace {

/// An arc of 5 mm and one of 0.5 mm that leaves it at 163.5°, both to the left, with a tolerance of 0.05 mm.
constexpr const char* two_arcs =
    "G21 G90 G64 P0.05\n"
    "G0 X-5 Y5\n"
    "G3 X0 Y0 I5 J0 F6000\n"
    "G3 X0.127988502 Y-0.900244830 I-0.142007672 J-0.479409867\n"
    "M2\n";

// By NumPy, from the formulae at the top of path_stream.h with w = 6 · ¾ · 0.05/|Δt| and v² = ¼ · 0.05 · 3072/(27 |Δk|):
// 0.996 µm before the corner |p′| is smallest, 0.0017539, and |p′|″ there is 173,397/mm², by differences of p′.
constexpr double least_pace = 0.0017538608679, greatest_pace_curve = 173396.575;

Machine limited() {
    Machine machine;
    machine.controller.corner = CornerMode::spline;
    machine.controller.period = 0.0008;
    machine.path = {.max_speed = 40, .max_acceleration = 500, .max_normal_acceleration = 250, .max_jerk = 40000};
    for (MachineAxis& axis : machine.axes) axis.max_speed = 40, axis.max_acceleration = 500, axis.max_jerk = 40000;
    return machine;
}

/// The spans of the only section of a program, from the origin.
std::vector<Span> spans_of(const char* text, const Machine& machine) {
    const Program program = program_of(text);
    WholeProgram source(program);
    PathStream stream(source, machine, Vec3::Zero());
    EXPECT_TRUE(stream.begin_section());
    std::vector<Span> spans;
    while (const Span* span = stream.next()) spans.push_back(*span);
    return spans;
}

TEST(NearReversal, TheSpansBesideItAllowTheSpeedThatItsJerkAllows) {
    Machine machine = limited();
    // Only the jerk along the path is limited.
    machine.path = {.max_speed = 1e3, .max_acceleration = 1e9, .max_normal_acceleration = 1e9, .max_jerk = 40000};
    machine.controller.chord_tolerance = 1;
    for (MachineAxis& axis : machine.axes) axis.max_speed = 1e3, axis.max_acceleration = 1e9, axis.max_jerk = 1e12;
    double least_cap = 1e9, slow = 0, length = 0, least = 1;
    for (const Span& span : spans_of(two_arcs, machine)) {
        double deviation = 0;
        constexpr int places = 200;
        const double step = span.length / places;
        std::vector<double> paces(places + 1);
        for (int k = 0; k <= places; ++k) {
            (void)span.at(k * step, deviation, paces[static_cast<std::size_t>(k)]);
            least = std::min(least, paces[static_cast<std::size_t>(k)]);
        }
        double curve = 0;
        for (std::size_t k = 1; k < places; ++k)
            curve = std::max(curve, std::abs(paces[k - 1] - 2 * paces[k] + paces[k + 1]) / (step * step));
        EXPECT_LE(curve * std::pow(span.cap, 3), 40000 * 1.001) << span.length;
        least_cap = std::min(least_cap, span.cap);
        if (span.cap < 2) slow += span.length;
        length += span.length;
    }
    EXPECT_NEAR(least, least_pace, 1e-4 * least_pace);
    const double allowed = std::cbrt(40000 / greatest_pace_curve);
    EXPECT_LE(least_cap, allowed * (1 + 1e-4));
    EXPECT_GT(least_cap, 0.9 * allowed);
    EXPECT_LT(slow, 0.005) << "only next to the place, on a way of " << length;
}

TEST(NearReversal, ThePathsJerkHoldsInTheDifferencesOfTheSetPoints) {
    const Machine machine = limited();
    const Recorded r = run_program(program_of(two_arcs), machine);
    double greatest = 0;
    for (std::size_t k = 2; k < r.points.size(); ++k) {
        const double second = r.points[k].speed - 2 * r.points[k - 1].speed + r.points[k - 2].speed;
        greatest = std::max(greatest, std::abs(second) / std::pow(machine.controller.period, 2));
    }
    EXPECT_LE(greatest, 40000 * 1.0005);
    EXPECT_TRUE(r.summary.limits_ok);
}

}  // namespace
}  // namespace clsurf::near_reversal_test
