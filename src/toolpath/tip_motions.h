#pragma once
// The motions of a five-axis program as tip paths in the workpiece, so that the geometry of three axes (lines, arcs,
// the nearest motion) can be used for five; and the angles of tool axes that a program gives as vectors.

#include "machine/machine.h"
#include "program/program.h"

namespace clsurf {

/// Motions under tool centre point control are already tip paths. The positions of all others are those of the axes,
/// minus the work offset and the position of the axes with tool and angles at zero: with the rotary axes at rest a line
/// stays a line, an arc becomes chords within 1 µm; if they turn with the others, chords of at most half a degree.
/// machine = pose · workpiece. Events keep their motions. O(motions). `start` [mm]: the position of the axes before the
/// program, with the rotary axes at zero, in its coordinates. It is used for coordinates that the program has not set: if
/// an axis turns, the tip depends on all of them. A tip that depends on an unknown coordinate (NaN) is unknown.
void make_tip_motions(Program& program, const Kinematics& kinematics, const Eigen::Isometry3d& pose, const Vec3& start);
/// workpiece = machine + offset [mm]
void make_tip_motions(Program& program, const Kinematics& kinematics, const Vec3& offset, const Vec3& start);

/// Sets the angles of motions whose tool axis is a vector: the solutions, within the ranges, that turn the axes least
/// over each run of such motions; later motions that do not name an axis leave it there. Throws InputError with the
/// line of a tool axis out of reach. Adds `program.axis` to the program's diagnostics if an axis turns that the
/// machine does not have. `turn`: rotation of the workpiece on the machine. O(motions).
void solve_tool_axes(Program& program, const Kinematics& kinematics, const AngleRange& tilt = {},
                     const AngleRange& rotation = {}, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity());
/// The same with the travel of the machine's axes as ranges.
void solve_tool_axes(Program& program, const Machine& machine);

}  // namespace clsurf
