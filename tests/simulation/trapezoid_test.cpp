#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/error.h"
#include "io/formats/log_format.h"
#include "io/readers/machine_file.h"
#include "simulation/path/block_merging.h"
#include "simulation/plan/blend_arc.h"
#include "simulation/plan/segment_queue.h"
#include "support/made_motion.h"
#include "support/temporary_folder.h"
#include "toolpath/trajectory.h"

namespace clsurf::trapezoid_test {
namespace {

constexpr double pi = std::numbers::pi;

/// 2000 mm/s² on each axis, 1 ms; the points are those of the planner, without smoothing by a spline.
Machine plain() {
    Machine machine;
    machine.controller.planner = PlannerKind::trapezoidal;
    machine.controller.lookahead_blocks = 50;
    machine.controller.trapezoid.cubic_interpolation = false;
    machine.controller.trapezoid.blocks_per_period = 100;
    machine.path.max_acceleration = machine.path.max_normal_acceleration = 1e6;
    for (MachineAxis& axis : machine.axes) axis.max_jerk = 0;
    return machine;
}

Machine of_kernel() { return io::read_machine(SAMPLE_DATA "/machines/linuxcnc_kernel.toml"); }

Recorded run(const std::string& text, const Machine& machine) { return run_program(program_of(text), machine); }

TEST(TrapezoidalPlanner, ALineTakesTheTimeOnPaper) {
    // 10 mm at 50 mm/s with 2000 mm/s²: ramps of 25 periods and 0.625 mm, 175 periods between; 10/50 + 50/2000 s.
    const Recorded r = run("G61 G1 X10 F3000\nM2\n", plain());
    std::size_t first = 0;
    while (r.points[first + 1].commanded.x() == 0) ++first;
    EXPECT_NEAR(r.points[first + 1].commanded.x(), 0.5 * 2000 * 1e-6, 1e-12);
    EXPECT_NEAR(r.points[first + 25].commanded.x(), 0.625, 1e-12);
    EXPECT_NEAR(r.points[first + 125].commanded.x(), 0.625 + 100 * 0.05, 1e-12);
    EXPECT_NEAR(r.points[first + 200].commanded.x(), 10 - 0.625, 1e-12);
    EXPECT_NEAR(r.points[first + 225].commanded.x(), 10, 1e-9);
    EXPECT_NEAR(r.summary.max_speed, 50, 1e-9);
    EXPECT_LT(r.summary.max_acceleration.x(), 2000 * limit_tolerance);
}

TEST(TrapezoidalPlanner, AStopFallsOnAPeriod) {
    // 10.01 mm would take 225.2 periods: the braking is weaker, and the line ends with the 226th.
    const Recorded r = run("G61 G1 X10.01 F3000\nM2\n", plain());
    const auto at_end = [](const SimulatedPoint& p) { return p.commanded.x() == 10.01; };
    const auto end = std::find_if(r.points.begin(), r.points.end(), at_end);
    ASSERT_NE(end, r.points.end());
    const auto begin =
        std::find_if(r.points.begin(), r.points.end(), [](const SimulatedPoint& p) { return p.commanded.x() > 0; });
    EXPECT_EQ(end - begin + 1, 226);
    EXPECT_LT(r.summary.max_acceleration.x(), 2000 * limit_tolerance);
}

TEST(TrapezoidalPlanner, OverlappingBlocksLeaveTheCornerByTheTolerance) {
    // Both at half of 2000 mm/s², 90°: v = 2 √(a e / cos 45°); at the moment when both have v/2 each is v²/(8 a) from the
    // corner.
    const Machine machine = plain();
    BlendSegment before = segment_of(element_of(MotionKind::feed, nullptr, Vec3(0, 0, 0), Vec3(20, 0, 0)), machine);
    BlendSegment after = segment_of(element_of(MotionKind::feed, nullptr, Vec3(20, 0, 0), Vec3(20, 20, 0)), machine);
    for (BlendSegment* segment : {&before, &after}) {
        segment->tolerance = 0.01;
        segment->end = SegmentEnd::parabolic;
    }
    const double limit = 2 * std::sqrt(1000 * 0.01 / std::cos(pi / 4));
    const OverlapSpeeds speeds = overlap_speeds(before, after, 50, 50);
    EXPECT_NEAR(speeds.before, limit, 1e-9);
    EXPECT_NEAR(speeds.after, limit, 1e-9);
    EXPECT_NEAR(speeds.along, limit * std::sin(pi / 4), 1e-9);
    EXPECT_NEAR(std::sqrt(2.0) * limit * limit / (8 * 1000), 0.01, 1e-12);

    Machine without_arcs = machine;
    without_arcs.controller.trapezoid.arc_blends = false;
    const Recorded r = run("G64 P0.01 Q0 G1 X20 F3000\nY20\nM2\n", without_arcs);
    double nearest = 1;
    for (const SimulatedPoint& p : r.points) nearest = std::min(nearest, (p.commanded - Vec3(20, 0, 0)).norm());
    EXPECT_NEAR(nearest, 0.01, 0.003);  // a period at 7.5 mm/s is 7.5 µm
    double off = 0;                     // distance to the nearer one of y = 0 and x = 20
    for (const SimulatedPoint& p : r.points) off = std::max(off, std::min(p.commanded.y(), 20 - p.commanded.x()));
    EXPECT_GT(off, 0.006);
    EXPECT_NEAR(r.summary.path_deviation, off, 1e-12);
    EXPECT_LT(r.summary.max_acceleration.x(), 2000 * limit_tolerance);
}

TEST(TrapezoidalPlanner, AnOverlapOfArcsIsMeasuredFromTheArcs) {
    // A line, a quarter of a circle about (20, 5), and at 36.9° to its left a circle about (29, 8), all with radius 5.
    Machine without_arcs = plain();
    without_arcs.controller.trapezoid.arc_blends = false;
    const Recorded r = run("G64 P0.05 Q0 F3000 G1 X20\nG3 X25 Y5 J5\nG2 X29 Y13 I4 J3\nM2\n", without_arcs);
    double off = 0;
    for (const SimulatedPoint& p : r.points) {
        const double x = p.commanded.x(), y = p.commanded.y();
        const double of_line = x <= 20 ? std::abs(y) : std::hypot(x - 20, y);
        const double of_first = std::abs(std::hypot(x - 20, y - 5) - 5);
        const double of_second = std::abs(std::hypot(x - 29, y - 8) - 5);
        off = std::max(off, std::min({of_line, of_first, of_second}));
    }
    EXPECT_GT(off, 0.005);
    EXPECT_NEAR(r.summary.path_deviation, off, 1e-9);
}

// The kernel's path also misses the corner of mixed.ngc between its lines 47 and 48 by 0.7099 mm (data/logs/mixed.csv.xz).
TEST(TrapezoidalPlanner, SaysWhereThePathHasNoTolerance) {
    const std::string corner = "G0 X0 Y0 Z0\nG1 X20 F3000\nG1 Y20\nM2\n";
    const Recorded free = run("G64\n" + corner, of_kernel()), held = run("G64 P0.05\n" + corner, of_kernel());
    EXPECT_GT(free.summary.path_deviation, 0.1);
    ASSERT_EQ(free.summary.diagnostics.kept().size(), 1U);
    EXPECT_EQ(free.summary.diagnostics.kept()[0].code, "motion.no-tolerance");
    EXPECT_EQ(free.summary.diagnostics.kept()[0].where.number, 4U);
    EXPECT_TRUE(held.summary.diagnostics.kept().empty());
    EXPECT_TRUE(run("G61\n" + corner, of_kernel()).summary.diagnostics.kept().empty());
}

TEST(TrapezoidalPlanner, TheEndHasTheLineOfTheLastMotion) {
    const Recorded r = run("G64 P0.01 G1 X1 F600\nG4 P0.01\nG1 X0\nM2\n", of_kernel());
    EXPECT_EQ(r.points.back().line, 3);
}

TEST(TrapezoidalPlanner, AnArcIsAsLargeAsToleranceOrSpeedNeed) {
    // 90°, 0.005 mm: trim e cos 45°/(1 − sin 45°), the radius is the same. √(a_n r) limits the speed.
    BlendCorner corner{.half_angle = pi / 4,
                       .tolerance = 0.005,
                       .length_in = 5,
                       .length_out = 5,
                       .acceleration = 2000,
                       .normal_acceleration = normal_share * 2000,
                       .speed = 100};
    const double radius = 0.005 * std::cos(pi / 4) / (1 - std::sin(pi / 4));
    BlendSize size = blend_size(corner);
    EXPECT_NEAR(size.radius, radius, 1e-12);
    EXPECT_NEAR(size.trim, radius, 1e-12);
    EXPECT_NEAR(size.speed, std::sqrt(normal_share * 2000 * radius), 1e-9);
    // A feed of 2 mm/s: the distance of two ramps at half the acceleration, 2 · 2/1000 mm, on a quarter of a circle.
    corner.speed = 2;
    size = blend_size(corner);
    EXPECT_NEAR(size.radius, 2 * (2.0 / 1000) / (pi / 2), 1e-12);
    EXPECT_EQ(size.speed, 2);
    // Half of a short block is the bound.
    corner.speed = 100;
    corner.length_in = 0.004;
    EXPECT_NEAR(blend_size(corner).trim, 0.004, 1e-12);
}

TEST(TrapezoidalPlanner, APlaneHasTheAccelerationOfItsSlowestDirection) {
    const Vec3 limits(2000, 2000, 1500);
    EXPECT_NEAR(least_in_plane(Vec3::UnitZ(), limits), 2000, 1e-9);
    EXPECT_NEAR(least_in_plane(Vec3::UnitX(), limits), 1500, 1e-9);
    EXPECT_NEAR(least_in_plane(Vec3(1, 1, 1).normalized(), limits), 1500 / std::sqrt(2.0 / 3), 1e-9);
}

TEST(TrapezoidalPlanner, AnArcSharesItsAcceleration) {
    const Machine machine = plain();
    const Program program = program_of("G1 F3000 G3 X0 Y20 I0 J10\nM2\n");
    // 250 mm/s on R 10 would need 6250 mm/s²: √(√3/2 · 2000 · 10) remains, and half of the acceleration along the arc.
    BlendSegment arc = segment_of(elements_of(program).front(), machine);
    arc.end = SegmentEnd::tangent;
    arc.finish_length(machine.controller.period);
    EXPECT_NEAR(arc.max_speed, std::sqrt(normal_share * 2000 * 10), 1e-9);
    EXPECT_NEAR(arc.tangential_acceleration(), 1000, 1e-6);
}

TEST(TrapezoidalPlanner, StepsOfDirectionAreShared) {
    // 0.001 rad at 50 mm/s and 1 ms: (50/0.001 + 2000) · 0.001 of 2000 mm/s² is 0.026, less than 0.1: passed at full speed.
    const Machine machine = plain();
    const auto speed_at_corner = [&](double angle) {
        const std::string text = fmt::format("G64 P0.00001 Q0 G1 X10 F3000\nX20 Y{}\nM2\n", 10 * std::tan(angle));
        const Recorded r = run(text, machine);
        double least = 50;
        for (const SimulatedPoint& p : r.points)
            if (std::abs(p.commanded.x() - 10) < 0.1) least = std::min(least, p.speed);
        return least;
    };
    EXPECT_NEAR(speed_at_corner(0.001), 50, 1e-6);
    // 0.01 rad needs 0.26, and the arc inside the tolerance is slower: v · 0.1/0.26 remains.
    const double share = (50 / 0.001 + 2000) * 0.01 / 2000;
    const double allowed = 50 * 0.1 / share;
    EXPECT_GE(speed_at_corner(0.01), allowed - 1e-9);
    EXPECT_LT(speed_at_corner(0.01), allowed + 2000 * 0.001);  // a period before or after the corner
}

TEST(BlockMerging, JoinsLinesWithinTheTolerance) {
    const Machine machine = plain();
    const auto lines = [&](const std::string& mode) {
        const Program program = program_of(mode + "G1 X0 F600\nX1 Y0.004\nX2\nX3 Y0.1\nX4 F500\nX5\nM2\n");
        WholeProgram whole(program);
        BlockStream blocks(whole, machine, Vec3::Zero(), Stops::programmed);
        BlockMerging merged(blocks);
        std::vector<PathElement> found;
        PathElement element;
        EXPECT_TRUE(blocks.begin_section());
        while (merged.next(element)) found.push_back(element);
        return found;
    };
    // (1, 0.004) is 0.002 from the line to (2, 0.004); (3, 0.1) would be too far from (2, 0.004); another feed begins a new
    // line.
    const std::vector<PathElement> found = lines("G64 P0.01 Q0.005\n");
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].end, Vec3(2, 0.004, 0));
    EXPECT_EQ(found[0].line, 4);
    EXPECT_NEAR(found[0].deviation, 0.002, 1e-6);
    EXPECT_EQ(found[2].end, Vec3(5, 0.1, 0));
    EXPECT_EQ(lines("G64 P0.01 Q0\n").size(), 5U);
    EXPECT_EQ(lines("G61\n").size(), 5U);
}

// The first line has zero length. The next two are merged, and so are the last two: a change of feed would separate them.
TEST(BlockMerging, SaysWhichMotionsBecomeOne) {
    const std::string lines = "G1 X0 F600\nX1 Y0.004\nX2\nX3 Y0.1\nX4 F500\nX5\nM2\n";
    EXPECT_EQ(merged_with_next(program_of("G64 P0.01 Q0.005\n" + lines), plain()),
              (std::vector<std::uint8_t>{1, 1, 0, 0, 1, 0}));
    EXPECT_EQ(merged_with_next(program_of("G64 P0.01 Q0\n" + lines), plain()),
              (std::vector<std::uint8_t>{1, 0, 0, 0, 0, 0}));
}

// The lines of the previous test: the machine's tolerance replaces that of the program, except on an exact path.
TEST(BlockMerging, AMachineMayMergeOtherwiseThanTheProgramSays) {
    const auto left = [](const std::string& mode, const Machine& machine) {
        return merged_lines(program_of(mode + "G1 X0 F600\nX1 Y0.004\nX2\nX3 Y0.1\nX4 F500\nX5\nM2\n"), machine).size();
    };
    Machine never = plain(), always = plain(), rounding;
    never.controller.merging_tolerance = 0;
    always.controller.merging_tolerance = 0.005;
    EXPECT_EQ(left("G64 P0.01 Q0.005\n", never), 5U);
    EXPECT_EQ(left("G64 P0.01 Q0\n", always), 3U);
    EXPECT_EQ(left("G61\n", always), 5U);
    // The other planner merges if the machine file says so, never by the program.
    EXPECT_EQ(left("G64 P0.01 Q0.005\n", rounding), 5U);
    rounding.controller.merging_tolerance = 0.005;
    EXPECT_EQ(left("G64 P0.01 Q0\n", rounding), 3U);
    rounding.controller.corner = CornerMode::stop;
    EXPECT_EQ(left("G64 P0.01 Q0.005\n", rounding), 5U);
}

// Two lines in one direction, whose ends are 1 µm off one line: as one line they take 1 s at 10 mm/s, plus the ramps.
TEST(BlockMerging, TheTimeOptimalPlannerDrivesTheMergedLine) {
    Machine machine;
    const std::string text = "G21 G90 G64 P0.01\nG1 X0 F600\nX5 Y0.001\nX10 Y0\nM2\n";
    const std::string one = "G21 G90 G64 P0.01\nG1 X0 F600\nX10 Y0\nM2\n";
    const auto highest = [](const Recorded& r) {
        double y = 0;
        for (const SimulatedPoint& p : r.points) y = std::max(y, p.commanded.y());
        return y;
    };
    machine.controller.merging_tolerance = 0.002;
    const Recorded merged = run(text, machine), single = run(one, machine);
    EXPECT_EQ(merged.points.size(), single.points.size());
    EXPECT_LT(highest(merged), 1e-9);
    machine.controller.merging_tolerance = 0.0005;
    EXPECT_GT(highest(run(text, machine)), 5e-4);
}

/// The largest distance between simulated and recorded set points from the first movement on [mm], and the difference of
/// the numbers of points.
struct Agreement {
    double commanded = 0, feedback = 0;
    std::size_t points = 0, recorded = 0, other_line = 0;
};

Agreement agreement(const std::string& program_file, const std::string& log_file) {
    const Program program =
        io::read_program(io::open_source(program_file), {.dialect = "linuxcnc", .start = {}, .tools = {}});
    const Recorded r = run_program(program, of_kernel());
    const Log log = io::open_log(io::unpacked(io::open_source(log_file)), {});
    const Trajectory commanded = reconstruct(log, Role::commanded, Vec3::Zero());
    const Trajectory feedback = reconstruct(log, Role::feedback, Vec3::Zero());
    const ChannelView& line = log.find("line")->values;
    constexpr double moved = 1e-7;
    const auto at = [](const Trajectory& t, std::size_t i) { return t.at(static_cast<PointIndex>(i)); };
    const auto count = static_cast<std::size_t>(log.records);
    std::size_t mine = 0, theirs = 0, end = count - 1;
    while ((r.points[mine].commanded - r.points[0].commanded).norm() < moved) ++mine;
    while ((at(commanded, theirs) - at(commanded, 0)).norm() < moved) ++theirs;
    while ((at(commanded, end) - at(commanded, count - 1)).norm() < moved) --end;
    Agreement a;
    a.points = r.points.size() - mine;
    a.recorded = end + 1 - theirs;
    for (std::size_t i = 0; i < std::min(a.points, a.recorded); ++i) {
        const SimulatedPoint& p = r.points[mine + i];
        a.commanded = std::max(a.commanded, (p.commanded - at(commanded, theirs + i)).norm());
        a.feedback = std::max(a.feedback, (p.feedback - at(feedback, theirs + i)).norm());
        if (static_cast<double>(p.line) != line.at(static_cast<PointIndex>(theirs + i))) ++a.other_line;
    }
    return a;
}

// The logs have steps of 1 nm.
TEST(TrapezoidalPlanner, CommandsWhatLinuxCncCommandsPointByPoint) {
    const std::string folder = std::string(TEST_SOURCES) + "/simulation/kernel/";
    const std::vector<std::array<std::string, 2>> runs{
        {folder + "blends.nc", folder + "blends.biip.xz"},
        {SAMPLE_DATA "/programs/bottle_zigzag.nc", SAMPLE_LOGS "/bottle_zigzag.biip"},
        {SAMPLE_DATA "/programs/transition_g61.nc", SAMPLE_LOGS "/transition_g61.biip"}};
    for (const auto& [program, log] : runs) {
        const Agreement a = agreement(program, log);
        EXPECT_NEAR(static_cast<double>(a.points), static_cast<double>(a.recorded), 3) << program;
        EXPECT_LT(a.commanded, 2e-5) << program;
        EXPECT_LT(a.feedback, 5e-5) << program;
        EXPECT_LE(a.other_line, a.recorded / 100) << program;
    }
}

TEST(MachineFile, RefusesKeysThatThePlannerDoesNotUse) {
    const test::TemporaryFolder folder;
    const auto read = [&](const std::string& text) { return io::read_machine(folder.write("m.toml", text)); };
    const std::string planner = "[controller]\nplanner = \"trapezoidal\"\n";
    EXPECT_THROW(read(planner + "corner = \"arc\"\n"), InputError);
    EXPECT_THROW(read(planner + "[path]\nmax_jerk = 1000\n"), InputError);
    EXPECT_THROW(read("[controller]\nkink_ratio = 0.1\n"), InputError);
    EXPECT_THROW(read(planner + "kink_ratio = 2\n"), InputError);
    EXPECT_THROW(read(planner + "arc_blends = 1\n"), InputError);
    EXPECT_THROW(read(planner + "[kinematics]\ntype = \"table-table\"\n"), InputError);
    const Machine machine = of_kernel();
    const std::string written = io::machine_text(machine);
    EXPECT_EQ(io::machine_text(read(written)), written);
    EXPECT_EQ(read(written).controller.trapezoid.max_feed_override, machine.controller.trapezoid.max_feed_override);
}

}  // namespace
}  // namespace clsurf::trapezoid_test
