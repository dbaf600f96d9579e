#pragma once
// Frames: what turns, moves, scales and mirrors the program's coordinates before the work system counts them.

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "program/interpret/program_frame.h"

namespace clsurf {

/// Polar coordinates of Fanuc's G16, Siemens' RP= AP= and Heidenhain's G10 … G13.
struct PolarState {
    bool on = false;           ///< G16
    Vec3 pole = Vec3::Zero();  ///< [mm], programmed coordinates
    double radius = 0;         ///< [mm]
    double angle = 0;          ///< [deg]
};

/// Fanuc's parts of the frame: local zero, then rotation, then scaling, then mirroring.
struct FanucFrame {
    ProgramFrame local, rotation, scaling, mirror;
    double angle = 0;  ///< of the rotation [deg]

    /// All of them, as they are nested.
    [[nodiscard]] ProgramFrame all() const { return local.around(rotation.around(scaling.around(mirror))); }
};

/// Heidenhain's parts of the frame, and in which order they came.
struct HeidenhainFrames {
    enum Part : std::size_t { datum, mirror, rotation, scaling, tilt, parts };
    std::array<ProgramFrame, parts> frame;
    std::vector<std::size_t> order;
};

struct Frames {
    PolarState polar;
    FanucFrame fanuc;
    Vec3 local_zero = Vec3::Zero(), mirror_at = Vec3::Zero();  ///< G52, G51.1 [mm]
    std::array<bool, 3> mirrored{};
    HeidenhainFrames heidenhain;
    Vec3 datum = Vec3::Zero();  ///< Heidenhain's G54 and cycle 7 [mm]
    double turned_by = 0;       ///< its G73 and cycle 10 [deg]
    ProgramFrame swivel;        ///< of CYCLE800; TRANS, ROT … count in it
};

/// What positions and the tool axis mean on five axes.
struct FiveAxisModes {
    bool tool_centre_point = false;  ///< G43.4, TRAORI, M128
    std::string switched_on_by;      ///< the words that did
    bool axis_words = false;         ///< G43.5: I J K are the tool axis
    bool tilted = false;             ///< CYCLE800, G68.2, PLANE: positions are those of the tip, too
};

/// The frames of Motions that are known, and the one that the next motion counts in.
struct KnownWorkFrames {
    std::uint64_t changes = ~std::uint64_t{0};  ///< of the state when the current one was settled
    std::uint8_t held = 0, absolute = 0;
    ProgramFrame words;         ///< from the program's words to the work system
    std::uint32_t current = 0;  ///< index into Motions::frames
    std::map<std::array<double, 34>, std::uint32_t> known;
};

}  // namespace clsurf
