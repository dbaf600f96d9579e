// Blocks of very different lengths with random reversals: next to many joints the speed of the tip falls almost to zero
// within nanometres. The jerk of the path stays within its limit even there, for periods that resolve it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "io/readers/machine_file.h"
#include "simulation/run/five_axis_simulator.h"
#include "support/made_five_axis.h"
#include "toolpath/tip_motions.h"

namespace clsurf::five_axis_dip_test {
namespace {

/// In [-1, 1), by a linear congruential generator (Knuth, MMIX).
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double next() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<double>(state_ >> 11U) / 4503599627370496.0 - 1;
    }

private:
    std::uint64_t state_;
};

/// Steps of 10 µm to 20 mm in all directions, with corresponding turns: `blocks` of them, after `skipped` ones.
std::string random_walk(std::uint64_t seed, int skipped, int blocks) {
    Random random(seed);
    std::string text = "G21 G90 G94 G17\nG43.4 H1\n";
    double x = 0, y = 0, z = 0, a = 0, c = 0;
    const auto words = [&] { return fmt::format("X{:.4f} Y{:.4f} Z{:.4f} A{:.4f} C{:.4f}\n", x, y, z, a, c); };
    for (int i = 0; i < skipped + blocks; ++i) {
        if (i == skipped) text += "G0 " + words() + "G1 F3000\n";
        const double size = std::pow(10.0, 1.65 * random.next() - 1.35);
        x += 10 * size * random.next();
        y += 10 * size * random.next();
        z += 4 * size * random.next();
        a = std::clamp(a + 8 * size * random.next(), -60.0, 20.0);
        c += 30 * size * random.next();
        if (i >= skipped) text += words();
    }
    return text + "G49\nM30\n";
}

void expect_the_paths_jerk_to_hold(const std::string& text, double period) {
    Machine machine = io::read_machine(SAMPLE_DATA "/machines/five_axis_trunnion.toml");
    machine.controller.period = period;
    Program program = test::parse_text(text);
    solve_tool_axes(program, machine);
    make_tip_motions(program, machine.kinematics, Vec3::Zero(), Vec3::Zero());
    std::vector<double> speeds{0, 0};
    const FiveAxisSummary summary = simulate_five_axis(program, machine, Vec3::Zero(), Vec3::Zero(),
                                                       [&](std::span<const FiveAxisPoint> points) {
                                                           for (const FiveAxisPoint& point : points)
                                                               speeds.push_back(point.speed);
                                                       },
                                                       {});
    EXPECT_TRUE(summary.run.limits_ok);
    double jerk = 0;
    for (std::size_t i = 2; i < speeds.size(); ++i)
        jerk = std::max(jerk, std::abs(speeds[i] - 2 * speeds[i - 1] + speeds[i - 2]));
    EXPECT_LE(jerk / (period * period), 1.001 * machine.path.max_jerk);
}

// Without grid points in the dip the jerk is 21.8 times its limit.
TEST(FiveAxisDip, ThePathsJerkHoldsWhereTheTipNearlyReverses) {
    expect_the_paths_jerk_to_hold(random_walk(2, 74, 16), 0.0005);
}

// A limit that is met at every eighth of a cell is exceeded by 1 to 2 % on less than a tenth of the path between two of
// these.
TEST(FiveAxisDip, LimitsHoldBetweenPlacesThatHoldThem) {
    for (const std::uint64_t seed : {3U, 23U, 49U}) {
        SCOPED_TRACE(seed);
        expect_the_paths_jerk_to_hold(random_walk(seed, 0, 12), 0.00025);
    }
}

}  // namespace
}  // namespace clsurf::five_axis_dip_test
