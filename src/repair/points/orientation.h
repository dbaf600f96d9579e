#pragma once
// Orientation: the tool axis along the motions of a program, as the simulated controller interpolates it
// (simulation/path/tool_axis_path.h), and the lines that may still get new points.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "machine/machine.h"
#include "program/program.h"
#include "simulation/path/five_axis_blocks.h"

namespace clsurf {

/// Largest angle by which one of the rotary axes turns [rad].
[[nodiscard]] inline double turn_between(const RotaryAngles& a, const RotaryAngles& b) {
    return std::max(std::abs(b.tilt - a.tilt), std::abs(b.rotation - a.rotation));
}

class Orientation {
public:
    /// `program`: motions of the tip with their angles (toolpath/tip_motions.h), run on five axes; as simulate_five_axis().
    /// Program and machine must outlive it. Throws InputError (feed 0). O(motions).
    Orientation(const Program& program, const Machine& machine, const Vec3& zero, const Vec3& start);

    /// Angles at a fraction (0 … 1) of the arc length of a motion.
    [[nodiscard]] RotaryAngles angles(std::int64_t motion, double part) const {
        return blocks_.axis_path(static_cast<std::size_t>(motion)).at(part);
    }
    [[nodiscard]] Vec3 axis(const RotaryAngles& angles) const { return kinematics_->axis_of(angles); }
    /// The sine of the angle between the tool axis and its pole: the effect of a rotation of the table on it.
    [[nodiscard]] double from_pole(const RotaryAngles& angles) const {
        return axis({angles.tilt, 0}).cross(kinematics_->rotation.direction).norm();
    }
    /// The motion of the tool axis on a line between two places of divisible lines.
    [[nodiscard]] ToolAxisPath between(const RotaryAngles& from, const RotaryAngles& to) const {
        return {*kinematics_, from, to, {}, std::numeric_limits<double>::infinity(), 0};
    }

    /// A, B, C [rad] for angles inside a motion.
    [[nodiscard]] Vec3 programmed(std::int64_t motion, const RotaryAngles& angles) const;
    [[nodiscard]] bool turns(std::int64_t motion) const;
    /// Whether points inside a motion can be programmed: its axes move to their words and turn by at most 30°, and the tool
    /// axis stays at least 2° from the pole. True if nothing turns.
    [[nodiscard]] bool divisible(std::int64_t motion) const {
        return divisible_[static_cast<std::size_t>(motion)] != 0;
    }

private:
    [[nodiscard]] bool is_divisible(std::int64_t motion) const;

    const Motions* motions_;
    const Kinematics* kinematics_;
    FiveAxisBlocks blocks_;
    std::vector<std::uint8_t> divisible_;  ///< per motion
};

}  // namespace clsurf
