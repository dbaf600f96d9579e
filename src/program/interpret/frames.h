#pragma once
// References of the program's coordinates: a pole, the tool tip, the known frames of motions.

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "core/geometry.h"
#include "program/interpret/program_frame.h"

namespace clsurf {

/// Polar coordinates: the pole, and the last radius and angle.
struct PolarState {
    bool on = false;           ///< G16
    Vec3 pole = Vec3::Zero();  ///< [mm], programmed coordinates
    double radius = 0;         ///< [mm]
    double angle = 0;          ///< [deg]
};

/// The meaning of positions and the tool axis on five axes.
struct FiveAxisModes {
    bool tool_centre_point = false;  ///< G43.4, TRAORI, M128
    std::string switched_on_by;      ///< the words that switched it on
    bool axis_words = false;         ///< G43.5: I J K are the tool axis
    bool tilted = false;             ///< CYCLE800, G68.2, PLANE: positions are those of the tip as well
};

/// The known frames of Motions, and the frame of the next motion.
struct KnownWorkFrames {
    std::uint64_t changes = ~std::uint64_t{0};  ///< value of the state's counter when the current frame was determined
    std::uint8_t held = 0, absolute = 0;
    ProgramFrame words;         ///< from the program's words to the work system
    std::uint32_t current = 0;  ///< index into Motions::frames
    std::map<std::array<double, 34>, std::uint32_t> known;
};

}  // namespace clsurf
