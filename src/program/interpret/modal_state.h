#pragma once
// ModalState: what stays in force from block to block, and the transformation from programmed to machine coordinates:
// machine = rotation · (position + shift) + work offset + tool offset.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry.h"
#include "program/interpret/program_frame.h"
#include "program/interpret/work_offsets.h"
#include "program/program.h"
#include "program/work_frame.h"

namespace clsurf {

enum class MotionMode : std::uint8_t {
    none,
    rapid,
    feed,
    cw,
    ccw,
    thread,
    tap,
    cubic_spline,      ///< G5
    quadratic_spline,  ///< G5.1
    nurbs,             ///< G5.2
    knotted_nurbs,     ///< G6.2
    akima_spline,      ///< ASPLINE
    basis_spline,      ///< BSPLINE
    point_spline,      ///< CSPLINE
    polynomial,        ///< POLY
    probe,
    cycle,
};

/// What the tool adds to positions [mm].
struct ToolOffset {
    Vec3 total = Vec3::Zero();
    Vec3 assumed = Vec3::Zero();  ///< the part of it that comes from a default table
};

struct ModalState {
    MotionMode motion = MotionMode::none;
    int cycle = 0;                 ///< the canned cycle's G number in tenths, 0: none
    int plane_axis = 2;            ///< axis of rotation: 2 G17, 1 G18, 0 G19
    double unit_mm = 1;            ///< mm per programmed length
    double feed_unit_mm = 1;       ///< mm per length of F, which a change of units may leave unchanged
    bool incremental = false;      ///< G91
    bool centre_absolute = false;  ///< G90.1
    FeedMode feed_mode = FeedMode::per_minute;
    double feed = 0;            ///< as programmed: lengths per minute, per revolution, or 1/min
    double spindle = 0;         ///< 1/min
    bool retract_to_r = false;  ///< G99
    bool diameter = false;      ///< G7: X is a diameter
    PathMode path_mode;

    Vec3 position = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< [mm], of the work system
    Vec3 rotary = Vec3::Zero();                                                ///< A, B, C [deg]
    /// Rotary axes (bits for A, B, C) that are modulo axes because DC, ACP or ACN was used: positions count within a
    /// turn.
    std::uint8_t modulo = 0;
    std::uint8_t held = 0, absolute = 0;          ///< axes, as in WorkFrame
    std::uint8_t unplaced = WorkFrame::all_axes;  ///< axes that no word has positioned since the program began
    std::uint64_t frame_changes = 0;              ///< counts changes of the transformation to machine coordinates
    Vec3 tool_axis =
        Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< programmed as a vector, unit; NaN: by angles
    ProgramFrame frame;                                            ///< from programmed coordinates to `position`

    WorkOffsets work_offsets;
    ToolOffset tool_offset;
    AxisValues home, second_home;  ///< G28, G30; machine coordinates

    /// The least increment of a word: 0.001 mm or 0.0001 in.
    [[nodiscard]] double least_increment() const { return unit_mm == 1 ? 1e-3 : 1e-4; }

    /// The position in programmed coordinates [mm].
    [[nodiscard]] Vec3 programmed() const { return frame.to_programmed(position); }
    [[nodiscard]] Vec3 to_machine(const Vec3& p) const { return work_offsets.to_machine(p) + tool_offset.total; }
    [[nodiscard]] Vec3 from_machine(const Vec3& m) const { return work_offsets.from_machine(m - tool_offset.total); }
    /// Changes offsets by `change` while the machine is at rest: the position in the program's coordinates is
    /// recomputed.
    template <typename Change>
    void rebase(Change&& change) {
        const Vec3 machine = to_machine(position);
        const Vec3 machine_rotary = rotary + work_offsets.rotary();
        const Vec3 before = position;
        const int system_before = work_offsets.system;
        change();
        position = from_machine(machine);
        rotary = machine_rotary - work_offsets.rotary();
        ++frame_changes;
        for (int axis = 0; axis < 3; ++axis) {
            const bool stands = !std::isnan(position[axis]);
            if (stands && (position[axis] != before[axis] || work_offsets.system != system_before))
                held = static_cast<std::uint8_t>(held | (1u << axis));
        }
    }
    /// Words have positioned axes: in the work system, or in machine coordinates. Bits as in WorkFrame.
    void place(unsigned axes, bool in_machine) {
        held = static_cast<std::uint8_t>(held & ~axes);
        unplaced = static_cast<std::uint8_t>(unplaced & ~axes);
        absolute = static_cast<std::uint8_t>(in_machine ? absolute | axes : absolute & ~axes);
    }
    /// The frame of the position.
    [[nodiscard]] WorkFrame work_frame() const;
};

}  // namespace clsurf
