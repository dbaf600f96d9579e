#pragma once
// WorkFrame: how the coordinates of a motion become positions of the machine. The program sets work offsets
// (G10 L2), shifts them (G92) and changes tools between its motions; each combination is a frame.

#include <cstdint>

#include "core/geometry.h"
#include "program/interpret/program_frame.h"

namespace clsurf {

/// machine = tool + offset of `system` · (local · position)
struct WorkFrame {
    /// Axes as bits: 1 X, 2 Y, 4 Z.
    static constexpr std::uint8_t all_axes = 7;
    static constexpr std::uint8_t rotation = 8;  ///< in addition to the axes in `free`

    int system = 0;         ///< the work system (1: G54) whose offset the program does not set; 0: none
    std::uint8_t free = 0;  ///< the components of that offset that the program does not set: axes, and `rotation`
    /// Axes that no word has positioned since the frame changed: they are at their machine position before the
    /// change.
    std::uint8_t held = 0;
    std::uint8_t absolute = 0;  ///< axes positioned in machine coordinates (G53, G28)
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    Vec3 tool = Vec3::Zero();    ///< length of the tool, if the program or its tool table gives it [mm]
    Vec3 rotary = Vec3::Zero();  ///< machine angle of A, B, C minus the programmed one [rad]
    /// The effect of rotations, scales and local zeros on programmed coordinates: work position = words · programmed.
    ProgramFrame words;
    /// The transformation that place_motions() applied to the ends of its motions: end = placed · work position.
    Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();

    /// The machine's position if the offset of `system` is zero.
    [[nodiscard]] Eigen::Isometry3d to_machine() const { return Eigen::Translation3d(tool) * local; }
};

}  // namespace clsurf
