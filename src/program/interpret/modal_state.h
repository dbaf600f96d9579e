#pragma once
// ModalState: what stays in force from block to block, and the transformation from programmed to machine coordinates:
// machine = rotation · (position + shift) + work offset + tool offset.

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "core/geometry.h"
#include "core/units.h"
#include "program/interpret/program_frame.h"
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

inline constexpr int plain_work_systems = 6;  ///< G54 … G59

struct WorkOffset {
    Vec3 shift = Vec3::Zero();   ///< [mm]
    double rotation = 0;         ///< about z [deg]
    Vec3 rotary = Vec3::Zero();  ///< A, B, C [deg]
    std::uint8_t set = 0;        ///< what the program has set: bits as in WorkFrame
    int measured_from = 0;       ///< not set, but measured in this system of unknown offset (G10 L20); 0: none
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

    int work_system = 1;  ///< 1: G54
    std::map<int, WorkOffset> work_offsets;
    Vec3 shift = Vec3::Zero();                                           ///< G92 and G52 together [mm]
    Vec3 rotary_shift = Vec3::Zero();                                    ///< the same of A, B, C [deg]
    Vec3 saved_shift = Vec3::Zero(), saved_rotary_shift = Vec3::Zero();  ///< restored by G92.3
    Vec3 tool_offset = Vec3::Zero();                                     ///< [mm]
    Vec3 assumed_tool = Vec3::Zero();                      ///< the part of it that comes from a default table [mm]
    Vec3 home = Vec3::Zero(), second_home = Vec3::Zero();  ///< G28, G30; machine coordinates
    Vec3 home_rotary = Vec3::Zero(), second_home_rotary = Vec3::Zero();  ///< [deg]

    /// The least increment of a word: 0.001 mm or 0.0001 in.
    [[nodiscard]] double least_increment() const { return unit_mm == 1 ? 1e-3 : 1e-4; }

    /// The position in programmed coordinates [mm].
    [[nodiscard]] Vec3 programmed() const { return frame.to_programmed(position); }
    [[nodiscard]] WorkOffset work_offset() const {
        const auto found = work_offsets.find(work_system);
        return found == work_offsets.end() ? WorkOffset{} : found->second;
    }
    [[nodiscard]] Vec3 to_machine(const Vec3& p) const {
        const WorkOffset offset = work_offset();
        return rotated(p + shift, offset.rotation) + offset.shift + tool_offset;
    }
    [[nodiscard]] Vec3 from_machine(const Vec3& m) const {
        const WorkOffset offset = work_offset();
        return rotated(m - tool_offset - offset.shift, -offset.rotation) - shift;
    }
    /// From A, B, C as programmed to those of the machine [deg].
    [[nodiscard]] Vec3 rotary_offset() const { return rotary_shift + work_offset().rotary; }
    /// Changes offsets by `change` while the machine is at rest: the position in the program's coordinates is
    /// recomputed.
    template <typename Change>
    void rebase(Change&& change) {
        const Vec3 machine = to_machine(position);
        const Vec3 machine_rotary = rotary + rotary_offset();
        const Vec3 before = position;
        const int system_before = work_system;
        change();
        position = from_machine(machine);
        rotary = machine_rotary - rotary_offset();
        ++frame_changes;
        for (int axis = 0; axis < 3; ++axis) {
            const bool stands = !std::isnan(position[axis]);
            if (stands && (position[axis] != before[axis] || work_system != system_before))
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

    /// Rotated about z by an angle [deg].
    static Vec3 rotated(const Vec3& p, double degrees) {
        if (degrees == 0) return p;
        const double c = std::cos(degrees * rad_per_deg);
        const double s = std::sin(degrees * rad_per_deg);
        return {c * p.x() - s * p.y(), s * p.x() + c * p.y(), p.z()};
    }
};

}  // namespace clsurf
