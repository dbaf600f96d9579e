// The refinement of a plan at the output of the planner: it covers the path once, is continuous,
// keeps the limits of the axes and takes less time than the initial plan.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "program/motion_source.h"
#include "simulation/plan/refiner.h"
#include "support/made_motion.h"

namespace clsurf::refiner_test {
namespace {

/// The output of a Refiner: speed and acceleration along the programmed path at the ends of each part.
struct Part {
    double length = 0, time = 0;
    double begin_speed = 0, end_speed = 0, begin_acceleration = 0, end_acceleration = 0;
};
struct Received {
    std::vector<Part> parts;
    int cells = 0;
    double length = 0, time = 0;
};

class Receiver final : public MotionSink {
public:
    explicit Receiver(Received& into) : into_(&into) {}

    void run(const ProfileSegment& section) override {
        const MotionState begin = section.profile->at(section.from), end = section.profile->at(section.to);
        add({end.arc_length - begin.arc_length, section.to - section.from, begin.speed, end.speed, begin.acceleration,
             end.acceleration});
    }
    void run(const CellMotion& motion, std::span<const CellPart> cell, LimitingFactor /*limiting*/) override {
        double covered = 0;
        for (const CellPart& part : cell) covered += part.length;
        EXPECT_NEAR(covered, motion.length, 1e-9);
        const double duration = motion.duration();
        double end_speed = 0;
        EXPECT_NEAR(motion.arc_length_at(duration, end_speed), motion.length, 1e-9);
        add({motion.length, duration, motion.speed, end_speed, motion.acceleration,
             motion.acceleration + motion.curve * motion.length});
        ++into_->cells;
    }

private:
    void add(const Part& part) {
        into_->parts.push_back(part);
        into_->length += part.length;
        into_->time += part.time;
    }

    Received* into_;
};

Machine machine() {
    Machine machine;
    machine.controller.corner = CornerMode::spline;
    machine.controller.tolerance = 0.05;
    machine.path = {.max_speed = 200, .max_acceleration = 2000, .max_normal_acceleration = 2000, .max_jerk = 50000};
    for (MachineAxis& axis : machine.axes) axis.max_acceleration = 2000, axis.max_jerk = 50000;
    return machine;
}

/// Rounded corners of 90 degrees, 4 mm apart, at a feed that the ramps do not reach.
std::string staircase(int corners) {
    std::string text = "G21 G90 G64 P0.05\nF6000\n";
    for (int k = 1; k <= corners; ++k) text += fmt::format("G1 X{} Y{}\n", 4 * ((k + 1) / 2), 4 * (k / 2));
    return text + "M2\n";
}

/// Plans all of a program's only section, and refines it in windows of `blocks`.
Received refine(const std::string& text, std::int64_t blocks) {
    const Machine tool = machine();
    const Program program = program_of(text);
    WholeProgram source(program);
    PathStream stream(source, tool, Vec3::Zero());
    EXPECT_TRUE(stream.begin_section());
    std::vector<Span> spans;
    while (const Span* span = stream.next()) spans.push_back(*span);
    WindowPlanner planner(tool, true);
    EXPECT_TRUE(planner.plan(spans, 0, {}));
    Received received;
    Receiver receiver(received);
    Refiner refiner(tool, receiver, blocks);
    for (const SpeedRun& run : planner.runs())
        refiner.push(run, std::span(spans).subspan(run.first, run.last - run.first));
    double length = 0;
    for (const Span& span : spans) length += span.length;
    EXPECT_NEAR(received.length, length, 1e-6) << "every part of the path once";
    return received;
}

TEST(Refiner, PassesRunsOnWithoutBlocksToRefineOver) {
    const Received planned = refine(staircase(12), 0);
    EXPECT_EQ(planned.cells, 0);
    EXPECT_GT(planned.parts.size(), 1U);
    for (const Part& part : planned.parts) {
        EXPECT_NEAR(part.begin_acceleration, 0, 1e-6);
        EXPECT_NEAR(part.end_acceleration, 0, 1e-6);
    }
}

TEST(Refiner, IsFasterThanThePlanAndContinuous) {
    const Received planned = refine(staircase(12), 0);
    const Received refined = refine(staircase(12), 1000);
    EXPECT_GT(refined.cells, 100);
    EXPECT_LT(refined.time, 0.97 * planned.time);
    EXPECT_EQ(refined.parts.front().begin_speed, 0);
    EXPECT_NEAR(refined.parts.back().end_speed, 0, 1e-9);
    for (std::size_t i = 1; i < refined.parts.size(); ++i) {
        const Part &before = refined.parts[i - 1], &here = refined.parts[i];
        EXPECT_NEAR(here.begin_speed, before.end_speed, 1e-6 * (1 + here.begin_speed)) << i;
        EXPECT_NEAR(here.begin_acceleration, before.end_acceleration, 20) << i << ": of 2000 mm/s²";
    }
}

TEST(Refiner, WindowsThatFollowEachOtherLoseLittle) {
    const Received all = refine(staircase(60), 1000);
    const Received windows = refine(staircase(60), 20);
    EXPECT_GE(windows.time, all.time * (1 - 1e-3));
    EXPECT_LT(windows.time, 1.02 * all.time);
}

TEST(Refiner, ALineBetweenRestsStaysAsPlanned) {
    const Received line = refine("G21 G90 G1 X100 F3000\nM2\n", 1000);
    EXPECT_EQ(line.cells, 0);
    // 2 s at the feed, and two ramps of 2 √(50/50000) s, which cover half of the distance that the feed would cover in their
    // time.
    EXPECT_NEAR(line.time, 2 + 2 * std::sqrt(50.0 / 50000.0), 1e-6);
}

/// Two sides of a star, 5.2 mm long, divided into lines. Their ends have six decimals, so that all joints are tiny bends.
std::string sides_of_star(int lines) {
    constexpr double radius = 8, inner = 0.45;
    std::string text = "G21 G90 G64 P0.05\nF6000\n";
    Vec3 from = Vec3::Zero();
    for (int side = 1; side <= 2; ++side) {
        const double angle = side * std::numbers::pi / 5, r = radius * (side % 2 == 0 ? 1 : inner);
        const Vec3 to(r * std::cos(angle) - radius, r * std::sin(angle), 0);
        for (int k = 1; k <= lines; ++k) {
            const Vec3 p = from + (to - from) * k / lines;
            text += fmt::format("G1 X{:.6f} Y{:.6f}\n", p.x(), p.y());
        }
        from = to;
    }
    return text + "M2\n";
}

// From rest at the highest jerk j, a distance s takes the time (6 s / j)^(1/3), the same towards rest. The last spans
// between the tiny bends are much shorter than that.
TEST(Refiner, ARestBehindShortSpansIsReachedAtTheGreatestJerk) {
    constexpr double distance = 0.25;  // mm
    for (const int lines : {1, 5, 20}) {
        const Received refined = refine(sides_of_star(lines), 1000);
        double length = 0, time = 0;
        for (std::size_t i = refined.parts.size(); i-- > 0 && length + refined.parts[i].length < distance;)
            length += refined.parts[i].length, time += refined.parts[i].time;
        EXPECT_LT(time, 1.1 * std::cbrt(6 * distance / 50000)) << lines;
    }
}

}  // namespace
}  // namespace clsurf::refiner_test
