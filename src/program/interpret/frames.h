#pragma once
// What the program's coordinates count in: a pole, the tool's tip, the frames of motions that are known.

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "core/geometry.h"
#include "program/interpret/program_frame.h"

namespace clsurf {

/// Polar coordinates: the pole, and where the last words led.
struct PolarState {
    bool on = false;           ///< G16
    Vec3 pole = Vec3::Zero();  ///< [mm], programmed coordinates
    double radius = 0;         ///< [mm]
    double angle = 0;          ///< [deg]
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
