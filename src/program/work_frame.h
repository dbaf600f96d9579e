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
    static constexpr std::uint8_t rotation = 8;  ///< beside the axes in `free`

    int system = 0;         ///< the work system (1: G54) whose offset the program does not set; 0: none
    std::uint8_t free = 0;  ///< what of that offset the program does not set: axes, and `rotation`
    /// Axes that no word has placed since the frame changed: they stand where the machine stood.
    std::uint8_t held = 0;
    std::uint8_t absolute = 0;  ///< axes placed in machine coordinates (G53, G28)
    Eigen::Isometry3d local = Eigen::Isometry3d::Identity();
    Vec3 tool = Vec3::Zero();    ///< length of the tool, where the program or its tool table gives it [mm]
    Vec3 rotary = Vec3::Zero();  ///< machine angle of A, B, C less the programmed one [rad]
    /// What rotations, scales and local zeros do to the words of its motions: work position = words · programmed.
    ProgramFrame words;
    /// What place_motions() did to the ends of its motions: end = placed · work position.
    Eigen::Isometry3d placed = Eigen::Isometry3d::Identity();

    /// The machine's position where the offset of `system` is zero.
    [[nodiscard]] Eigen::Isometry3d to_machine() const { return Eigen::Translation3d(tool) * local; }
};

}  // namespace clsurf
