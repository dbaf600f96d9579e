#pragma once
// Composition of work frames: brings the motions of a program into one coordinate system, whatever their work
// offsets, G92 shifts and tool lengths.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/program.h"

namespace clsurf {

/// The coordinate system of the result.
enum class Coordinates : std::uint8_t {
    workpiece,  ///< the coordinates of the program at its first cut
    level,      ///< the same zero, with axes parallel to those of the machine
    machine,
};

/// What the program does not define: poses from its coordinates to the machine's (or the log's).
struct FramePoses {
    std::optional<Eigen::Isometry3d> zero;  ///< of the program's zero at its first cut
    bool zero_is_default = false;           ///< a zero that the log itself gives takes precedence
    /// Poses of the work systems (1: G54) that the program does not set, with G92 and tool at its first cut there. A
    /// missing one has the pose of the first.
    std::map<int, Eigen::Isometry3d> systems;
    /// The kinematics of the rotary axes account for the tool length: the pose does not include it.
    bool tool_by_kinematics = false;
    /// The position before the program is unknown: coordinates that it has not set are NaN, not 0 as in LinuxCNC.
    bool starts_anywhere = false;
};

/// Goes through the motions of a program piece by piece.
class FramePlacer {
public:
    FramePlacer(FramePoses poses, Coordinates coordinates) : poses_(std::move(poses)), coordinates_(coordinates) {}

    /// Brings motions [0, count) into the coordinates, with their arcs, curves, tool axes and rotary angles. Arcs that leave
    /// the principal planes become chords within 1 µm; events keep their motions. Returns the new number of motions. No
    /// effect if all frames are equal. O(motions).
    std::int64_t place(Motions& motions, std::vector<ProgramEvent>& events, std::int64_t count);

    /// machine = reference · position; known after the first place().
    [[nodiscard]] const Eigen::Isometry3d& reference() const { return reference_; }

private:
    void begin(Motions& motions);
    static void forget_start(Motions& motions);
    void follow_frames(Motions& motions);
    [[nodiscard]] Eigen::Isometry3d offset_of(const WorkFrame& frame) const;
    void place_by_axis(Motions& motions, std::int64_t i);
    static void place_curve(const Motions& motions, Curve& curve);

    FramePoses poses_;
    Coordinates coordinates_;
    bool begun_ = false;
    bool moves_ = false;  ///< a frame shifts or rotates
    bool by_axis_ =
        false;  ///< with unknown offsets other than zero: axes at rest and in machine coordinates are placed singly
    std::size_t first_ = 0;  ///< the frame of the program's first cut
    Eigen::Isometry3d reference_ = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d displaced_ = Eigen::Isometry3d::Identity();  ///< from the machine's coordinates to the log's
    std::map<int, Eigen::Isometry3d> offsets_;                     ///< offsets of the unknown systems
    std::vector<Eigen::Isometry3d> true_, nominal_;                ///< work to machine, by frame; with offsets zero
    Vec3 machine_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< end of the last motion
    Vec3 nominal_machine_ = machine_;
};

/// A whole program at once. Returns the pose from its new coordinates to the machine's. Domain: each motion is in its
/// own work system, as after parsing, or after io::read_program() with ProgramOptions::coordinates nullopt. Throws
/// std::logic_error for motions that it has already moved.
Eigen::Isometry3d place_motions(Program& program, const FramePoses& poses = {},
                                Coordinates coordinates = Coordinates::workpiece);

/// Systems with an unknown offset (1: G54) in which the program cuts; that of the first cut comes first.
[[nodiscard]] std::vector<int> unknown_systems(const Motions& motions);

/// "G54" … "G59.3", "G54.1 P1": the name of a work system of a dialect.
[[nodiscard]] std::string name_of_work_system(int number, const Dialect* dialect);

/// "G54" if all motions are in one work system, one of G54 … G59; else empty.
[[nodiscard]] std::string common_work_system(const Motions& motions);

/// A transformation that limits unknown coordinates (NaN) to the axes that depend on them: a NaN times zero is
/// ignored.
[[nodiscard]] Vec3 apply(const Eigen::Isometry3d& pose, const Vec3& p);

/// Shifted by [mm], rotated about Z [deg].
[[nodiscard]] Eigen::Isometry3d pose_of(const Vec3& shift, double degrees);

}  // namespace clsurf
