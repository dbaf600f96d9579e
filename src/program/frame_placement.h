#pragma once
// Work frames put together: the motions of a program in one coordinate system, whatever work offsets, G92 and tool
// lengths they count in.

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "program/program.h"

namespace clsurf {

/// Which coordinate system the motions are brought into.
enum class Coordinates : std::uint8_t {
    workpiece,  ///< that of the program where it first cuts
    level,      ///< the same zero, its axes along those of the machine
    machine,
};

/// What the program does not say: poses that lead from its coordinates to the machine's (or the log's).
struct FramePoses {
    std::optional<Eigen::Isometry3d> zero;  ///< of the program's zero where it first cuts
    bool zero_is_default = false;           ///< a log that gives another zero itself goes before it
    /// Of work systems (1: G54) that the program does not set, with G92 and tool where it first cuts there. Those
    /// that are missing here lie where the first one lies.
    std::map<int, Eigen::Isometry3d> systems;
    /// The chain of the rotary axes accounts for the tool's length: the pose is without it.
    bool tool_by_kinematics = false;
    /// The machine may stand anywhere before the program: coordinates that it has not set are NaN, not LinuxCNC's 0.
    bool starts_anywhere = false;
};

/// Goes along the motions of a program, a piece at a time.
class FramePlacer {
public:
    FramePlacer(FramePoses poses, Coordinates coordinates) : poses_(std::move(poses)), coordinates_(coordinates) {}

    /// Brings motions [0, count) into the coordinates, and with them arcs, curves, tool axes and rotary angles. Arcs that leave
    /// the principal planes become chords within 1 µm; events move along. Returns how many motions those are then.
    /// Without effect where all frames are one and the same. O(motions).
    std::int64_t place(Motions& motions, std::vector<ProgramEvent>& events, std::int64_t count);

    /// machine = reference · position; known from the first place() on.
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
    bool moves_ = false;     ///< a frame moves or turns
    bool by_axis_ = false;   ///< an unknown offset is not zero: axes that stand or are absolute count by themselves
    std::size_t first_ = 0;  ///< the frame of the program's first cut
    Eigen::Isometry3d reference_ = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d displaced_ = Eigen::Isometry3d::Identity();  ///< the log's coordinates from the machine's
    std::map<int, Eigen::Isometry3d> offsets_;                     ///< of the unknown systems
    std::vector<Eigen::Isometry3d> true_, nominal_;                ///< work to machine, by frame; with offsets zero
    Vec3 machine_ = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());  ///< end of the last motion
    Vec3 nominal_machine_ = machine_;
};

/// A whole program at once. Returns the pose that leads from the coordinates to the machine's. Domain: each motion is in
/// its own work system, as parsing leaves it, and as io::read_program() does with ProgramOptions::coordinates nullopt.
/// Throws std::logic_error for motions that it has already moved.
Eigen::Isometry3d place_motions(Program& program, const FramePoses& poses = {},
                                Coordinates coordinates = Coordinates::workpiece);

/// Systems of unknown offset (1: G54) that the program cuts in, the one of the first cut first.
[[nodiscard]] std::vector<int> unknown_systems(const Motions& motions);

/// "G54" … "G59.3", "G54.1 P1": the name of a work system of a dialect.
[[nodiscard]] std::string name_of_work_system(int number, const Dialect* dialect);

/// "G54" where all motions are in one work system, and that is one of G54 … G59; else empty.
[[nodiscard]] std::string common_work_system(const Motions& motions);

/// A transformation that leaves unknown coordinates (NaN) the only ones: what is multiplied by zero does not count.
[[nodiscard]] Vec3 apply(const Eigen::Isometry3d& pose, const Vec3& p);

/// Shifted by [mm], turned about Z [deg].
[[nodiscard]] Eigen::Isometry3d pose_of(const Vec3& shift, double degrees);

}  // namespace clsurf
