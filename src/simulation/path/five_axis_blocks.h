#pragma once
// The blocks of a five-axis program as input of the simulator: the tip path for the planner, the path of the tool axis, and
// the speed that the axes allow on each block.

#include <array>
#include <limits>
#include <vector>

#include "machine/machine.h"
#include "program/program.h"
#include "simulation/path/path_element.h"
#include "simulation/path/tool_axis_path.h"

namespace clsurf {

/// Limits of x, y, z [mm], tilt and rotation [rad], signs applied.
struct AxisLimits {
    double low, high, speed, acceleration, jerk;
};

/// How far a block exceeded limits in a run.
struct BlockExcess {
    float scale = 1;  ///< factor to apply to its speed; 1: no limit is exceeded
    float peak = 0;   ///< greatest speed of the tip [mm/s]
};

/// The blocks of a program, with the speeds at which they may be run.
class FiveAxisBlocks {
public:
    /// Arguments as for simulate_five_axis(). Throws InputError (feed 0). `machine` must outlive the object.
    FiveAxisBlocks(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start);

    /// Slows down the blocks that exceed a limit. False: no block does.
    bool derate(const std::vector<BlockExcess>& excesses);

    /// Restores the programmed feeds, for a planner that knows all axes.
    void forget_caps();

    /// The path of the tip for the planner; the line of a motion is the number of its block, from 1.
    [[nodiscard]] const Program& planned() const { return planned_; }
    [[nodiscard]] std::size_t count() const { return axis_paths_.size(); }
    [[nodiscard]] const Vec3& zero() const { return zero_; }
    [[nodiscard]] const ToolAxisPath& axis_path(std::size_t block) const { return axis_paths_[block]; }
    [[nodiscard]] LineNumber line(std::size_t block) const { return lines_[block]; }
    [[nodiscard]] bool waits(std::size_t block) const { return kinds_[block] == MotionKind::dwell; }
    [[nodiscard]] bool cuts(std::size_t block) const { return !waits(block) && kinds_[block] != MotionKind::rapid; }
    [[nodiscard]] double waiting(std::size_t block) const { return feeds_[block]; }  ///< [s]
    /// Programmed speed of both angles together if a block only turns [rad/s]; infinite for other blocks and rapids.
    [[nodiscard]] double turn_speed(std::size_t block) const { return turn_speeds_[block]; }
    [[nodiscard]] bool stands(std::size_t block) const { return waits(block) || !(elements_[block].length > 0); }
    /// The block runs slower than programmed.
    [[nodiscard]] bool capped(std::size_t block) const {
        return caps_[block] < std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] const std::array<AxisLimits, 5>& limits() const { return limits_; }
    /// The share of a block's arc length before a point; the search starts at `from`.
    [[nodiscard]] double part_at(std::size_t block, const Vec3& p, double from) const;

private:
    [[nodiscard]] double turn_of(std::size_t i) const;
    [[nodiscard]] ToolAxisPath make_axis_path(std::size_t i, const RotaryAngles& from, const RotaryAngles& to,
                                              double feed) const;
    [[nodiscard]] double turning_time(std::size_t i) const;
    void guess_cap(std::size_t i);
    void apply_caps();

    const Machine* machine_;
    Vec3 zero_;
    std::array<AxisLimits, 5> limits_;
    Program planned_;
    std::vector<PathElement> elements_;  ///< length 0: the tip is at rest
    std::vector<ToolAxisPath> axis_paths_;
    std::vector<double> caps_;         ///< [mm/s]
    std::vector<double> turn_speeds_;  ///< [rad/s]
    Column<float> feeds_;              ///< as programmed; for turns their time [s]
    Column<MotionKind> kinds_;
    Column<LineNumber> lines_;
};

}  // namespace clsurf
