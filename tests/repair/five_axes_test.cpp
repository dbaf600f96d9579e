// The repair on five axes: its runs are those of `simulate` judged by `check`, the tool axis is kept, and protected
// lines are not changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "io/readers/machine_file.h"
#include "io/reports/simulated_log.h"
#include "mapping/map_lines.h"
#include "numeric/polyline.h"
#include "repair/optimizer.h"
#include "repair/parts.h"
#include "repair/points/resample.h"
#include "support/temporary_folder.h"
#include "surface/smoothing_segments.h"
#include "surface/stitch.h"
#include "toolpath/tip_motions.h"

namespace clsurf::five_axes_test {
namespace {

const Vec3 zero(5, -8, 12);

/// With so much jerk that no block has to be slowed repeatedly: fast to plan.
Machine trunnion() {
    Machine machine = io::read_machine(SAMPLE_DATA "/machines/five_axis_trunnion.toml");
    machine.path.max_jerk = 1e6;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 1e8;
    for (MachineAxis& axis : machine.rotary) {
        axis.max_acceleration *= 20;
        axis.max_jerk *= 1000;
    }
    machine.controller.block_time = 0.003;
    return machine;
}

Program of_the_tip(const std::string& text, const Machine& machine) {
    Program program = read_text(text);
    solve_tool_axes(program, machine);
    make_tip_motions(program, machine.kinematics, -zero, Vec3::Zero());
    return program;
}

double crowded(int pass, double arc_length) { return pass == 3 && arc_length > 3 && arc_length < 4 ? 0.02 : 0.5; }
double even(int, double) { return 0.5; }

TEST(FiveAxisRun, IsThatOfSimulateAndCheck) {
    const Machine machine = trunnion();
    const Program program = of_the_tip(tilted_zigzag(6, 6, crowded), machine);
    ASSERT_TRUE(runs_on_five_axes(program, machine));
    Diagnostics diagnostics;
    const auto kinematics = std::make_shared<const Kinematics>(machine.kinematics);
    SimulatedRun simulated = simulate_to_log(program, machine, Vec3::Zero(), {}, zero);
    const JudgedRun run = judge_run(std::move(simulated.log), program, diagnostics, kinematics);

    const test::TemporaryFolder folder;
    const std::string file = folder / "run.biip";
    io::SimulatedLogWriter writer(file, machine, "{}");
    (void)simulate_five_axis(program, machine, zero, Vec3::Zero(),
                             [&](std::span<const FiveAxisPoint> points) { writer.append(points); }, {});
    writer.close();
    const Log log = io::open_log(file, {});
    const Trajectory path = reconstruct(log, Role::commanded, -zero, kinematics),
                     measured = reconstruct_like(log, Role::feedback, path);
    const LineMap lines = map_lines(path, log, program, true, diagnostics);
    const ClSurface surface = stitch(gather(path), lines);
    const Signals signals = derive_signals(surface, path, &measured, smoothing_segments(log, surface.passes),
                                           usual_end_zone(surface.step_over));
    const QualityReport report = find_defects(surface, signals, lines, program, log.period, {});

    ASSERT_EQ(run.surface.positions.size(), surface.positions.size());
    EXPECT_NEAR(surface.step_over, 0.4, 0.02) << "passes are those of the tip";
    EXPECT_EQ(run.surface.step_over, surface.step_over);
    EXPECT_EQ(run.report.thresholds.of, report.thresholds.of);
    ASSERT_EQ(run.report.defects.size(), report.defects.size());
    for (std::size_t k = 0; k < report.defects.size(); ++k) {
        EXPECT_EQ(run.report.defects[k].point, report.defects[k].point);
        EXPECT_EQ(run.report.defects[k].depth, report.defects[k].depth);
    }
    for (PointIndex i = 0; i < surface.positions.size(); ++i) ASSERT_EQ(run.signals[i].speed, signals[i].speed) << i;
    EXPECT_TRUE(diagnostics.empty()) << "lines are found along the tip's way";
}

TEST(FiveAxisRun, IsOfThreeWhereNothingNamesARotaryAxis) {
    EXPECT_FALSE(runs_on_five_axes(read_text("G0 X0\nG1 X1 F100\n"), trunnion()));
    EXPECT_FALSE(runs_on_five_axes(read_text("G0 X0\nG1 X1 A1 F100\n"), Machine{}));
    EXPECT_TRUE(runs_on_five_axes(read_text("G0 X0\nG1 X1 A1 F100\n"), trunnion()));
}

// Tilt 0° is the pole.
TEST(Orientation, DividesNoLineNearThePoleOrThatWindsUp) {
    const Machine machine = trunnion();
    const Program program = of_the_tip(
        "G90\nG43.4 H1\nG1 X1 F1000\nX2 A-20 C10\nX3 A-21 C15\nX4 A-22 C355\nX5 A-22 C350\nX6 A-1.5 C350\nX7 A1.5 C350\n"
        "X8\nX9 A-5 C350\n",
        machine);
    const Orientation orientation(program, machine, zero, Vec3::Zero());
    std::vector<int> divisible;
    for (std::int64_t i = 0; i < program.motions.size(); ++i) divisible.push_back(orientation.divisible(i) ? 1 : 0);
    // From the pole; then two turns of some degrees; winding up by 340°; steps near the pole; a line that does not turn;
    // across the pole.
    EXPECT_EQ(divisible, (std::vector<int>{1, 0, 1, 0, 1, 0, 0, 1, 0}));
    EXPECT_FALSE(orientation.turns(0));
    EXPECT_TRUE(orientation.turns(2));
    // Linear in the angles.
    const RotaryAngles half = orientation.angles(2, 0.5);
    EXPECT_NEAR(half.tilt, -20.5 * rad_per_deg, 1e-12);
    EXPECT_NEAR(half.rotation, 12.5 * rad_per_deg, 1e-12);
    const Vec3 words = orientation.programmed(2, half);
    EXPECT_NEAR(words.x(), -20.5 * rad_per_deg, 1e-12);
    EXPECT_EQ(words.y(), 0);
}

Deviation deviation_of(const std::string& before, const std::string& after) {
    const Machine machine = trunnion();
    const Program a = of_the_tip(before, machine), b = of_the_tip(after, machine);
    const Orientation of_a(a, machine, zero, Vec3::Zero()), of_b(b, machine, zero, Vec3::Zero());
    return measure_deviation(a, b, 0.02, {&of_a, &of_b});
}

TEST(Deviation, IsThatOfAPlantedTurn) {
    const std::string head = "G90\nG43.4 H1\nG1 X0 Y0 Z0 F1000\nA-20 C30\n", tail = "X30 A-22\n";
    const Deviation same = deviation_of(head + "X10 A-21\nX20 C31\n" + tail, head + "X10 A-21\nX20 C31\n" + tail);
    EXPECT_EQ(same.disordered, 0U);
    EXPECT_NEAR(same.turned, 0, 1e-9) << "the turn in place is before and behind the same point";
    const Deviation tilted = deviation_of(head + "X10 A-21\nX20\n" + tail, head + "X10 A-21.02\nX20\n" + tail);
    EXPECT_NEAR(tilted.turned, 0.02 * rad_per_deg, 1e-9);
    EXPECT_EQ(tilted.turned_line.line, 5U);
    EXPECT_NEAR(tilted.greatest, 0, 1e-9);
    // If the tool leans by 21°, a turn of the table changes the tool axis less: 2 sin⁻¹(sin 21° sin 0.05°).
    const Deviation turned =
        deviation_of(head + "X10 A-21\nX20\n" + tail, head + "X10 A-21\nX20 C30.1\nX30 A-22 C30\n");
    EXPECT_NEAR(turned.turned, 2 * std::asin(std::sin(21 * rad_per_deg) * std::sin(0.05 * rad_per_deg)), 1e-9);
}

TEST(Deviation, SeesTurnsThatChanged) {
    const std::string head = "G90\nG43.4 H1\nG1 X0 Y0 Z0 F1000\nA-20 C30\n", tail = "X10 C31\nX20 C32\n";
    EXPECT_EQ(deviation_of(head + tail, head + tail).disordered, 0U);
    EXPECT_EQ(deviation_of(head + tail, "G90\nG43.4 H1\nG1 X0 Y0 Z0 F1000\nA-20 C30.001\n" + tail).disordered, 4U)
        << "a turn in place";
    EXPECT_EQ(deviation_of(head + tail, head + "X10 C31\nX20 C392\n").disordered, 6U)
        << "once round, and the same axis";
}

struct Resampled {
    Program before, after;
    std::string text;
};

Resampled resampled(const std::string& text, double tolerance, double spacing, const Machine& machine = trunnion()) {
    Resampled r{of_the_tip(text, machine), {}, {}};
    const Orientation orientation(r.before, machine, zero, Vec3::Zero());
    LineEditor editor(r.before);
    const ResampleRules rules{tolerance, spacing, 0.2 * tolerance, 0, most_turned};
    for (const ResampledSegment& s :
         resample(r.before, build_programmed_surface(r.before), editor, rules, {}, &orientation))
        editor.replace(s.first, s.last, s.points, s.angles);
    r.text = editor.text("");
    r.after = of_the_tip(r.text, machine);
    return r;
}

Vec3 axis_of(double a, double c) {  // [rad] t = Rz(c) Rx(a) z
    return {std::sin(c) * std::sin(a), -std::cos(c) * std::sin(a), std::cos(a)};
}

/// For every 0.05 mm of the lines of one program: the nearest point on any line of the other, and the angle between the tool
/// axes there, both interpolated linearly in the angles. Brute force; returns the largest of both.
std::pair<double, double> farthest(const Motions& from, const Motions& to) {
    double off = 0, turned = 0;
    const auto axis = [](const Motions& m, std::size_t i, double part) {
        const Vec3 a = m.rotary[i - 1].vec(), b = m.rotary[i].vec(), at = a + part * (b - a);
        return axis_of(at.x(), at.z());
    };
    for (std::size_t i = 2; i + 1 < from.end.size(); ++i) {
        const Vec3 a = from.end[i - 1].vec(), b = from.end[i].vec();
        const int pieces = std::max(1, static_cast<int>((b - a).norm() / 0.05));
        for (int k = 1; k <= pieces; ++k) {
            const double part = static_cast<double>(k) / pieces;
            const Vec3 p = a + part * (b - a);
            double nearest = 1e9, angle = 0;
            for (std::size_t j = 2; j + 1 < to.end.size(); ++j) {
                const Vec3 c = to.end[j - 1].vec(), d = to.end[j].vec(), projection = nearest_on_line(p, c, d);
                if ((p - projection).norm() >= nearest) continue;
                nearest = (p - projection).norm();
                angle = angle_between(axis(from, i, part), axis(to, j, (projection - c).norm() / (d - c).norm()));
            }
            off = std::max(off, nearest);
            turned = std::max(turned, angle);
        }
    }
    return {off, turned};
}

TEST(FiveAxisResample, KeepsTipAndToolAxis) {
    for (const double tolerance : {0.002, 0.01}) {
        for (const double spacing : {0.15, 0.6, 1.5}) {
            const Resampled r = resampled(tilted_zigzag(5, 8, crowded), tolerance, spacing);
            ASSERT_NE(r.text, r.before.main().text());
            const auto [off, turned] = farthest(r.after.motions, r.before.motions);
            const auto [off_back, turned_back] = farthest(r.before.motions, r.after.motions);
            EXPECT_LE(std::max(off, off_back), tolerance) << tolerance << " " << spacing;
            EXPECT_LE(std::max(turned, turned_back), most_turned) << tolerance << " " << spacing;
            const Machine machine = trunnion();
            const Orientation before(r.before, machine, zero, Vec3::Zero()),
                after(r.after, machine, zero, Vec3::Zero());
            const Deviation measured = measure_deviation(r.before, r.after, 0.05, {&before, &after});
            EXPECT_EQ(measured.disordered, 0U);
            EXPECT_NEAR(measured.greatest, std::max(off, off_back), 2e-6);
            EXPECT_NEAR(measured.turned, std::max(turned, turned_back), 1e-5 * rad_per_deg);
        }
    }
}

TEST(FiveAxisResample, KeepsTheToolAxisAlongGreatCircles) {
    for (const ToolAxisInterpolation mode : {ToolAxisInterpolation::vector, ToolAxisInterpolation::safe}) {
        Machine machine = trunnion();
        machine.kinematics.interpolation = mode;
        const std::string text = tilted_zigzag(5, 8, crowded);
        const Resampled r = resampled(text, 0.005, 0.6, machine);
        EXPECT_NE(r.text, text);
        const Orientation before(r.before, machine, zero, Vec3::Zero()), after(r.after, machine, zero, Vec3::Zero());
        const Deviation measured = measure_deviation(r.before, r.after, 0.05, {&before, &after});
        EXPECT_EQ(measured.disordered, 0U);
        EXPECT_LE(measured.greatest, 0.005);
        EXPECT_LE(measured.turned, most_turned) << name_of(mode);
    }
}

// The number of decimals is that of the program; the words of points that are kept do not change.
TEST(FiveAxisResample, WritesAsManyDecimalsAsTheProgram) {
    const std::string text = tilted_zigzag(5, 8, crowded, 3);
    const Resampled r = resampled(text, 0.005, 0.6);
    ASSERT_NE(r.text, text);
    std::istringstream lines(r.text);
    for (std::string line; std::getline(lines, line);) {
        if (const auto plain = read_plain_line(line)) {
            EXPECT_EQ(plain->decimals[3], 3) << line;
            EXPECT_EQ(plain->decimals[5], 3) << line;
        }
    }
    // One decimal is 0.07° of rounding: no new angle can be written, and nothing changes.
    const std::string coarse = tilted_zigzag(5, 8, crowded, 1);
    EXPECT_EQ(resampled(coarse, 0.005, 0.6).text, coarse);
}

/// The largest jump of the rate of C [rad/mm] at joints of lines on passes, more than a step-over from their ends.
double greatest_jump(const Motions& m) {
    double greatest = 0;
    const auto rate = [&](std::size_t i) {
        return (m.rotary[i].z - m.rotary[i - 1].z) / (m.end[i].vec() - m.end[i - 1].vec()).norm();
    };
    for (std::size_t i = 2; i + 2 < m.end.size(); ++i) {
        if (m.end[i].x > 11 && m.end[i].x < 17) greatest = std::max(greatest, std::abs(rate(i + 1) - rate(i)));
    }
    return greatest;
}

// If lines become half as long, jumps of the rates are also halved, unlike on the old lines.
TEST(FiveAxisResample, TurnsTheToolEvenly) {
    const Resampled r = resampled(tilted_zigzag(
                                      5, 8, [](int, double) { return 0.8; }, 5),
                                  0.005, 0.4);
    EXPECT_GT(r.after.motions.size(), r.before.motions.size() * 3 / 2);
    EXPECT_LT(greatest_jump(r.after.motions), 0.7 * greatest_jump(r.before.motions));
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// How many lines of `kept` are in `lines`, in that order.
std::size_t found_in_order(const std::vector<std::string>& kept, const std::vector<std::string>& lines) {
    std::size_t next = 0;
    for (const std::string& line : lines) next += next < kept.size() && line == kept[next] ? 1 : 0;
    return next;
}

TEST(FiveAxisOptimizer, IsBetterInEveryRespect) {
    const Machine machine = trunnion();
    const std::string text = tilted_zigzag(5, 5, crowded);
    OptimizeRules rules;
    rules.zero = zero;
    Diagnostics diagnostics;
    const Program program = read_text(text);
    const Optimized result = optimize(program, read_text, machine, rules, {}, {}, diagnostics);
    ASSERT_TRUE(result.evaluation.accepted) << result.evaluation.reason;
    EXPECT_TRUE(result.five_axes);
    EXPECT_LT(result.after.mismatch, result.before.mismatch);
    EXPECT_LE(result.after.duration, result.before.duration);
    EXPECT_LE(result.evaluation.defects_after, result.evaluation.defects_before);
    const Program after = of_the_tip(result.text, machine), before = of_the_tip(text, machine);
    const auto [off, turned] = farthest(after.motions, before.motions);
    const auto [off_back, turned_back] = farthest(before.motions, after.motions);
    EXPECT_LE(std::max(off, off_back), rules.tolerance);
    EXPECT_LE(std::max(turned, turned_back), most_turned);
    // Everything but plain lines is kept, in order.
    std::vector<std::string> kept;
    for (const std::string& line : lines_of(text)) {
        if (!read_plain_line(line)) kept.push_back(line);
    }
    EXPECT_EQ(found_in_order(kept, lines_of(result.text)), kept.size());
}

TEST(FiveAxisOptimizer, ALogOfThreeAxesIsNamed) {
    const Machine machine = trunnion();
    const Program program = read_text(tilted_zigzag(4, 3, even));
    Log log = simulate_to_log(read_text("G0 X0\nG1 X1 F100\n"), machine, Vec3::Zero(), {}).log;
    Diagnostics diagnostics;
    EXPECT_THROW((void)optimize(program, read_text, machine, {}, std::move(log), {}, diagnostics), InputError);
}

TEST(FiveAxisOptimizer, WithoutRotaryAxesNamesTheLine) {
    Diagnostics diagnostics;
    try {
        (void)optimize(read_text(tilted_zigzag(4, 3, even)), read_text, Machine{}, {}, {}, {}, diagnostics);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostic().where.number, 7U);
        EXPECT_NE(error.diagnostic().hint.find("rotary axes"), std::string::npos);
    }
}

}  // namespace
}  // namespace clsurf::five_axes_test
