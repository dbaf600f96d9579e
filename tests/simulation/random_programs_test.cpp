// Random programs on random machines: differentiated points stay within every limit, the path stays
// inside its tolerance, nothing is NaN, the end is exact, and a second run gives the same bits.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>

#include <fmt/format.h>

#include "io/readers/machine_file.h"
#include "support/made_motion.h"

namespace clsurf::random_programs_test {
namespace {

/// Makes random machines and programs.
class Maker {
public:
    explicit Maker(std::uint64_t seed) : random_(seed) {}

    /// `jerk`: an effective jerk limit; `steps`: arcs although axes limit the jerk.
    Machine machine(CornerMode corner, CurveMode curve, bool jerk, bool steps) {
        Machine machine;
        machine.controller.corner = corner;
        machine.controller.curve = curve;
        machine.controller.period = spread(0.0005, 0.004);
        machine.controller.tolerance = spread(0.001, 0.2);
        machine.controller.lookahead_blocks = static_cast<int>(spread(2, 300));
        if (chance(0.3)) machine.controller.feed_override = spread(0.01, 5);
        if (corner == CornerMode::junction) {
            machine.controller.junction = {spread(1e-4, 0.1), chance(0.5) ? spread(0.1, 50) : 0};
            machine.controller.replan_blocks = chance(0.5) ? 1 : 0;
            machine.controller.lookahead_distance = chance(0.5) ? spread(0.01, 10) : 0;
            machine.controller.whole_periods = chance(0.3);
        }
        machine.path = {spread(20, 500), spread(200, 5000), spread(200, 5000), spread(5000, 200000)};
        const bool any_jerk = !jerk || (corner == CornerMode::arc && !steps) || (!steps && chance(0.1));
        if (steps) machine.controller.arc_step_time = machine.controller.period;
        if (!jerk) machine.path.max_jerk = 1e9;
        for (MachineAxis& axis : machine.axes) {
            axis.max_speed = spread(20, 500);
            axis.max_acceleration = spread(200, 5000);
            axis.max_jerk = any_jerk ? 0 : spread(5000, 200000);
        }
        return machine;
    }

    std::string program() {
        const double scale = spread(0.01, 20);
        std::string text = chance(0.15) ? "G61\n" : "G64\n";
        Vec3 at = Vec3::Zero(), before = Vec3::Zero();
        const int blocks = static_cast<int>(spread(3, 60));
        for (int block = 0; block < blocks; ++block) {
            const double kind = uniform(0, 1);
            Vec3 to = at + scale * spread(0.02, 1) * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            if (kind < 0.05)
                to = at;  // zero length
            else if (kind < 0.1)
                to = before;  // back again
            else if (kind < 0.2)
                to = at + uniform(0, 2) * (at - before);  // in the same direction
            before = at;
            if (chance(0.1)) {  // a bend of short lines
                const double radius = scale * spread(0.02, 1), step = spread(0.02, 0.4);
                const double feed = spread(50, 20000);
                const Vec3 centre = at - radius * Vec3::UnitX();
                for (int k = 1; k < 12; ++k) {
                    at = centre + radius * Vec3(std::cos(k * step), std::sin(k * step), 0.1 * k * step);
                    text += fmt::format("G1 X{:.6f} Y{:.6f} Z{:.6f} F{:.1f}\n", at.x(), at.y(), at.z(), feed);
                }
                before = to = at;
                continue;
            }
            if (chance(0.05)) text += fmt::format("G4 P{:.3f}\n", uniform(0, 0.02));
            if (chance(0.03)) text += chance(0.5) ? fmt::format("G64 P{:.4f}\n", spread(0.001, 0.2)) : "G61\n";
            const double feed = spread(50, 20000);
            if (kind < 0.65) {
                text += fmt::format("G{} X{:.6f} Y{:.6f} Z{:.6f} F{:.1f}\n", kind < 0.55 ? 1 : 0, to.x(), to.y(),
                                    to.z(), feed);
                at = to;
                continue;
            }
            // Arcs: spirals upwards, flat ones, three in a row, some far smaller than the tolerance.
            const int arcs = chance(0.2) ? 3 : 1;
            for (int k = 0; k < arcs; ++k) {
                if (chance(0.15)) to = at + Vec3(spread(1e-4, 1e-2), spread(1e-4, 1e-2), 0);
                if (chance(0.6)) to.z() = at.z();
                const double radius = 0.5 * std::hypot(to.x() - at.x(), to.y() - at.y()) * spread(1.01, 5);
                text += fmt::format("G{} X{:.6f} Y{:.6f} Z{:.6f} R{:.6f} F{:.1f}\n", chance(0.5) ? 2 : 3, to.x(),
                                    to.y(), to.z(), radius, feed);
                before = at;
                at = to;
                to = at + scale * spread(0.02, 1) * Vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
            }
        }
        end_ = at;
        return text + "M2\n";
    }
    [[nodiscard]] const Vec3& end() const { return end_; }

private:
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    double spread(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
    bool chance(double part) { return uniform(0, 1) < part; }

    std::mt19937_64 random_;
    Vec3 end_ = Vec3::Zero();
};

std::string parts_of_limits(const SimulationSummary& s, const Machine& machine) {
    std::string parts = fmt::format(
        "T {} speed {:.4f}, tangential {:.4f} {:.4f}", machine.controller.period, s.max_speed / machine.path.max_speed,
        s.max_tangential_acceleration / machine.path.max_acceleration, s.max_tangential_jerk / machine.path.max_jerk);
    for (int x = 0; x < 3; ++x) {
        const MachineAxis& axis = machine.axes[static_cast<std::size_t>(x)];
        parts += fmt::format(", {} {:.4f} {:.4f} {:.4f}", axis_names[static_cast<std::size_t>(x)],
                             s.max_axis_speed[x] / axis.max_speed, s.max_acceleration[x] / axis.max_acceleration,
                             s.max_jerk[x] / axis.max_jerk);
    }
    return parts;
}

/// The largest tolerance that a program requests.
double greatest_tolerance(const Program& program, const Machine& machine) {
    double greatest = machine.controller.tolerance;
    for (const ProgramEvent& event : program.events) {
        if (event.path_mode() && std::isfinite(event.path_mode()->tolerance))
            greatest = std::max(greatest, event.path_mode()->tolerance);
    }
    return greatest;
}

struct Modes {
    CornerMode corner;
    CurveMode curve;
    bool jerk = true;
    bool steps = false;  ///< arcs although axes limit the jerk
};

class RandomPrograms : public testing::TestWithParam<Modes> {};

/// The number of random programs in a mode: CLSURF_RANDOM_PROGRAMS for all modes together, otherwise as many as the suite has
/// time for. Arcs with jerk limits of axes take three times as long as the others: there are a third as many.
int rounds_of(const Modes& mode) {
    constexpr int usual = 10032, shares_of_others = 3, shares = 12 * shares_of_others + 2;
    const char* wanted = std::getenv("CLSURF_RANDOM_PROGRAMS");
    return (wanted != nullptr ? std::atoi(wanted) : usual) / shares * (mode.steps ? 1 : shares_of_others);
}

/// The number of the only requested program of a mode, otherwise -1: other programs are made, but not run.
int only_round() {
    const char* wanted = std::getenv("CLSURF_RANDOM_PROGRAM");
    return wanted != nullptr ? std::atoi(wanted) : -1;
}

/// The seed of the random numbers.
std::uint64_t seed_of_programs() {
    constexpr std::uint64_t usual = 20260721;
    const char* wanted = std::getenv("CLSURF_RANDOM_SEED");
    return wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : usual;
}

/// A program and its machine as random.ngc and random.toml, for the command line.
void write_files(const std::string& text, const Machine& machine) {
    std::ofstream("random.ngc") << text;
    std::ofstream("random.toml") << io::machine_text(machine);
}

/// The number of points of a program whose distance from the path is tested: more programs reveal more than more points.
constexpr std::size_t places_of_a_program = 200;

TEST_P(RandomPrograms, HoldLimitsToleranceAndEnd) {
    Maker maker(seed_of_programs());
    const int only = only_round(), rounds = only >= 0 ? only + 1 : rounds_of(GetParam());
    std::int64_t blocks = 0;
    for (int round = 0; round < rounds; ++round) {
        const Machine machine = maker.machine(GetParam().corner, GetParam().curve, GetParam().jerk, GetParam().steps);
        const std::string text = maker.program();
        if (only >= 0 && round != only) continue;
        const Program program = program_of(text);
        if (only >= 0) write_files(text, machine);
        const Recorded r = run_program(program, machine);
        blocks += static_cast<std::int64_t>(program.motions.size());
        EXPECT_TRUE(r.summary.limits_ok) << "round " << round << ": " << parts_of_limits(r.summary, machine);
        const double tolerance = greatest_tolerance(program, machine);
        EXPECT_LE(r.summary.path_deviation, tolerance * (1 + 1e-9)) << round;
        EXPECT_LE(greatest_distance(elements_of(program), r.points, 1 + r.points.size() / places_of_a_program, 25),
                  r.summary.path_deviation + 1e-6)
            << round;
        ASSERT_LT((r.points.back().commanded - maker.end()).norm(), 1e-5) << round;
        ASSERT_TRUE(std::all_of(r.points.begin(), r.points.end(), [](const SimulatedPoint& p) {
            return p.commanded.allFinite() && p.feedback.allFinite() && std::isfinite(p.speed);
        })) << round;
        if (round % 10 != 0) continue;  // a second run for every tenth
        const Recorded again = run_program(program, machine);
        ASSERT_EQ(again.points.size(), r.points.size());
        for (std::size_t i = 0; i < r.points.size(); ++i)
            ASSERT_TRUE(again.points[i].commanded == r.points[i].commanded &&
                        again.points[i].feedback == r.points[i].feedback);
    }
    std::printf("%d random programs, %lld motions\n", rounds, static_cast<long long>(blocks));
}

INSTANTIATE_TEST_SUITE_P(
    PathModes, RandomPrograms,
    testing::Values(Modes{CornerMode::spline, CurveMode::none}, Modes{CornerMode::arc, CurveMode::none},
                    Modes{CornerMode::stop, CurveMode::none}, Modes{CornerMode::spline, CurveMode::akima},
                    Modes{CornerMode::spline, CurveMode::least_squares}, Modes{CornerMode::arc, CurveMode::akima},
                    Modes{CornerMode::spline, CurveMode::none, false}, Modes{CornerMode::arc, CurveMode::none, false},
                    Modes{CornerMode::stop, CurveMode::none, false}, Modes{CornerMode::spline, CurveMode::akima, false},
                    Modes{CornerMode::junction, CurveMode::none}, Modes{CornerMode::junction, CurveMode::none, false},
                    Modes{CornerMode::arc, CurveMode::none, true, true},
                    Modes{CornerMode::arc, CurveMode::akima, true, true}),
    [](const auto& modes) {
        std::string name =
            fmt::format("{}_{}{}{}", name_of(modes.param.corner), name_of(modes.param.curve),
                        modes.param.jerk ? "" : "_without_jerk_limit", modes.param.steps ? "_with_steps" : "");
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });

}  // namespace
}  // namespace clsurf::random_programs_test
